#include "studies/laxity_study.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/results/chart.h"

namespace genu::studies {
namespace {

constexpr double kForce = 100;       // N, the largest of the scene
constexpr double kSameForce = 1e-9;  // N
constexpr std::size_t kSteps = 4;    // of one drawer test
constexpr const char* kLoad = "drawer";

/// The columns of results.csv that a drawer test reads.
struct Columns {
  std::vector<double> flexion, y, rotation, medial, lateral;
};

void add_row(const Columns& columns, std::size_t row, std::size_t first, double force, Drawer& drawer) {
  drawer.force.push_back(force);
  drawer.displacement.push_back(columns.y[first] - columns.y[row]);
  drawer.rotation.push_back(columns.rotation[first] - columns.rotation[row]);
  drawer.medial.push_back(columns.medial[row]);
  drawer.lateral.push_back(columns.lateral[row]);
}

/// Row by row: the last of a first step begins a test, those of the other three steps belong to it.
std::vector<Drawer> drawers_of(const SolvedScene& scene, std::size_t load) {
  const Columns columns{scene.column("knee.flexion_deg"), scene.column("knee.y_mm"), scene.column("knee.rotation_deg"),
                        scene.column("medial.force_N"), scene.column("lateral.force_N")};
  const double unit = -scene.prepared.model.loads[load].force.y();
  std::vector<Drawer> drawers;
  std::size_t first = 0;
  const auto& records = scene.solution.records;
  for (std::size_t row = 0; row < records.size(); ++row) {
    if ((at(records[row].point.step) - 1) % kSteps == 0) {
      first = row;
      continue;
    }
    if (row == first + 1) {
      drawers.emplace_back().flexion = columns.flexion[first];
      add_row(columns, first, first, 0, drawers.back());
    }
    add_row(columns, row, first, unit * records[row].point.target.load_factors[load], drawers.back());
  }
  return drawers;
}

/// On the way from the largest force down: rows between the largest and the smallest.
std::pair<std::size_t, std::size_t> way_down(const Drawer& d) {
  const auto most = std::max_element(d.force.begin(), d.force.end()), least = std::min_element(most, d.force.end());
  return {static_cast<std::size_t>(most - d.force.begin()), static_cast<std::size_t>(least - d.force.begin())};
}

std::size_t row_at(const Drawer& d, double force) {
  const auto [first, last] = way_down(d);
  std::size_t row = first;
  while (row < last && std::abs(d.force[row] - force) > kSameForce) ++row;
  return row;
}

Chart force_chart(const LaxityStudy& study) {
  Chart chart;
  chart.title = "Drawer test at held flexion: displacement of the tibia against force (reconstructed knee)";
  chart.x_title = "force on the tibia, positive forward [N]";
  ChartPanel displacement{"displacement of the tibia forward [mm]", {}, true, false};
  ChartPanel rotation{"rotation of the tibia inward [deg]", {}, true, false};
  for (const Drawer& d : study.drawers) {
    const auto [first, last] = way_down(d);
    const auto part = [first = first, last = last](const std::vector<double>& v) {
      const auto end = v.rend() - static_cast<std::ptrdiff_t>(first);  // from the smallest force up
      return std::vector<double>(end - static_cast<std::ptrdiff_t>(last - first) - 1, end);
    };
    chart.x = part(d.force);
    const std::string name = fmt::format("{:.0f} deg", d.flexion);
    displacement.series.push_back({name, part(d.displacement)});
    rotation.series.push_back({name, part(d.rotation)});
  }
  chart.panels = {displacement, rotation};
  return chart;
}

Chart flexion_chart(const LaxityStudy& study) {
  Chart chart;
  chart.title = "Laxity over flexion (reconstructed knee)";
  chart.x_title = "flexion [deg]";
  ChartSeries forward{"forward", {}}, backward{"backward", {}}, total{"both", {}}, free{"at no force", {}},
      ends{"at both ends (mean)", {}};
  for (const Drawer& d : study.drawers) {
    chart.x.push_back(d.flexion);
    forward.y.push_back(d.at(kForce));
    backward.y.push_back(-d.at(-kForce));
    total.y.push_back(d.at(kForce) - d.at(-kForce));
    free.y.push_back(d.stiffness_at(0));
    ends.y.push_back(0.5 * (d.stiffness_at(0.9 * kForce) + d.stiffness_at(-0.9 * kForce)));
  }
  chart.panels = {{"laxity under 100 N [mm]", {forward, backward, total}, true, false},
                  {"stiffness of the drawer [N/mm]", {free, ends}, true, false}};
  return chart;
}

std::string table_of(const LaxityStudy& study) {
  std::string out =
      "| flexion deg | forward mm | backward mm | both mm | stiffness at 0 N | at 90 N forward | at 90 N backward N/mm "
      "| "
      "tibia turns inward by deg, forward | backward | smallest contact force N |\n"
      "|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const Drawer& d : study.drawers) {
    const double contact = std::min(*std::min_element(d.medial.begin(), d.medial.end()),
                                    *std::min_element(d.lateral.begin(), d.lateral.end()));
    out += fmt::format(
        "| {:.0f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} | {:.1f} | {:.1f} | {:+.2f} | {:+.2f} | {:.0f} |\n", d.flexion,
        d.at(kForce), -d.at(-kForce), d.at(kForce) - d.at(-kForce), d.stiffness_at(0), d.stiffness_at(0.9 * kForce),
        d.stiffness_at(-0.9 * kForce), d.rotation[row_at(d, kForce)], d.rotation[row_at(d, -kForce)], contact);
  }
  return out;
}

}  // namespace

double Drawer::at(double force_N) const { return displacement[row_at(*this, force_N)]; }

double Drawer::stiffness_at(double force_N) const {
  const std::size_t row = row_at(*this, force_N);
  return (force[row + 1] - force[row - 1]) / (displacement[row + 1] - displacement[row - 1]);
}

double Drawer::hysteresis() const {
  double worst = 0;
  for (std::size_t i = 0; i < force.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::abs(force[i] - force[j]) < kSameForce)
        worst = std::max(worst, std::abs(displacement[i] - displacement[j]));
  return worst;
}

std::optional<LaxityStudy> solve_laxity(const std::string& file, Diagnostics& out) {
  const auto scene = solve_scene(file, out);
  if (!scene) return std::nullopt;
  const auto& loads = scene->prepared.scene.loads;
  const auto drawer = std::find_if(loads.begin(), loads.end(), [](const LoadDef& l) { return l.name == kLoad; });
  const std::size_t steps = scene->prepared.steps.size();
  if (drawer == loads.end() || steps == 0 || steps % kSteps != 0 ||
      !scene->solution.poses.has_column("medial.force_N")) {
    out.error(Code::not_applicable, file, "is no drawer test: a load drawer, steps in fours");
    return std::nullopt;
  }
  LaxityStudy study;
  study.drawers = drawers_of(*scene, static_cast<std::size_t>(drawer - loads.begin()));
  study.all_stable = scene->all_stable();
  study.fewest_contacts = std::numeric_limits<int>::max();
  for (const PoseRecord& r : scene->solution.records)
    study.fewest_contacts = std::min(study.fewest_contacts, static_cast<int>(r.point.pose.state.contacts.size()));
  return study;
}

Files laxity_files(const LaxityStudy& study) {
  std::string text =
      "# Laxity at held flexion\n\n"
      "Written by `tools/figures`; do not edit. [SOURCE.md](SOURCE.md): every number of this knee is a reconstruction, "
      "so "
      "these results\nshow what the model does, not what a knee does.\n\n"
      "At each angle of flexion the tibia is pulled forward with up to 100 N, pushed backward with as much, and let "
      "go; "
      "displacements are\nthe tibia's along its own axis y, since no force. Stiffness is dF/du.\n\n";
  if (!study.all_stable) return {{"STUDY.md", text + "Not every pose was solved and stable.\n"}};
  text += table_of(study) +
          "\n![Displacement and coupled rotation against force, at eight angles of flexion](study-force.svg)\n\n"
          "![Laxity and stiffness over flexion](study-flexion.svg)\n";
  return {{"study-force.svg", to_svg(force_chart(study))},
          {"study-flexion.svg", to_svg(flexion_chart(study))},
          {"STUDY.md", text}};
}

}  // namespace genu::studies
