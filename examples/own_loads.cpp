// own_loads SCENE BODY COLUMN: forces of your own on a scene that knows none of them.
//   own_loads meshes/dortmans1984/scene.toml femur knee.y_mm
//   1. read the scene's text, add a load to it in memory
//   2. give the load a force, solve, print the column at the first pose: as often as there are forces
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include <genu/genu.h>

int main(int argc, char** argv) {
  if (argc != 4) return std::fprintf(stderr, "usage: own_loads SCENE BODY COLUMN\n"), 2;
  const std::string file = argv[1], body = argv[2], column = argv[3];
  std::ifstream in(file);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  // Along the world's axes, at the body's origin; the numbers are changed below.
  text += "\n[load.own]\nbody = \"" + body + "\"\nforce = [1, 0, 0]\n";
  try {
    genu::api::Scene scene = genu::api::parse(text, file);
    std::printf("force_N,%s\n", column.c_str());
    for (int newton = 0; newton <= 10; newton += 2) {
      scene.set("own.force.?", std::vector<double>{0, 1.0 * newton, 0});
      std::printf("%d,%.17g\n", newton, scene.run()[column][0]);
    }
  } catch (const genu::api::SceneError& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 2;
  }
  return 0;
}
