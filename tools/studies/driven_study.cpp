#include "studies/driven_study.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/QR>

#include "genu/results/chart.h"
#include "genu/study/run_motion.h"

namespace genu::studies {
namespace {

constexpr double kFrequency = 0.125, kStart = 1, kPeriod = 1 / kFrequency;  // Hz, s: of the drive
constexpr double kSecond = kStart + kPeriod;                                // s: when its second period begins

/// Amplitudes of the first three harmonics by least squares from `first` on.
std::vector<double> harmonics_of(const DrivenCurve& c, std::size_t first) {
  const auto n = static_cast<Eigen::Index>(c.time.size() - first);
  MatX columns(n, 7);
  VecX angle(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t row = first + static_cast<std::size_t>(i);
    const double phase = 2 * M_PI * kFrequency * (c.time[row] - kStart);
    columns(i, 0) = 1;
    for (Eigen::Index k = 1; k <= 3; ++k) {
      columns(i, 2 * k - 1) = std::sin(static_cast<double>(k) * phase);
      columns(i, 2 * k) = std::cos(static_cast<double>(k) * phase);
    }
    angle[i] = c.angle[row];
  }
  const VecX x = columns.householderQr().solve(angle);
  return {std::hypot(x[1], x[2]), std::hypot(x[3], x[4]), std::hypot(x[5], x[6])};
}

DrivenCurve curve_of(const std::string& file, const std::string& column, Diagnostics& out) {
  DrivenCurve c;
  const auto prepared = prepare(file, out);
  if (!prepared) return c;
  const Solution solution = solve_motion(*prepared, {});
  const ResultTable& t = solution.poses;
  for (std::size_t row = 0; row < t.rows(); ++row) {
    c.time.push_back(t.number(row, "time_s"));
    c.angle.push_back(t.number(row, column) - t.number(0, column));
  }
  const auto first =
      static_cast<std::size_t>(std::lower_bound(c.time.begin(), c.time.end(), kSecond - 1e-9) - c.time.begin());
  c.complete = solution.summary.exit_code == kExitOk && c.time.size() > first + 7;
  if (!c.complete) return c;
  c.harmonics = harmonics_of(c, first);
  const auto [least, most] = std::minmax_element(c.angle.begin() + static_cast<std::ptrdiff_t>(first), c.angle.end());
  for (std::size_t row = first + 1; row + 1 < c.time.size(); ++row)
    c.steepest =
        std::max(c.steepest, std::abs(c.angle[row + 1] - c.angle[row - 1]) / (c.time[row + 1] - c.time[row - 1]));
  c.steepest /= M_PI * kFrequency * (*most - *least);
  return c;
}

}  // namespace

std::optional<DrivenStudy> solve_driven(const std::string& folder, Diagnostics& out) {
  DrivenStudy study;
  study.ligaments = curve_of(folder + "/scene-driven.toml", "knee.flexion_deg", out);
  study.hinges = curve_of(folder + "/scene-driven-hinges.toml", "j1.angle_deg", out);
  if (out.has_errors() || study.ligaments.time.size() != study.hinges.time.size()) return std::nullopt;
  double sum = 0;
  for (std::size_t k = 0; k < study.hinges.angle.size(); ++k)
    sum += std::pow(study.hinges.angle[k] - study.ligaments.angle[k], 2);
  study.rms = std::sqrt(sum / static_cast<double>(study.hinges.angle.size()));
  return study;
}

Files driven_files(const DrivenStudy& study) {
  std::string text =
      "# A knee held by ligaments, and hinges calibrated to it\n\n"
      "Written by `tools/figures`; do not edit. [SOURCE.md](SOURCE.md) describes both scenes. Angles are since the "
      "start; harmonics and\nthe largest rate are those of the second period (9 to 17 s).\n\n";
  if (!study.ligaments.complete || !study.hinges.complete)
    return {{"DRIVEN.md", text + "A motion did not come to its end.\n"}};
  text += "| | held by ligaments (`scene-driven.toml`) | hinges (`scene-driven-hinges.toml`) |\n|---|---:|---:|\n";
  const auto row = [&](const std::string& name, const std::string& form, double a, double b) {
    text +=
        "| " + name + " | " + fmt::format(fmt::runtime(form), a) + " | " + fmt::format(fmt::runtime(form), b) + " |\n";
  };
  const DrivenCurve &a = study.ligaments, &b = study.hinges;
  const auto largest = [](const DrivenCurve& c) { return *std::max_element(c.angle.begin(), c.angle.end()); };
  const auto least = [](const DrivenCurve& c) { return *std::min_element(c.angle.begin(), c.angle.end()); };
  row("most flexed deg", "{:.1f}", largest(a), largest(b));
  row("most extended deg", "{:.1f}", least(a), least(b));
  row("first harmonic deg", "{:.2f}", a.harmonics[0], b.harmonics[0]);
  row("second over first", "{:.3f}", a.harmonics[1] / a.harmonics[0], b.harmonics[1] / b.harmonics[0]);
  row("third over first", "{:.3f}", a.harmonics[2] / a.harmonics[0], b.harmonics[2] / b.harmonics[0]);
  row("largest rate over that of a sine of the same range", "{:.2f}", a.steepest, b.steepest);
  text += fmt::format("\nThe curves differ by {:.2f} deg rms over the 17 s.\n\n![Both angles over 17 s](driven.svg)\n",
                      study.rms);
  Chart chart;
  chart.title = "Flexion since the start: a knee held by ligaments, and hinges calibrated to it";
  chart.x_title = "time [s]";
  chart.x = study.ligaments.time;
  chart.panels = {
      {"flexion [deg]",
       {{"held by ligaments, force on the tibia", study.ligaments.angle}, {"hinges, torque", study.hinges.angle}},
       true,
       false}};
  return {{"driven.svg", to_svg(chart)}, {"DRIVEN.md", text}};
}

}  // namespace genu::studies
