// consumer SCENE COLUMN: solves a scene and prints one column of its results, a line each pose.
#include <cstdio>

#include <genu/genu.h>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    const genu::api::Results found = genu::api::load(argv[1]).run();
    for (const double value : found[argv[2]]) std::printf("%.17g\n", value);
    return found.solved() == found.asked() ? 0 : 3;
  } catch (const genu::api::SceneError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
