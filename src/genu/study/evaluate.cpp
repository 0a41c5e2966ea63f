#include "genu/study/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/appraise/hertz_check.h"
#include "genu/appraise/layer_verdict.h"
#include "genu/assemble/with_numbers.h"
#include "genu/core/atomic_output.h"
#include "genu/core/timer.h"
#include "genu/core/units.h"
#include "genu/model/ligament_pieces.h"
#include "genu/model/unbalanced.h"
#include "genu/results/curves.h"
#include "genu/results/pressure_map.h"
#include "genu/study/run_motion.h"
#include "genu/study/tolerances.h"

namespace genu {
namespace {

/// Every coordinate that some step prescribes and a reaction holds; a combination's multiplier is not that of one
/// coordinate.
std::vector<CoordinateRef> prescribed_somewhere(const std::vector<StepPlan>& steps) {
  std::vector<CoordinateRef> found;
  for (const StepPlan& step : steps)
    for (const auto& p : step.prescribed)
      if (p.coordinate.combination < 0 && p.drivers.empty() &&
          std::find(found.begin(), found.end(), p.coordinate.first) == found.end())
        found.push_back(p.coordinate.first);
  return found;
}

class Evaluator {
 public:
  Evaluator(const Prepared& prepared, ContactField& field)
      : prepared_(prepared), field_(field), prescribed_(prescribed_somewhere(prepared.steps)) {}

  PoseRecord at_pose(const GivenPose& given) {
    const JointModel& model = prepared_.model;
    PoseRecord record;
    PosePoint& point = record.point;
    point.step = given.step;
    point.increment = given.increment;
    point.target.time = given.time;
    point.target.load_factors = given.load_factors;
    point.report.status = PoseStatus::ok;
    State& state = point.pose.state;
    state.coordinates = given.coordinates;
    state.poses = poses_from_coordinates(model, given.coordinates);
    reset_pieces(model, state);
    add_gaps(record);
    const Unbalanced missing = unbalanced(model, state, point.target, memory_);
    state.layer_levels = missing.layer_levels;
    look_for_flaws(point);
    look_for_buried(point);
    record.given = PoseRecord::Given{missing.wrenches, missing.forces && model.pairs.empty()};
    if (record.given->reactions) add_reactions(*missing.forces, point);
    return record;
  }

 private:
  void look_for_flaws(PosePoint& point) {
    if (!field_.any_doubtful()) return;
    std::vector<Candidate> touching;
    for (const OpenContact& c : point.pose.open)
      if (c.gap <= 0) touching.push_back({c.pair, {c.geometry, c.gap}});
    const DoubtfulPlace* place = field_.doubtful(point.pose.state, touching);
    if (place == nullptr) return;
    point.report.status = PoseStatus::flawed_mesh;
    point.report.why = place->what;
  }

  void look_for_buried(PosePoint& point) {
    const auto buried = field_.buried(point.pose.state);
    if (!buried) return;
    const auto& layer = prepared_.model.layers[at(buried->layer)];
    point.report.status = PoseStatus::overlap;
    point.report.why = fmt::format("{} by {:.3f} mm, search_depth {:.3g} mm", layer.name,
                                   to::kMillimetre * buried->depth, to::kMillimetre * layer.search_depth);
  }

  void add_gaps(PoseRecord& record) {
    const State& state = record.point.pose.state;
    const int pairs = static_cast<int>(prepared_.model.pairs.size());
    record.point.pose.last_number.assign(at(pairs), 0);
    for (int pair = 0; pair < pairs; ++pair) {
      record.pair_gap.push_back(field_.smallest_gap(state, pair));
      if (const auto nearest = field_.nearest(state, pair))
        record.point.pose.open.push_back({pair, 0, nearest->contact, nearest->gap});
    }
  }

  void add_reactions(const std::vector<JointValues>& forces, PosePoint& point) const {
    State& state = point.pose.state;
    for (const CoordinateRef& c : prescribed_) {
      point.target.prescribed.push_back({c, state.coordinates[at(c.joint)][at(c.index)]});
      state.multipliers.push_back(forces[at(c.joint)][at(c.index)]);
    }
    for (const auto& held : prepared_.model.held)
      state.multipliers.push_back(forces[at(held.coordinate.joint)][at(held.coordinate.index)]);
  }

  const Prepared& prepared_;
  ContactField& field_;
  std::vector<CoordinateRef> prescribed_;
  Linearization memory_;
};

/// "largest missing force 12.3 N, on tibia in row 4"
std::string largest_missing(const JointModel& model, const std::vector<PoseRecord>& records) {
  double force = -1;
  std::size_t row = 0;
  const JointModel::Body* body = nullptr;
  for (std::size_t r = 0; r < records.size(); ++r)
    for (const auto& b : model.bodies) {
      if (b.moving < 0) continue;
      const double f = records[r].given->missing[at(b.moving)].head<3>().norm();
      if (!(f > force)) continue;
      force = f;
      row = r + 1;
      body = &b;
    }
  if (body == nullptr) return {};
  return fmt::format("largest force missing {:.4g} N, on {} in row {}", force, body->name, row);
}

/// "In 3 rows the contact touches a flaw of a mesh, first in row 7: ..."
void say_status(const std::vector<PoseRecord>& records, PoseStatus status, const char* what,
                std::vector<std::string>& out) {
  const auto has = [&](const PoseRecord& r) { return r.point.report.status == status; };
  const auto first = std::find_if(records.begin(), records.end(), has);
  if (first == records.end()) return;
  const auto count = std::count_if(records.begin(), records.end(), has);
  out.push_back(fmt::format("In {} row{} {}, first in row {}: {}.", count, count == 1 ? "" : "s", what,
                            first - records.begin() + 1, first->point.report.why));
}

void add_verdict(const Prepared& p, const std::vector<PoseRecord>& records, const ResultTable& poses, RunSummary& s) {
  s.verdict.push_back(fmt::format(
      "{} pose{} evaluated, none solved. The residual columns hold the forces missing for equilibrium ({}).",
      records.size(), records.size() == 1 ? "" : "s", largest_missing(p.model, records)));
  if (s.smallest_gap < -kContactRounding)
    s.verdict.push_back(fmt::format("Rigid surfaces overlap by up to {:.4g} mm.", -to::kMillimetre * s.smallest_gap));
  else if (s.smallest_gap < 0)
    s.verdict.push_back(fmt::format("Rigid surfaces are in contact (smallest gap {:.1g} mm, which is rounding).",
                                    to::kMillimetre * s.smallest_gap));
  say_status(records, PoseStatus::flawed_mesh, "the contact touches a flaw of a mesh", s.verdict);
  say_status(records, PoseStatus::overlap, "a layer overlaps deeper than its search depth and carries no load there",
             s.verdict);
  for (std::string& sentence : layer_sentences(p.scene, p.model, poses)) s.verdict.push_back(std::move(sentence));
  say_layer_doubts(p, records, s.verdict);
  for (std::string& sentence : hertz_sentences(s.hertz)) s.verdict.push_back(std::move(sentence));
  if (s.given->left_out > 0)
    s.verdict.push_back(fmt::format("{} row{} of {} hold{} no solved pose: left out.", s.given->left_out,
                                    s.given->left_out == 1 ? "" : "s", s.given->file,
                                    s.given->left_out == 1 ? "s" : ""));
}

RunSummary::GivenPoses facts_of(const SceneTables& scene, const PoseFile& file, const PoseColumns& columns) {
  RunSummary::GivenPoses facts;
  facts.file = file.path;
  const auto name = [&](std::size_t c) { return file.names.cells[c].text; };
  for (const PoseColumns::Match& m : columns.coordinates)
    facts.columns.push_back({name(m.column), coordinate_name(scene, m.coordinate), m.unit_name, m.how});
  for (const TransformColumns& t : columns.transforms)
    facts.columns.push_back({name(t.columns.front()) + " ... " + name(t.columns.back()), scene.joints[at(t.joint)].name,
                             t.unit_name, t.how});
  if (columns.time) facts.columns.push_back({name(*columns.time), "time", "s", "time"});
  for (const auto& f : columns.factors)
    facts.columns.push_back({name(f.column), scene.loads[at(f.load)].name + ".factor", "1", "as in results.csv"});
  for (const std::size_t c : columns.ignored) facts.ignored.push_back(name(c));
  return facts;
}

/// A load that drives a coordinate has no factor of its own: the table has to have one.
bool has_driving_factors(const SceneTables& scene, const PoseFile& file, const PoseColumns& columns, Diagnostics& out) {
  std::vector<int> asked;
  for (const StepDef& step : scene.steps)
    for (const StepDef::Prescribed& p : step.prescribe)
      for (const int load : p.drivers) {
        const auto given = [&](const PoseColumns::Factor& f) { return f.load == load; };
        if (std::any_of(columns.factors.begin(), columns.factors.end(), given)) continue;
        if (std::find(asked.begin(), asked.end(), load) != asked.end()) continue;
        asked.push_back(load);
        out.add(error_at({file.path, {file.names.line, 1}}, Code::missing_key, scene.loads[at(load)].name + ".factor",
                         {},
                         "is no column: the load drives " + quantity_name(scene, p.coordinate) +
                             ", so its factor is an unknown of every pose; add the column, as results.csv of a run has "
                             "it, or leave the load out with --without " +
                             scene.loads[at(load)].name));
      }
  return asked.empty();
}

/// The chart of a run without the panels that nobody can fill, over time where nothing better is known.
std::string picture(const Prepared& prepared, const Evaluation& evaluation) {
  Chart chart = curves(prepared.scene, prepared.steps, evaluation.poses, {});
  const auto& records = evaluation.records;
  const bool timed = !records.empty() && std::isfinite(records.front().point.target.time);
  if (timed && chart.x_title.rfind("row", 0) == 0) {
    chart.x_title = "time [s]";
    for (std::size_t k = 0; k < records.size(); ++k) chart.x[k] = records[k].point.target.time;
  }
  const auto finite = [](double y) { return std::isfinite(y); };
  std::erase_if(chart.panels, [&](ChartPanel& panel) {
    std::erase_if(panel.series, [&](const ChartSeries& s) { return std::none_of(s.y.begin(), s.y.end(), finite); });
    return panel.series.empty();
  });
  return to_svg(chart);
}

std::string write_evaluation(const std::string& folder, const Prepared& prepared, const Evaluation& evaluation,
                             const std::vector<std::pair<std::string, std::string>>& maps) {
  StagedFolder out("results");
  std::string error = text_of(out.open(folder));
  const auto write = [&](const std::string& name, const std::string& content) {
    if (error.empty()) error = write_file_atomically(out.path() / name, content);
  };
  const std::string table = evaluation.poses.to_csv();
  write("results.csv", table);
  write("curves.svg", picture(prepared, evaluation));
  RunSummary summary = evaluation.summary;
  summary.results = {evaluation.poses.rows(), checksum(table)};
  note_files(prepared, summary);
  write("summary.json", to_json(summary));
  for (const auto& [name, content] : maps) write(name, content);
  if (error.empty()) error = out.commit();
  return error;
}

}  // namespace

Evaluation evaluate(const Prepared& prepared, ContactField& field, const GivenPoses& given,
                    const EvaluateOptions& options) {
  const Timer timer;
  Evaluation out;
  RunSummary& s = out.summary;
  s = begin_summary(prepared);
  s.smallest_gap = std::numeric_limits<double>::infinity();
  s.poses_asked = static_cast<int>(given.poses.size());
  s.given = RunSummary::GivenPoses{};
  s.given->left_out = given.left_out;
  Evaluator evaluator(prepared, field);
  for (const GivenPose& pose : given.poses) {
    if (asked_to_stop(options.cancelled)) break;
    out.records.push_back(evaluator.at_pose(pose));
    for (const double gap : out.records.back().pair_gap) s.smallest_gap = std::min(s.smallest_gap, gap);
  }
  s.poses_solved = static_cast<int>(out.records.size());
  s.exit_code = s.poses_solved == s.poses_asked ? kExitOk : kExitIncomplete;
  out.poses = pose_table(prepared.scene, prepared.model, prepared.steps, out.records);
  s.hertz = hertz_checks(prepared, out.records, out.poses);
  s.seconds.emplace_back("evaluating", timer.seconds());
  return out;
}

std::optional<Evaluation> evaluate_file(const Prepared& prepared, PoseFile file, const EvaluateOptions& options,
                                        Diagnostics& out) {
  const auto columns = match_columns(prepared.scene, file, options.columns, out);
  if (!columns || !has_driving_factors(prepared.scene, file, *columns, out)) return std::nullopt;
  const auto given = read_given_poses(prepared.scene, file, *columns, out);
  if (!given) return std::nullopt;
  const auto facts = facts_of(prepared.scene, file, *columns);
  file = {};  // its words take as much room as what follows
  ContactField field = contact_field(prepared);
  Evaluation found = evaluate(prepared, field, *given, options);
  found.summary.given = facts;
  found.summary.given->left_out = given->left_out;
  add_verdict(prepared, found.records, found.poses, found.summary);
  return found;
}

int evaluate_scene(const SceneSource& source, const std::string& poses, const std::string& folder,
                   const EvaluateOptions& options, Diagnostics& out, Evaluation* evaluation) {
  const auto prepared = prepare_run(source, folder, out, {poses});
  auto file = read_pose_file(poses, out);
  if (!prepared || !file || refuse_motion(*prepared, "evaluate", out)) return kExitRefused;
  auto evaluated = evaluate_file(*prepared, std::move(*file), options, out);
  if (!evaluated) return kExitRefused;
  Evaluation& found = *evaluated;
  RunOptions same;
  same.cancelled = options.cancelled;
  found.folder = folder_for(folder, same, found.summary);
  int code = found.summary.exit_code;
  const auto maps = options.pressure_maps ? pressure_maps(prepared->scene, prepared->model, found.records)
                                          : std::vector<std::pair<std::string, std::string>>();
  for (const auto& [name, content] : maps) found.pressure_files.push_back(name);
  if (const std::string error = write_evaluation(found.folder, *prepared, found, maps); !error.empty()) {
    out.error(Code::cannot_write, {}, error);
    code = kExitFailed;
  }
  if (evaluation != nullptr) *evaluation = std::move(found);
  return code;
}

}  // namespace genu
