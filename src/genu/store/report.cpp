#include "genu/store/report.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "genu/core/timer.h"
#include "genu/core/units.h"
#include "genu/results/columns.h"
#include "genu/results/curves.h"
#include "genu/results/extensor_columns.h"
#include "genu/results/report_plots.h"
#include "genu/results/report_pressures.h"
#include "genu/store/report_meshes.h"
#include "genu/store/report_rows.h"
#include "genu/store/report_wraps.h"

namespace genu {
namespace {

const Vec3 kNowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());

/// The state of each row, solved or not, whose coordinates are in results.csv; null without them.
std::vector<const State*> states_of(const Solution& solution) {
  std::vector<const State*> states;
  for (const PoseRecord& record : solution.records)
    states.push_back(record.point.pose.state.poses.empty() ? nullptr : &record.point.pose.state);
  for (const MotionPoint& point : solution.motion) states.push_back(&point.state);
  return states;
}

ReportContact contact_named(std::string name, const std::string& surface, int body_a, int body_b, std::size_t rows) {
  return {
      std::move(name), surface, body_a, body_b, std::vector<Vec3>(rows, kNowhere), std::vector<Vec3>(rows, kNowhere)};
}

const std::string& surface_b(const PlacedScene& scene, const ContactDef& contact) {
  return scene.surfaces[at(contact.surface_b)].name;
}

void add_rigid(const Prepared& p, const std::vector<const State*>& states, std::vector<ReportContact>& out) {
  std::map<std::pair<int, int>, ReportContact> contacts;  // by pair and number
  std::vector<int> numbers(p.model.pairs.size(), 0);
  for (const State* state : states)
    for (std::size_t i = 0; state != nullptr && i < state->contacts.size(); ++i)
      numbers[at(state->contacts[i].pair)] = std::max(numbers[at(state->contacts[i].pair)], state->contacts[i].number);
  for (std::size_t row = 0; row < states.size(); ++row) {
    if (states[row] == nullptr) continue;
    for (const ActiveContact& c : states[row]->contacts) {
      const JointModel::Pair& pair = p.model.pairs[at(c.pair)];
      auto [place, fresh] = contacts.try_emplace({c.pair, c.number});
      if (fresh)
        place->second =
            contact_named(numbers[at(c.pair)] > 1 ? fmt::format("{}.{}", pair.name, c.number) : pair.name,
                          surface_b(p.scene, p.scene.contacts[at(c.pair)]), pair.body_a, pair.body_b, states.size());
      place->second.point[row] = c.geometry.b.p;
      place->second.force[row] = -c.force * c.geometry.b.n;
    }
  }
  for (auto& [key, contact] : contacts) out.push_back(std::move(contact));
}

/// Three columns as a vector; NaN where a cell is empty.
Vec3 vector_at(const ResultTable& table, std::size_t row, const std::string& before, const char* after) {
  Vec3 v = kNowhere;
  for (Eigen::Index i = 0; i < 3; ++i)
    if (const std::string name = fmt::format("{}{}{}", before, "xyz"[i], after); table.has_column(name))
      v[i] = table.number(row, name);
  return v;
}

/// One elastic layer, or a region of it: what its columns in results.csv say.
void add_layer_part(const Prepared& p, std::size_t layer, const std::string& name, const std::string& centre,
                    const ResultTable& poses, std::vector<ReportContact>& out) {
  const JointModel::Layer& model = p.model.layers[layer];
  const Vec3& origin = p.model.bodies[at(model.body_b)].centre;
  ReportContact c =
      contact_named(name, surface_b(p.scene, p.scene.layers[layer].pair), model.body_a, model.body_b, poses.rows());
  bool any = false;
  for (std::size_t row = 0; row < poses.rows(); ++row) {
    const Vec3 point = units::kMillimetre * vector_at(poses, row, centre, "_mm") - origin,
               force = vector_at(poses, row, name + ".force_", "_N");
    if (!point.allFinite() || !force.allFinite() || !(force.norm() > 0)) continue;
    c.point[row] = point;
    c.force[row] = force;
    any = true;
  }
  if (any) out.push_back(std::move(c));
}

std::vector<ReportContact> contacts_of(const Prepared& p, const Solution& solution,
                                       const std::vector<const State*>& states) {
  std::vector<ReportContact> out;
  add_rigid(p, states, out);
  for (std::size_t k = 0; k < p.scene.layers.size(); ++k) {
    const ContactDef& pair = p.scene.layers[k].pair;
    for (const RegionDef& region : pair.regions) {
      const std::string name = pair.name + "." + region.name;
      add_layer_part(p, k, name, name + ".", solution.poses, out);
    }
    if (pair.regions.empty())
      add_layer_part(p, k, pair.name, pair.name + "." + surface_b(p.scene, pair) + ".", solution.poses, out);
  }
  return out;
}

/// The course in each row; nothing where the path wraps round no surface.
void add_course(const JointModel& model, const LigamentPath& path, int ligament,
                const std::vector<const State*>& states, std::vector<ReportPath>& out) {
  constexpr double kSpacing = 1e-3;  // m: as fine as a page shows
  if (path.obstacles().empty()) return;
  ReportPath& drawn = out.emplace_back();
  drawn.ligament = ligament;
  for (const State* state : states) {
    auto& row = drawn.rows.emplace_back();
    if (state == nullptr || state->wraps.size() != model.reference_wraps.size()) continue;
    path.for_each_place(state->wraps, kSpacing, [&](int body, const Vec3& p) { row.push_back({body, p}); });
  }
}

void add_paths(const JointModel& model, const std::vector<const State*>& states, ReportRun& run) {
  for (std::size_t l = 0; l < model.ligaments.size(); ++l)
    add_course(model, model.ligaments[l].path, static_cast<int>(l), states, run.wrapped);
  for (const Load& load : model.loads)
    if (load.kind == Load::Kind::cable) add_course(model, load.path, -1, states, run.cables);
}

/// Of loads and muscles that change: what an isometric test is about.
std::vector<std::string> load_axes(const PlacedScene& scene, const ResultTable& poses) {
  std::vector<std::string> out;
  for (const ExtensorMechanism& one : extensor_mechanisms(scene)) out.push_back(one.quadriceps_column());
  for (const LoadDef& load : scene.loads) out.push_back(load.name + ".factor");
  std::erase_if(out, [&](const std::string& name) {
    if (!poses.has_column(name)) return true;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t row = 0; row < poses.rows(); ++row)
      if (const double value = poses.number(row, name); std::isfinite(value))
        low = std::min(low, value), high = std::max(high, value);
    return !(high > low);
  });
  return out;
}

/// Columns that may be the axis of curves: time, coordinates, combinations, Grood and Suntay's, loads.
std::vector<std::string> axes_of(const PlacedScene& scene, const ResultTable& poses) {
  std::vector<std::string> out = {"time_s"};
  for (int j = 0; j < static_cast<int>(scene.joints.size()); ++j)
    for (int i = 0; i < 6; ++i) out.push_back(coordinate_column(scene, CoordinateRef{j, i}));
  for (int c = 0; c < static_cast<int>(scene.combinations.size()); ++c) {
    QuantityRef q;
    q.combination = c;
    out.push_back(quantity_name(scene, q) + "_deg");
    out.push_back(quantity_name(scene, q) + "_mm");
  }
  for (const JointDef& joint : scene.joints)
    for (std::size_t i = 0; i < kClinicalColumns; ++i) out.push_back(clinical_column(joint, i));
  for (std::string& name : load_axes(scene, poses)) out.push_back(std::move(name));
  std::erase_if(out, [&](const std::string& name) { return !poses.has_column(name); });
  return out;
}

/// "knee.flexion_deg" of the axis "knee.flexion [deg]".
std::string column_of_title(const std::string& title) {
  const std::size_t open = title.find(" [");
  return open == std::string::npos ? std::string()
                                   : title.substr(0, open) + "_" + title.substr(open + 2, title.size() - open - 3);
}

/// Whether a prescribed angle is held while loads change.
bool is_isometric(const Prepared& p, const ResultTable& poses) {
  bool held = false;
  for (const StepPlan& step : p.steps)
    for (const auto& prescribed : step.prescribed) {
      if (prescribed.from != prescribed.to) return false;
      held |= prescribed.coordinate.is_rotation();
    }
  return held && !load_axes(p.scene, poses).empty();
}

/// What the curves are over, of an isometric test the load; where they are over rows, the prescribed coordinate that
/// changes most, angles first.
std::string main_coordinate(const Prepared& p, const ResultTable& poses, const Chart& chart) {
  if (is_isometric(p, poses)) return load_axes(p.scene, poses).front();
  if (std::string column = column_of_title(chart.x_title); poses.has_column(column)) return column;
  std::string best;
  std::pair<bool, double> most{false, 0};
  for (const StepPlan& step : p.steps)
    for (const auto& prescribed : step.prescribed) {
      const std::pair<bool, double> here{prescribed.coordinate.is_rotation(),
                                         std::abs(prescribed.to - prescribed.from)};
      if (!(here.second > 0) || !(here > most)) continue;
      most = here;
      best = coordinate_column(p.scene, prescribed.coordinate);
    }
  return poses.has_column(best) ? best : std::string();
}

}  // namespace

ReportRun report_run(const Prepared& p, const Solution& solution, std::vector<ReportBeside> beside,
                     const ReportLimits& limits) {
  ReportRun run;
  run.scene = &p.scene;
  run.model = &p.model;
  run.summary = &solution.summary;
  run.poses = &solution.poses;
  run.events = &solution.event_rows;
  if (const auto text = p.meshes ? p.meshes->files().bytes(p.scene.file) : nullptr) run.scene_text = *text;
  const ResultTable* bars = solution.error_bars ? &solution.error_bars->bars : nullptr;
  run.chart = curves(p.scene, p.steps, solution.poses, solution.events, bars);
  add_report_plots(p.scene, solution.poses, run.chart);
  run.coordinates = axes_of(p.scene, solution.poses);
  run.main_coordinate = main_coordinate(p, solution.poses, run.chart);
  run.beside = std::move(beside);
  std::vector<const State*> states = states_of(solution);
  for (const State* state : states) run.body_poses.push_back(state != nullptr ? state->poses : std::vector<Pose>());
  add_paths(p.model, states, run);
  run.contacts = contacts_of(p, solution, states);
  run.meshes = report_meshes(p, run, limits.triangles);
  cut_wrapped(p, run);
  thin_meshes(run.meshes, limits.triangles_in_all);
  cut_lists(run, limits);
  if (const std::vector<std::size_t> rows = thin_rows(run, limits.numbers); !rows.empty()) {
    std::vector<const State*> kept;
    for (const std::size_t row : rows) kept.push_back(states[row]);
    states = std::move(kept);
  }
  run.pressures = report_pressures(p.scene, p.model, states, run.meshes);
  run.left_out = left_out(run);
  return run;
}

void add_report(const Prepared& prepared, Solution& solution, std::vector<std::pair<std::string, std::string>>& files,
                const std::vector<ReportPicture>& pictures, std::vector<ReportBeside> beside) {
  const Timer timer;
  const ReportRun run = report_run(prepared, solution, std::move(beside));
  files.emplace_back("report.html", report_html({run}, pictures));
  solution.summary.seconds.emplace_back("report", timer.seconds());
}

}  // namespace genu
