#include "studies/laxity_study.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "genu/results/chart.h"

namespace genu::studies {
namespace {

constexpr double kSameLoad = 1e-9;  // N or N m
constexpr std::size_t kSteps = 7;   // at one angle of flexion: to it, three of the drawer, three of the torsion
constexpr std::size_t kOfLoad = 3;

/// The columns of results.csv that the tests read.
struct Columns {
  std::vector<double> flexion, x, rotation, medial, lateral;
};

std::optional<std::size_t> load_named(const SolvedScene& scene, const std::string& name) {
  const auto& loads = scene.prepared.scene.loads;
  const auto found = std::find_if(loads.begin(), loads.end(), [&](const LoadDef& l) { return l.name == name; });
  if (found == loads.end()) return std::nullopt;
  return static_cast<std::size_t>(found - loads.begin());
}

int contacts_at(const SolvedScene& scene, std::size_t row) {
  return static_cast<int>(scene.solution.records[row].point.pose.state.contacts.size());
}

void add_row(const SolvedScene& scene, const Columns& c, std::size_t row, std::size_t first, double load,
             LaxityTest& test) {
  test.load.push_back(load);
  test.displacement.push_back(c.x[first] - c.x[row]);  // x is the femur's on the tibia
  test.rotation.push_back(c.rotation[row] - c.rotation[first]);
  test.medial.push_back(c.medial[row]);
  test.lateral.push_back(c.lateral[row]);
  test.contacts.push_back(contacts_at(scene, row));
}

/// Row by row: the last of a first step begins the tests of an angle; its load is `per_factor` times its factor.
std::vector<LaxityTest> tests_of(const SolvedScene& scene, const Columns& columns, std::size_t load,
                                 std::size_t first_step, double per_factor) {
  std::vector<LaxityTest> tests;
  std::size_t first = 0;
  bool fresh = false;
  const auto& records = scene.solution.records;
  for (std::size_t row = 0; row < records.size(); ++row) {
    const std::size_t step = (at(records[row].point.step) - 1) % kSteps;
    if (step == 0) first = row, fresh = true;
    if (step < first_step || step >= first_step + kOfLoad) continue;
    if (std::exchange(fresh, false)) {
      tests.emplace_back().flexion = columns.flexion[first];
      add_row(scene, columns, first, first, 0, tests.back());
    }
    add_row(scene, columns, row, first, per_factor * records[row].point.target.load_factors[load], tests.back());
  }
  return tests;
}

/// On the way from the largest load down: rows between the largest and the smallest.
std::pair<std::size_t, std::size_t> way_down(const LaxityTest& t) {
  const auto most = std::max_element(t.load.begin(), t.load.end()), least = std::min_element(most, t.load.end());
  return {static_cast<std::size_t>(most - t.load.begin()), static_cast<std::size_t>(least - t.load.begin())};
}

std::size_t row_at(const LaxityTest& t, double load) {
  const auto [first, last] = way_down(t);
  std::size_t row = first;
  while (row < last && std::abs(t.load[row] - load) > kSameLoad) ++row;
  return row;
}

/// A motion on the way down, from the smallest load up.
std::vector<double> upward(const LaxityTest& t, const std::vector<double>& values) {
  const auto [first, last] = way_down(t);
  const auto end = values.rend() - static_cast<std::ptrdiff_t>(first);
  return {end - static_cast<std::ptrdiff_t>(last - first) - 1, end};
}

Chart load_chart(const std::vector<LaxityTest>& tests, const std::string& title, const std::string& x_title) {
  Chart chart;
  chart.title = title;
  chart.x_title = x_title;
  ChartPanel displacement{"displacement of the tibia forward [mm]", {}, true, false};
  ChartPanel rotation{"rotation of the tibia inward [deg]", {}, true, false};
  for (const LaxityTest& t : tests) {
    chart.x = upward(t, t.load);
    const std::string name = fmt::format("{:.0f} deg", std::round(t.flexion) + 0.0);
    displacement.series.push_back({name, upward(t, t.displacement)});
    rotation.series.push_back({name, upward(t, t.rotation)});
  }
  chart.panels = {displacement, rotation};
  return chart;
}

Chart flexion_chart(const LaxityStudy& study) {
  Chart chart;
  chart.title = "Laxity over flexion";
  chart.x_title = "flexion [deg]";
  ChartSeries forward{"forward", {}}, backward{"backward", {}}, inward{"inward", {}}, outward{"outward", {}},
      free{"at no force", {}}, ends{"at both ends (mean)", {}};
  for (const LaxityTest& d : study.drawers) {
    chart.x.push_back(d.flexion);
    forward.y.push_back(d.displacement_at(study.force));
    backward.y.push_back(-d.displacement_at(-study.force));
    free.y.push_back(d.stiffness_at(0));
    ends.y.push_back(0.5 * (d.stiffness_at(0.9 * study.force) + d.stiffness_at(-0.9 * study.force)));
  }
  for (const LaxityTest& t : study.twists) {
    inward.y.push_back(t.rotation_at(study.moment));
    outward.y.push_back(-t.rotation_at(-study.moment));
  }
  chart.panels = {{fmt::format("laxity under {:g} N [mm]", study.force), {forward, backward}, true, false},
                  {"stiffness of the drawer [N/mm]", {free, ends}, true, false},
                  {fmt::format("laxity under {:g} N m [deg]", study.moment), {inward, outward}, true, false}};
  return chart;
}

std::string drawer_table(const LaxityStudy& study) {
  std::string out =
      "| flexion deg | forward mm | backward mm | both mm | stiffness at 0 N | at 90 N forward | at 90 N backward N/mm "
      "| tibia turns inward by deg, forward | backward | smallest contact force N |\n"
      "|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const LaxityTest& d : study.drawers) {
    const double F = study.force, forward = d.displacement_at(F), backward = -d.displacement_at(-F);
    const double contact = std::min(*std::min_element(d.medial.begin(), d.medial.end()),
                                    *std::min_element(d.lateral.begin(), d.lateral.end()));
    out +=
        fmt::format("| {:.0f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} | {:.1f} | {:.1f} | {:+.2f} | {:+.2f} | {:.0f} |\n",
                    std::round(d.flexion) + 0.0, forward, backward, forward + backward, d.stiffness_at(0),
                    d.stiffness_at(0.9 * F), d.stiffness_at(-0.9 * F), d.rotation_at(F), d.rotation_at(-F), contact);
  }
  return out;
}

std::string twist_table(const LaxityStudy& study) {
  std::string out =
      "| flexion deg | inward deg | outward deg | both deg | tibia moves forward by mm, inward | outward "
      "| most contact points |\n|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const LaxityTest& t : study.twists) {
    const double M = study.moment, inward = t.rotation_at(M), outward = -t.rotation_at(-M);
    out += fmt::format("| {:.0f} | {:.1f} | {:.1f} | {:.1f} | {:+.2f} | {:+.2f} | {} |\n", std::round(t.flexion) + 0.0,
                       inward, outward, inward + outward, t.displacement_at(M), t.displacement_at(-M),
                       *std::max_element(t.contacts.begin(), t.contacts.end()));
  }
  return out;
}

std::string contacts_text(const LaxityStudy& study) {
  std::string out;
  for (std::size_t n = 0; n < study.poses_of.size(); ++n)
    if (study.poses_of[n] > 0)
      out += fmt::format("{}{} points at {} poses", out.empty() ? "" : ", ", n, study.poses_of[n]);
  return out;
}

}  // namespace

double LaxityTest::displacement_at(double value) const { return displacement[row_at(*this, value)]; }

double LaxityTest::rotation_at(double value) const { return rotation[row_at(*this, value)]; }

double LaxityTest::stiffness_at(double force_N) const {
  const std::size_t row = row_at(*this, force_N);
  return (load[row + 1] - load[row - 1]) / (displacement[row + 1] - displacement[row - 1]);
}

double LaxityTest::hysteresis() const {
  double worst = 0;
  for (std::size_t i = 0; i < load.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::abs(load[i] - load[j]) < kSameLoad)
        worst = std::max({worst, std::abs(displacement[i] - displacement[j]), std::abs(rotation[i] - rotation[j])});
  return worst;
}

std::optional<LaxityStudy> solve_laxity(const std::string& file, Diagnostics& out) {
  const auto scene = solve_scene(file, out);
  if (!scene) return std::nullopt;
  const auto drawer = load_named(*scene, "drawer"), torsion = load_named(*scene, "torsion");
  const std::size_t steps = scene->prepared.steps.size();
  if (!drawer || !torsion || steps == 0 || steps % kSteps != 0 || !scene->solution.poses.has_column("medial.force_N")) {
    out.error(Code::not_applicable, file, "is no test of laxity: loads drawer and torsion, steps in sevens");
    return std::nullopt;
  }
  const Columns columns{scene->column("knee.flexion_deg"), scene->column("knee.x_mm"),
                        scene->column("knee.rotation_deg"), scene->column("medial.force_N"),
                        scene->column("lateral.force_N")};
  LaxityStudy study;
  study.force = -scene->prepared.model.loads[*drawer].force.x();
  study.moment = -scene->prepared.model.loads[*torsion].moment.y();
  study.drawers = tests_of(*scene, columns, *drawer, 1, study.force);
  study.twists = tests_of(*scene, columns, *torsion, 1 + kOfLoad, study.moment);
  study.all_stable = scene->all_stable();
  study.poses = static_cast<int>(scene->solution.records.size());
  for (std::size_t row = 0; row < scene->solution.records.size(); ++row) {
    const auto n = static_cast<std::size_t>(contacts_at(*scene, row));
    if (study.poses_of.size() <= n) study.poses_of.resize(n + 1, 0);
    ++study.poses_of[n];
  }
  return study;
}

Files laxity_files(const LaxityStudy& study) {
  std::string text =
      "# Laxity at held flexion\n\n"
      "Written by `tools/figures`; do not edit. [SOURCE.md](SOURCE.md) says where the numbers of this knee are "
      "from.\n\n";
  if (!study.all_stable) return {{"STUDY.md", text + "Not every pose was solved and stable.\n"}};
  text += fmt::format("{} poses, all solved, certified and stable; {}.\n\n## Drawer\n\n", study.poses,
                      contacts_text(study));
  text += fmt::format(
      "At each angle of flexion the tibia is pulled forward with up to {:g} N, pushed backward with as much, and let "
      "go; displacements are\nthe tibia's along its own axis x, since no force. Stiffness is dF/du.\n\n",
      study.force);
  text += drawer_table(study) +
          "\n![Displacement and coupled rotation against force, at eight angles of flexion](study-force.svg)\n\n";
  text += fmt::format(
      "## Rotation\n\nAt each angle of flexion the tibia is turned inward with up to {:g} N m, outward with as much, "
      "and let go.\n\n",
      study.moment);
  text += twist_table(study) +
          "\n![Rotation and coupled displacement against moment, at eight angles of flexion](study-moment.svg)\n\n"
          "## Over flexion\n\n![Laxity and stiffness over flexion](study-flexion.svg)\n";
  const Chart force = load_chart(study.drawers, "Drawer at held flexion", "force on the tibia, positive forward [N]");
  const Chart moment =
      load_chart(study.twists, "Torsion at held flexion", "moment on the tibia, positive inward [N m]");
  return {{"study-force.svg", to_svg(force)},
          {"study-moment.svg", to_svg(moment)},
          {"study-flexion.svg", to_svg(flexion_chart(study))},
          {"STUDY.md", text}};
}

}  // namespace genu::studies
