// Derivatives held to re-solves: what a scene's outputs do when one of its numbers is edited.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "genu/model/build_model.h"
#include "genu/scene/reader.h"
#include "genu/study/sensitivity.h"
#include "support/edited_scene.h"
#include "support/finite_difference.h"
#include "support/judged.h"

namespace genu::test {

constexpr double kDerivativeTolerance = 1e-6;

inline Prepared prepared(const std::string& text) {
  Diagnostics out;
  std::optional<Prepared> p;
  if (auto scene = parse_scene(text, "scene.toml", out))
    p = prepare(std::move(*scene), std::make_shared<MeshLibrary>(), out);
  for (const Diagnostic& d : out.items())
    if (d.severity == Diagnostic::Severity::error) ADD_FAILURE() << to_string(d);
  return p ? std::move(*p) : Prepared{};
}

inline SensitivityResult differentiated(const Prepared& p, const SensitivityChoice& choice) {
  SensitivityResult result;
  Diagnostics out;
  choose(p, choice, 9, out);
  for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
  ContactField field(p.model);
  result.solution = judged(p, solve(p, field, {}));
  EXPECT_TRUE(all_solved(result.solution.summary.exit_code));
  for (const std::string& sentence : result.solution.summary.verdict)
    if (!all_solved(result.solution.summary.exit_code)) ADD_FAILURE() << sentence;
  differentiate(p, field, choice, result);
  EXPECT_EQ(result.poses_without, 0);
  return result;
}

struct Worst {
  double error = 0;
  std::string where;
  std::size_t compared = 0, not_zero = 0;
};

/// Compares at the rows given, by differences of `step` standard changes. The error is a share of the derivative
/// itself; of derivatives that hardly matter a share of a ten-thousandth of the largest effect on that output at the
/// pose, for below that a re-solve shows its own rounding and nothing else.
inline Worst worst_error(const Prepared& p, const SensitivityResult& r, const std::vector<std::size_t>& rows,
                         double step) {
  constexpr double kConstant = 1e-3;    // mm, N ...: an output that nothing moves, the gap of a closed contact
  constexpr double kNegligible = 1e-4;  // of the largest effect
  Worst worst;
  for (const std::size_t row : rows) {
    const PosePoint& point = r.solution.records.at(row).point;
    std::vector<double> largest(r.rows.outputs.size());
    for (std::size_t o = 0; o < r.rows.outputs.size(); ++o)
      for (std::size_t k = 0; k < r.rows.parameters.size(); ++k)
        if (std::isfinite(r.rows.effect(row, o, k)))
          largest[o] = std::max(largest[o], std::abs(r.rows.effect(row, o, k)));
    for (std::size_t k = 0; k < r.rows.parameters.size(); ++k) {
      const Parameter& parameter = r.rows.parameters[k];
      const auto numbers = derivative(
          [&](double share) {
            const auto all = solved_again(p.scene, p.surfaces, p.steps, point, parameter, share * parameter.change);
            Eigen::VectorXd v(static_cast<Eigen::Index>(r.rows.outputs.size()));
            for (std::size_t o = 0; o < r.rows.outputs.size(); ++o)
              v[static_cast<Eigen::Index>(o)] = all.at(r.rows.outputs[o].column);
            return v;
          },
          step);
      for (std::size_t o = 0; o < r.rows.outputs.size(); ++o) {
        const double effect = r.rows.effect(row, o, k), truth = numbers[static_cast<Eigen::Index>(o)];
        if (!std::isfinite(effect) && !std::isfinite(truth)) continue;
        const double scale = largest[o] > 0 ? std::max(std::abs(truth), kNegligible * largest[o]) : kConstant;
        const bool both = std::isfinite(effect) && std::isfinite(truth);
        const double error = both ? std::abs(effect - truth) / scale : INFINITY;
        ++worst.compared;
        if (truth != 0) ++worst.not_zero;
        if (error <= worst.error) continue;
        worst.error = error;
        worst.where = r.rows.outputs[o].column + " to " + parameter.name + " at row " + std::to_string(row) + ": " +
                      std::to_string(effect) + ", re-solved " + std::to_string(truth);
      }
    }
  }
  return worst;
}

inline void compare(const std::string& name, const std::string& text, const std::vector<std::size_t>& rows,
                    const SensitivityChoice& choice = {{"all"}, {"all"}}, double step = 0.01) {
  const Prepared p = prepared(text);
  const SensitivityResult r = differentiated(p, choice);
  if (r.solution.summary.exit_code != kExitOk) return;
  const Worst worst = worst_error(p, r, rows, step);
  std::printf("%s: %zu outputs, %zu parameters, %zu derivatives (%zu not 0): worst error %.2g (%s)\n", name.c_str(),
              r.rows.outputs.size(), r.rows.parameters.size(), worst.compared, worst.not_zero, worst.error,
              worst.where.c_str());
  EXPECT_LT(worst.error, kDerivativeTolerance) << worst.where;
  EXPECT_GT(worst.not_zero, worst.compared / 4);
}

}  // namespace genu::test
