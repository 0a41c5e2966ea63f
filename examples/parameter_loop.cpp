// parameter_loop SCENE NUMBER COLUMN [RUNS]: how a column of the results follows a number of the scene.
//   parameter_loop meshes/dortmans1984/scene.toml AAC.stiffness AAC.force_N
//   1. read the scene once
//   2. change the number from 50 % to 150 % of its value, solve, print the column's largest value
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <genu/genu.h>

int main(int argc, char** argv) {
  if (argc < 4) return std::fprintf(stderr, "usage: parameter_loop SCENE NUMBER COLUMN [RUNS]\n"), 2;
  const std::string number = argv[2], column = argv[3];
  const int runs = argc > 4 ? std::max(2, std::atoi(argv[4])) : 11;
  try {
    genu::api::Scene scene = genu::api::load(argv[1]);
    const double value = scene.value(number);
    std::printf("%s,largest %s,verdict\n", number.c_str(), column.c_str());
    for (int i = 0; i < runs; ++i) {
      scene.set(number, value * (0.5 + i / (runs - 1.0)));
      const genu::api::Results found = scene.run();
      const auto values = found[column];
      std::printf("%.17g,%.17g,%s\n", scene.value(number), *std::max_element(values.begin(), values.end()),
                  found.verdict().c_str());
    }
  } catch (const genu::api::SceneError& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 2;
  }
  return 0;
}
