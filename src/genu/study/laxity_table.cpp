#include "genu/study/laxity_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/results/columns.h"
#include "genu/results/ligament_groups.h"
#include "genu/results/pose_table.h"
#include "genu/results/svg_text.h"
#include "genu/study/tolerances.h"

namespace genu {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Flush round-off: a prescribed value is a round number.
double degrees(double angle) { return std::round(1e9 * to::kDegree * angle) / 1e9; }

/// The other motions of a pose from the neutral one, in the unit and sign of the columns.
struct Coupled {
  const char* name;
  double (*of)(const KneeMotion&);
};
constexpr std::array<Coupled, 5> kCoupled = {{
    {"anterior_mm", [](const KneeMotion& m) { return to::kMillimetre * m.anterior; }},
    {"varus_deg", [](const KneeMotion& m) { return to::kDegree * m.adduction; }},
    {"internal_deg", [](const KneeMotion& m) { return -to::kDegree * m.external_rotation; }},
    {"lateral_mm", [](const KneeMotion& m) { return to::kMillimetre * m.lateral; }},
    {"distraction_mm", [](const KneeMotion& m) { return to::kMillimetre * m.distraction; }},
}};

/// Ligaments under one name: a bundle of the scene, or fibres with one name and numbers behind it.
struct Group {
  std::string name;
  std::vector<std::string> fibres;
};

std::vector<Group> groups_of(const SceneTables& scene) {
  std::vector<Group> groups;
  std::vector<bool> bundled(scene.ligaments.size());
  for (const BundleDef& bundle : scene.bundles) {
    if (bundle.members.empty()) continue;
    groups.push_back({bundle.name, {}});
    for (const int member : bundle.members) {
      groups.back().fibres.push_back(scene.ligaments[at(member)].name);
      bundled[at(member)] = true;
    }
  }
  for (const LigamentGroup& group : ligament_groups(scene)) {
    Group found{group.name, {}};
    for (const std::size_t member : group.members)
      if (!bundled[member]) found.fibres.push_back(scene.ligaments[member].name);
    if (!found.fibres.empty()) groups.push_back(std::move(found));
  }
  return groups;
}

/// All rows of a scene with the columns of results.csv: neutral poses, then the curves, angle by angle.
class Poses {
 public:
  explicit Poses(const LaxityOfScene& s) {
    const Prepared& p = s.knee.prepared;
    std::vector<PoseRecord> records;
    for (const LaxityAngle& angle : s.angles) {
      if (!angle.solved) continue;
      rows_.push_back({&angle, nullptr, &angle.neutral});
      for (const LaxityCurve& curve : angle.curves)
        for (const LaxityRow& row : curve.rows) rows_.push_back({&angle, &curve, &row});
    }
    for (const Row& row : rows_) records.push_back(row.row->record);
    table_ = pose_table(p.scene, p.model, p.steps, records);
  }

  struct Row {
    const LaxityAngle* angle;
    const LaxityCurve* curve;  ///< null: the neutral pose
    const LaxityRow* row;
  };
  const std::vector<Row>& rows() const { return rows_; }
  const ResultTable& table() const { return table_; }

  /// N: of a group in the pose; NaN where there is none.
  double force(const Group& group, const LaxityRow* pose) const {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      if (rows_[k].row != pose) continue;
      double sum = 0;
      for (const std::string& fibre : group.fibres) sum += table_.number(k, fibre + ".force_N");
      return sum;
    }
    return kNone;
  }

 private:
  std::vector<Row> rows_;
  ResultTable table_;
};

/// mm or deg from the neutral pose; NaN for none.
double displacement(const LaxityCurve& curve, const LaxityRow* row) {
  if (row == nullptr || curve.rows.empty()) return kNone;
  return curve.test.shown() *
         (curve.test.displacement(row->motion) - curve.test.displacement(curve.rows.front().motion));
}

/// N/mm or N m/deg.
double stiffness(const LaxityTest& test, const LaxityRow* row) {
  return row == nullptr ? kNone : 1 / (test.shown() * row->compliance);
}

void set_if(ResultTable& table, const std::string& column, double value) {
  if (std::isfinite(value)) table.set(column, value);
}

std::string text_of(const ResultTable& table, const std::vector<std::string>& skip, int digits) {
  std::vector<std::string> columns;
  for (const std::string& column : table.columns())
    if (std::find(skip.begin(), skip.end(), column) == skip.end()) columns.push_back(column);
  return to_text(table, columns, digits, table.rows());
}

/// The tests that were made, in their order.
std::vector<LaxityTest> tests_of(const std::vector<LaxityOfScene>& scenes) {
  for (const LaxityOfScene& s : scenes)
    for (const LaxityAngle& angle : s.angles) {
      std::vector<LaxityTest> tests;
      for (const LaxityCurve& curve : angle.curves) tests.push_back(curve.test);
      if (!tests.empty()) return tests;
    }
  return {};
}

const LaxityCurve* curve_of(const LaxityAngle& angle, const LaxityTest& test) {
  for (const LaxityCurve& curve : angle.curves)
    if (curve.test.kind == test.kind) return &curve;
  return nullptr;
}

/// "drawer, 134 N: mm each way, N/mm" and its table.
std::string laxity_of(const std::vector<LaxityOfScene>& scenes, const LaxityTest& test) {
  const std::string per = std::string(test.load_unit()) + "/" + test.unit();
  const std::string plus = test.direction(true), minus = test.direction(false), unit = test.unit();
  ResultTable table;
  for (const std::string& column :
       {std::string("flexion_deg"), plus + "_" + unit, minus + "_" + unit, "total_" + unit, std::string("at_0"),
        "at_" + plus, "at_" + minus, std::string("scene"), std::string("note")})
    table.add_column(column);
  bool any_note = false;
  for (const LaxityOfScene& s : scenes)
    for (const LaxityAngle& angle : s.angles) {
      const LaxityCurve* curve = curve_of(angle, test);
      table.add_row();
      table.set("flexion_deg", degrees(angle.flexion));
      table.set("scene", s.name);
      if (curve == nullptr || !curve->ended.empty())
        table.set("note", std::string(curve == nullptr ? "no neutral pose" : "ended, see below")), any_note = true;
      if (curve == nullptr) continue;
      const LaxityRow *up = curve->at(test.load), *down = curve->at(-test.load);
      const double a = displacement(*curve, up), b = displacement(*curve, down);
      set_if(table, plus + "_" + unit, a);
      set_if(table, minus + "_" + unit, b);
      set_if(table, "total_" + unit, a - b);
      set_if(table, "at_0", stiffness(test, curve->rows.empty() ? nullptr : &curve->rows.front()));
      set_if(table, "at_" + plus, stiffness(test, up));
      set_if(table, "at_" + minus, stiffness(test, down));
    }
  std::vector<std::string> skip;
  if (scenes.size() == 1) skip.emplace_back("scene");
  if (!any_note) skip.emplace_back("note");
  return fmt::format("{}, {:g} {} each way; stiffness in {}\n{}", test.name(), test.load, test.load_unit(), per,
                     text_of(table, skip, 2));
}

std::string coupled_motions(const std::vector<LaxityOfScene>& scenes, const std::vector<LaxityTest>& tests) {
  ResultTable table;
  for (const char* column : {"flexion_deg", "load"}) table.add_column(column);
  for (const Coupled& c : kCoupled) table.add_column(c.name);
  table.add_column("scene");
  for (const LaxityOfScene& s : scenes)
    for (const LaxityTest& test : tests)
      for (const LaxityAngle& angle : s.angles)
        for (const bool positive : {true, false}) {
          const LaxityCurve* curve = curve_of(angle, test);
          const LaxityRow* row = curve ? curve->at(positive ? test.load : -test.load) : nullptr;
          if (row == nullptr) continue;
          table.add_row();
          table.set("flexion_deg", degrees(angle.flexion));
          table.set("load", fmt::format("{:g} {} {}", test.load, test.load_unit(), test.direction(positive)));
          for (const Coupled& c : kCoupled) table.set(c.name, c.of(row->motion) - c.of(curve->rows.front().motion));
          table.set("scene", s.name);
        }
  std::vector<std::string> skip;
  if (scenes.size() == 1) skip.emplace_back("scene");
  return "motions from the neutral pose under the full loads\n" + text_of(table, skip, 2);
}

/// Where the joint rests without the loads of the tests.
std::string neutral_poses(const std::vector<LaxityOfScene>& scenes) {
  ResultTable table;
  table.add_column("flexion_deg");
  for (const Coupled& c : kCoupled) table.add_column(c.name);
  for (const char* column : {"stability", "scene"}) table.add_column(column);
  for (const LaxityOfScene& s : scenes)
    for (const LaxityAngle& angle : s.angles) {
      if (!angle.solved) continue;
      table.add_row();
      table.set("flexion_deg", degrees(angle.flexion));
      for (const Coupled& c : kCoupled) table.set(c.name, c.of(angle.neutral.motion));
      table.set("stability", std::string(to_string(angle.neutral.record.point.stability)));
      table.set("scene", s.name);
    }
  std::vector<std::string> skip;
  if (scenes.size() == 1) skip.emplace_back("scene");
  return "neutral poses (Grood and Suntay)\n" + text_of(table, skip, 2);
}

std::string forces(const std::vector<LaxityOfScene>& scenes, const std::vector<LaxityTest>& tests) {
  const std::vector<Group> groups = groups_of(scenes.front().knee.prepared.scene);
  if (groups.empty()) return {};
  ResultTable table;
  for (const char* column : {"flexion_deg", "load"}) table.add_column(column);
  for (const Group& group : groups) table.add_column(group.name);
  table.add_column("scene");
  for (const LaxityOfScene& s : scenes) {
    const Poses poses(s);
    const std::vector<Group> own = groups_of(s.knee.prepared.scene);
    const auto add = [&](const LaxityAngle& angle, const std::string& load, const LaxityRow* row) {
      if (row == nullptr) return;
      table.add_row();
      table.set("flexion_deg", degrees(angle.flexion));
      table.set("load", load);
      for (const Group& group : own)
        if (table.has_column(group.name)) set_if(table, group.name, poses.force(group, row));
      table.set("scene", s.name);
    };
    for (const LaxityAngle& angle : s.angles) {
      if (angle.solved) add(angle, "neutral", &angle.neutral);
      for (const LaxityTest& test : tests)
        for (const bool positive : {true, false})
          if (const LaxityCurve* curve = curve_of(angle, test))
            add(angle, fmt::format("{:g} {} {}", test.load, test.load_unit(), test.direction(positive)),
                curve->at(positive ? test.load : -test.load));
    }
  }
  std::vector<std::string> skip;
  if (scenes.size() == 1) skip.emplace_back("scene");
  return "forces of ligaments in N\n" + text_of(table, skip, 1);
}

/// "ok", or why a curve ends, each way.
std::string status_of(const LaxityAngle& angle, const LaxityCurve* curve) {
  if (curve == nullptr && angle.notes.empty()) return "no neutral pose";
  const std::vector<std::string>& sentences = curve != nullptr ? curve->ended : angle.notes;
  std::string status;
  for (const std::string& sentence : sentences) status += (status.empty() ? "" : "; ") + sentence;
  return status.empty() ? "ok" : status;
}

}  // namespace

bool is_laxity_column(const std::string& column) {
  for (const char* none : {"step", "increment", "time_s", "branch", "newton.iterations", "residual", "status"})
    if (column == none) return false;
  return column.find(".reaction_") == std::string::npos && !column.ends_with(".factor");
}

ResultTable laxity_rows(const std::vector<LaxityOfScene>& scenes) {
  ResultTable out;
  for (const char* column : {"scene", "flexion_deg", "test", "load_N", "load_Nm", "displacement_mm", "displacement_deg",
                             "stiffness_N_per_mm", "stiffness_Nm_per_deg"})
    out.add_column(column);
  for (const LaxityOfScene& s : scenes) {
    const Poses poses(s);
    for (const std::string& column : poses.table().columns())
      if (is_laxity_column(column) && !out.has_column(column)) out.add_column(column);
    for (std::size_t k = 0; k < poses.rows().size(); ++k) {
      const Poses::Row& row = poses.rows()[k];
      out.add_row();
      out.set("scene", s.name);
      out.set("flexion_deg", degrees(row.angle->flexion));
      out.set("test", std::string(row.curve ? row.curve->test.name() : "neutral"));
      if (row.curve) {
        const bool turns = row.curve->test.turns();
        out.set(turns ? "load_Nm" : "load_N", row.row->load);
        out.set(turns ? "displacement_deg" : "displacement_mm", displacement(*row.curve, row.row));
        out.set(turns ? "stiffness_Nm_per_deg" : "stiffness_N_per_mm", stiffness(row.curve->test, row.row));
      }
      for (std::size_t c = 0; c < poses.table().columns().size(); ++c)
        if (const std::string& column = poses.table().columns()[c]; is_laxity_column(column))
          out.set(column, poses.table().at(k, c));
    }
  }
  return out;
}

std::string laxity_csv(const std::vector<LaxityOfScene>& scenes) { return laxity_rows(scenes).to_csv(); }

ResultTable laxity_summary(const std::vector<LaxityOfScene>& scenes) {
  ResultTable table;
  for (const char* column : {"scene", "flexion_deg", "test", "load", "unit", "positive", "negative", "total",
                             "stiffness_0", "stiffness_positive", "stiffness_negative", "loop"})
    table.add_column(column);
  for (const char* side : {"positive", "negative"})
    for (const Coupled& c : kCoupled) table.add_column(std::string(side) + "." + c.name);
  table.add_column("status");
  for (const LaxityOfScene& s : scenes)
    for (const LaxityTest& test : tests_of(scenes))
      for (const LaxityAngle& angle : s.angles) {
        const LaxityCurve* curve = curve_of(angle, test);
        table.add_row();
        table.set("scene", s.name);
        table.set("flexion_deg", degrees(angle.flexion));
        table.set("test", std::string(test.name()));
        table.set("load", test.load);
        table.set("unit", fmt::format("{} {}", test.load_unit(), test.unit()));
        table.set("status", status_of(angle, curve));
        if (curve == nullptr) continue;
        const LaxityRow *up = curve->at(test.load), *down = curve->at(-test.load);
        const double a = displacement(*curve, up), b = displacement(*curve, down);
        table.set("positive", a);
        table.set("negative", b);
        table.set("total", a - b);
        table.set("stiffness_0", stiffness(test, curve->rows.empty() ? nullptr : &curve->rows.front()));
        table.set("stiffness_positive", stiffness(test, up));
        table.set("stiffness_negative", stiffness(test, down));
        table.set("loop", test.shown() * curve->loop());
        for (const auto& [side, row] : {std::pair("positive", up), std::pair("negative", down)})
          for (const Coupled& c : kCoupled)
            if (row != nullptr)
              table.set(std::string(side) + "." + c.name, c.of(row->motion) - c.of(curve->rows.front().motion));
      }
  return table;
}

std::string laxity_text(const std::vector<LaxityOfScene>& scenes) {
  const std::vector<LaxityTest> tests = tests_of(scenes);
  if (tests.empty()) return {};
  std::string text = neutral_poses(scenes) + "\n";
  for (const LaxityTest& test : tests) text += laxity_of(scenes, test) + "\n";
  return text + coupled_motions(scenes, tests) + "\n" + forces(scenes, tests);
}

Chart laxity_chart(const LaxityResult& result, const LaxityChoice& choice, const LaxityTest& test) {
  Chart chart;
  chart.title = fmt::format("{} ({}, + {})", test.name(), result.title, test.direction(true));
  chart.x_title = fmt::format("load [{}]", test.load_unit());
  for (int k = -choice.increments; k <= choice.increments; ++k) chart.x.push_back(test.load * k / choice.increments);
  for (const LaxityOfScene& s : result.scenes) {
    ChartPanel panel;
    panel.title = fmt::format("{}, {} [{}]", s.name, test.direction(true), test.unit());
    panel.from_zero = true;
    for (const LaxityAngle& angle : s.angles) {
      const LaxityCurve* curve = curve_of(angle, test);
      if (curve == nullptr) continue;
      const std::string name = fmt::format("{:g} deg", degrees(angle.flexion));
      ChartSeries forth{name, {}}, back{name + ", unloading", {}};
      for (const double load : chart.x) {
        forth.y.push_back(displacement(*curve, curve->at(load)));
        const auto same = [&](const LaxityRow& row) { return std::abs(row.load - load) <= kSameLoad * test.load; };
        const auto last = std::find_if(curve->rows.rbegin(), curve->rows.rend(), same);
        back.y.push_back(last == curve->rows.rend() ? kNone : displacement(*curve, &*last));
      }
      panel.series.push_back(std::move(forth));
      if (curve->loop() > kVisibleLoop) panel.series.push_back(std::move(back));
    }
    chart.panels.push_back(std::move(panel));
  }
  return chart;
}

std::string laxity_page(const LaxityResult& result, const std::string& pictures) {
  std::string page = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" +
                     svg_escaped(result.title) +
                     "</title>\n<style>body{font:15px/1.4 Helvetica,Arial,sans-serif;margin:2em;max-width:70em}"
                     "pre{font-size:12px;overflow-x:auto}svg{max-width:100%;height:auto}</style></head>\n<body><h1>" +
                     svg_escaped("Laxity: " + result.title) + "</h1>\n<ul>";
  for (const std::string& sentence : result.verdict) page += "<li>" + svg_escaped(sentence) + "</li>";
  return page + "</ul>\n" + pictures + "\n<pre>" + svg_escaped(result.text) + "</pre>\n</body></html>\n";
}

}  // namespace genu
