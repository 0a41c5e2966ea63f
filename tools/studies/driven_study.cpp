#include "studies/driven_study.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/results/chart.h"
#include "genu/study/run_motion.h"

namespace genu::studies {
namespace {

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
  if (solution.summary.exit_code == kExitOk) measure(c);
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
