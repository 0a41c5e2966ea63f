#include "genu/study/envelope_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/results/pose_table.h"
#include "genu/study/laxity_table.h"
#include "genu/study/tolerances.h"

namespace genu {
namespace {

constexpr double kNoPose = std::numeric_limits<double>::quiet_NaN();

/// Flush round-off: the flexions of rows are round numbers.
double flexion_degrees(double angle) { return std::round(1e9 * to::kDegree * angle) / 1e9; }

/// mm or deg from the path without load at the same flexion; NaN where one of them has no pose.
double shift_from_free(const LaxityOfScene& s, const LaxityTest& test, double flexion, const LaxityRow* pose) {
  const LaxityRow* free = s.envelope.empty() ? nullptr : s.envelope.front().at(flexion);
  if (free == nullptr || pose == nullptr) return kNoPose;
  return test.shown() * (test.displacement(pose->motion) - test.displacement(free->motion));
}

const EnvelopePath* held_path(const LaxityOfScene& s, const LaxityTest& test, bool positive) {
  for (const EnvelopePath& path : s.envelope)
    if (path.held != 0 && path.test.kind == test.kind && (path.held > 0) == positive) return &path;
  return nullptr;
}

/// "134 N anterior"
std::string held_words(const LaxityTest& test, double load) {
  return fmt::format("{:.4g} {} {}", std::abs(load), test.load_unit(), test.direction(load > 0));
}

/// "drawer, 134 N held while the knee bends" and its table.
std::string held_text(const std::vector<LaxityOfScene>& scenes, const LaxityChoice& choice, const LaxityTest& test) {
  const std::string unit = test.unit(), plus = test.direction(true) + "_" + unit,
                    minus = test.direction(false) + "_" + unit;
  ResultTable table;
  for (const std::string& column : {std::string("flexion_deg"), plus, minus, "total_" + unit}) table.add_column(column);
  if (scenes.size() > 1) table.add_column("scene");
  for (const LaxityOfScene& s : scenes)
    for (const double flexion : choice.flexions) {
      const EnvelopePath *up = held_path(s, test, true), *down = held_path(s, test, false);
      const double a = shift_from_free(s, test, flexion, up ? up->at(flexion) : nullptr),
                   b = shift_from_free(s, test, flexion, down ? down->at(flexion) : nullptr);
      table.add_row();
      table.set("flexion_deg", flexion_degrees(flexion));
      for (const auto& [column, value] : {std::pair(plus, a), std::pair(minus, b), std::pair("total_" + unit, a - b)})
        if (std::isfinite(value)) table.set(column, value);
      if (scenes.size() > 1) table.set("scene", s.name);
    }
  return fmt::format("{}, {:g} {} held while the knee bends: {} from the path without load\n{}", test.name(), test.load,
                     test.load_unit(), unit, to_text(table, table.columns(), 2, table.rows()));
}

}  // namespace

ResultTable envelope_rows(const std::vector<LaxityOfScene>& scenes) {
  ResultTable out;
  for (const char* column :
       {"scene", "flexion_deg", "test", "load_N", "load_Nm", "displacement_mm", "displacement_deg"})
    out.add_column(column);
  for (const LaxityOfScene& s : scenes) {
    std::vector<PoseRecord> records;
    for (const EnvelopePath& path : s.envelope)
      for (const EnvelopePath::Row& row : path.rows) records.push_back(row.pose.record);
    const Prepared& p = s.knee.prepared;
    const ResultTable poses = pose_table(p.scene, p.model, p.steps, records);
    for (const std::string& column : poses.columns())
      if (is_laxity_column(column) && !out.has_column(column)) out.add_column(column);
    std::size_t k = 0;
    for (const EnvelopePath& path : s.envelope)
      for (const EnvelopePath::Row& row : path.rows) {
        out.add_row();
        out.set("scene", s.name);
        out.set("flexion_deg", flexion_degrees(row.flexion));
        out.set("test", std::string(path.held == 0 ? "neutral" : path.test.name()));
        if (path.held != 0) {
          const bool turns = path.test.turns();
          out.set(turns ? "load_Nm" : "load_N", path.held);
          const double shift = shift_from_free(s, path.test, row.flexion, &row.pose);
          if (std::isfinite(shift)) out.set(turns ? "displacement_deg" : "displacement_mm", shift);
        }
        for (std::size_t c = 0; c < poses.columns().size(); ++c)
          if (is_laxity_column(poses.columns()[c])) out.set(poses.columns()[c], poses.at(k, c));
        ++k;
      }
  }
  return out;
}

std::string envelope_text(const std::vector<LaxityOfScene>& scenes, const LaxityChoice& choice) {
  std::string text;
  for (const LaxityTest& test : choice.tests) text += (text.empty() ? "" : "\n") + held_text(scenes, choice, test);
  return text;
}

Chart envelope_chart(const LaxityResult& result, const LaxityTest& test) {
  Chart chart;
  chart.title =
      fmt::format("{}, {:g} {} held while the knee bends ({})", test.name(), test.load, test.load_unit(), result.title);
  chart.x_title = "flexion [deg]";
  std::set<double> flexions;
  for (const LaxityOfScene& s : result.scenes)
    for (const EnvelopePath& path : s.envelope)
      for (const EnvelopePath::Row& row : path.rows) flexions.insert(flexion_degrees(row.flexion));
  chart.x.assign(flexions.begin(), flexions.end());
  for (const LaxityOfScene& s : result.scenes) {
    ChartPanel panel;
    panel.title = fmt::format("{}, {} [{}]", s.name, test.direction(true), test.unit());
    panel.from_zero = true;
    for (const bool positive : {true, false}) {
      const EnvelopePath* path = held_path(s, test, positive);
      if (path == nullptr) continue;
      ChartSeries series{held_words(test, path->held), {}};
      for (const double x : chart.x) {
        const double flexion = units::kDegree * x;
        series.y.push_back(shift_from_free(s, test, flexion, path->at(flexion)));
      }
      panel.series.push_back(std::move(series));
    }
    chart.panels.push_back(std::move(panel));
  }
  return chart;
}

std::vector<std::string> envelope_notes(const LaxityOfScene& tested, int& ended) {
  std::vector<std::string> notes;
  for (const EnvelopePath& path : tested.envelope)
    if (!path.ended.empty()) {
      notes.push_back(
          (path.held == 0 ? std::string("The path without load") : held_words(path.test, path.held) + " held") + ": " +
          path.ended + ".");
      ++ended;
    }
  for (const EnvelopePath& path : tested.envelope)
    for (const LaxityAngle& angle : tested.angles)
      for (const LaxityCurve& curve : angle.curves) {
        if (path.held == 0 || curve.test.kind != path.test.kind) continue;
        const LaxityRow *held = path.at(angle.flexion), *loaded = curve.at(path.held);
        if (held == nullptr || loaded == nullptr) continue;
        const double apart = curve.test.displacement(held->motion) - curve.test.displacement(loaded->motion);
        if (std::abs(apart) > kVisibleLoop)
          notes.push_back(
              fmt::format("{} at {:g} deg: held from the smallest flexion on, it ends {:.3g} {} from where it "
                          "ends if it is put on there; more than one pose is in equilibrium.",
                          held_words(path.test, path.held), flexion_degrees(angle.flexion),
                          path.test.shown() * std::abs(apart), path.test.unit()));
      }
  return notes;
}

}  // namespace genu
