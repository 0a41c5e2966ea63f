#include "studies/menisci_study.h"

#include <algorithm>

#include <fmt/format.h>

#include "genu/results/chart.h"
#include "genu/study/run_motion.h"

namespace genu::studies {
namespace {

MenisciStudy::Range range_of(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {*least, *most};
}

MenisciStudy::Range range_of(const SolvedScene& solved, const std::string& column) {
  return range_of(solved.column(column));
}

/// The angle of the hinge since the start, at the knee's times.
DrivenCurve hinges_of(const std::string& file, const std::vector<double>& times, Diagnostics& out) {
  DrivenCurve c;
  const auto prepared = prepare(file, out);
  if (!prepared) return c;
  const Solution solution = solve_motion(*prepared, {});
  const ResultTable& t = solution.poses;
  constexpr double kSameTime = 1e-6;  // s
  for (std::size_t row = 0; row < t.rows() && c.time.size() < times.size(); ++row) {
    const double time = t.number(row, "time_s");
    if (time < times[c.time.size()] - kSameTime) continue;
    c.time.push_back(time);
    c.angle.push_back(t.number(row, "j1.angle_deg") - t.number(0, "j1.angle_deg"));
  }
  if (solution.summary.exit_code == kExitOk) measure(c);
  return c;
}

std::string line(const std::string& name, const std::string& a, const std::string& b) {
  return "| " + name + " | " + a + " | " + b + " |\n";
}

std::string span(const MenisciStudy::Range& r, double factor, int digits) {
  return fmt::format("{:.{}f} to {:.{}f}", factor * r.least, digits, factor * r.most, digits);
}

std::string table(const MenisciStudy& study) {
  const auto number = [](double x, int digits) { return fmt::format("{:.{}f}", x, digits); };
  const DrivenCurve &a = study.knee, &b = study.hinges;
  return "| | knee, force | hinges, torque |\n|---|---:|---:|\n" +
         line("flexion since the start, deg", span(range_of(a.angle), 1, 1), span(range_of(b.angle), 1, 1)) +
         line("second harmonic over the first", number(a.harmonics[1] / a.harmonics[0], 3),
              number(b.harmonics[1] / b.harmonics[0], 3)) +
         line("third over the first", number(a.harmonics[2] / a.harmonics[0], 3),
              number(b.harmonics[2] / b.harmonics[0], 3)) +
         line("largest rate over that of a sine of the same range", number(a.steepest, 2), number(b.steepest, 2)) +
         line("medial meniscus forward on the tibia, mm", span(study.medial, 1, 1), "") +
         line("lateral meniscus", span(study.lateral, 1, 1), "") +
         line("share of the medial meniscus in its compartment's force, %", span(study.share_of_medial, 100, 0), "") +
         line("of the lateral one", span(study.share_of_lateral, 100, 0), "") +
         line("force between femur and tibia with menisci, N", span(study.contact, 1, 0), "");
}

}  // namespace

std::optional<MenisciStudy> solve_menisci(const std::string& knee, const std::string& hinges, Diagnostics& out) {
  MenisciStudy study;
  const auto solved = solve_scene(knee + "/scene-driven.toml", out);
  if (!solved) return std::nullopt;
  study.knee.time = solved->column("time_s");
  study.knee.angle = solved->column("knee.flexion_deg");
  const double start = study.knee.angle.front();
  for (double& angle : study.knee.angle) angle -= start;
  study.stable = solved->all_stable();
  if (study.stable) measure(study.knee);
  study.medial = range_of(*solved, "meniscus_medial.x_mm");
  study.lateral = range_of(*solved, "meniscus_lateral.x_mm");
  study.share_of_medial = range_of(*solved, "medial_compartment.meniscal_share");
  study.share_of_lateral = range_of(*solved, "lateral_compartment.meniscal_share");
  std::vector<double> force = solved->column("medial_compartment.force_N");
  const std::vector<double> lateral = solved->column("lateral_compartment.force_N");
  for (std::size_t row = 0; row < force.size(); ++row) force[row] += lateral[row];
  study.contact = range_of(force);
  study.hinges = hinges_of(hinges + "/scene.toml", study.knee.time, out);
  if (out.has_errors()) return std::nullopt;
  return study;
}

Files menisci_files(const MenisciStudy& study) {
  std::string text =
      "# A knee with its menisci, driven by a force on the tibia\n\n"
      "Written by `studies menisci meshes` (`tools/figures`); do not edit.\n\n"
      "Guess et al. (2010) drove a knee, held by ligaments and menisci, with a force on the tibia, forward and "
      "backward. "
      "Leskovar et al.\n(2019) replaced such a knee by two hinges, driven by a torque, and found its angle steeper "
      "than "
      "their sine. Here both are beside\neach other: `scene-driven.toml`, a measured knee with both menisci as bodies, "
      "and `scene.toml` of [leskovar2019](../leskovar2019/SOURCE.md).\nThe force and the torque are sines of 0.125 Hz "
      "from 1 s on. The knee is in equilibrium at every moment, without inertia. Harmonics\nand the largest rate are "
      "those of the second period (9 to 17 s).\n\n";
  if (!study.stable || !study.knee.complete || !study.hinges.complete)
    return {{"DRIVEN.md", text + "Not every pose was solved.\n"}};
  text += table(study) + "\n![Both angles over 17 s](driven.svg)\n";
  Chart chart;
  chart.title = "Flexion since the start: a knee held by ligaments, menisci and muscles, and hinges";
  chart.x_title = "time [s]";
  chart.x = study.knee.time;
  chart.panels = {
      {"flexion [deg]",
       {{"knee with menisci, force on the tibia", study.knee.angle}, {"hinges, torque", study.hinges.angle}},
       true,
       false}};
  return {{"driven.svg", to_svg(chart)}, {"DRIVEN.md", text}};
}

}  // namespace genu::studies
