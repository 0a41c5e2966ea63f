// own_law SCENE LIGAMENT COLUMN: a ligament with a force law of your own.
//   own_law meshes/dortmans1984/scene.toml AAC AAC.force_N
//   1. read the scene
//   2. give the ligament F = K e^2.5, e = L / L0 - 1: a toe region without an end
//   3. solve, print the column with the law of the file and with the new one
#include <cmath>
#include <cstdio>
#include <string>

#include <genu/genu.h>

int main(int argc, char** argv) {
  if (argc != 4) return std::fprintf(stderr, "usage: own_law SCENE LIGAMENT COLUMN\n"), 2;
  const std::string ligament = argv[2], column = argv[3];
  try {
    genu::api::Scene scene = genu::api::load(argv[1]);
    const genu::api::Results before = scene.run();
    // The length at which it became taut in the file, from strain = L / L0 - 1 at the first pose: mm to m.
    const double slack = 1e-3 * before[ligament + ".length_mm"][0] / (1 + before[ligament + ".strain"][0]);
    constexpr double kStiffness = 40'000, kPower = 2.5;  // N, 1
    scene.set_law(ligament, {[slack](double length) -> genu::api::Tension {
                               const double e = length / slack - 1, force = kStiffness * std::pow(e, kPower);
                               return {force, kPower * force / (e * slack), force * e * slack / (kPower + 1)};
                             },
                             slack});
    const genu::api::Results after = scene.run();
    std::printf("row,in the file,own law\n");
    for (std::size_t row = 0; row < after.rows(); ++row)
      std::printf("%zu,%.17g,%.17g\n", row + 1, before[column][row], after[column][row]);
    std::fprintf(stderr, "%s, %d of %d poses\n", after.verdict().c_str(), after.solved(), after.asked());
    return after.solved() == after.asked() ? 0 : 3;
  } catch (const genu::api::SceneError& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 2;
  }
}
