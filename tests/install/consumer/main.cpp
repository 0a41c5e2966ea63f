// consumer SCENE COLUMN: solves a scene and prints one column of its results, a line each pose.
#include <cstdio>

#include <genu/study/run_scene.h>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  genu::Diagnostics diagnostics;
  const auto prepared = genu::prepare(argv[1], diagnostics);
  const auto solution = prepared ? genu::solve_all(*prepared, {}, diagnostics) : std::nullopt;
  for (const genu::Diagnostic& d : diagnostics.items()) std::fprintf(stderr, "%s\n", genu::to_string(d).c_str());
  if (!solution || !solution->poses.has_column(argv[2])) return 2;
  for (std::size_t row = 0; row < solution->poses.rows(); ++row)
    std::printf("%.17g\n", solution->poses.number(row, argv[2]));
  return solution->summary.exit_code;
}
