#include "genu/api/results_of.h"

#include <limits>

#include "genu/api/table_of.h"
#include "genu/core/atomic_output.h"
#include "genu/model/generalised_forces.h"
#include "genu/results/report.h"
#include "genu/store/report.h"

namespace genu::api {

struct Results::Inside {
  std::shared_ptr<Ready> ready;
  std::shared_ptr<Solution> solution = std::make_shared<Solution>();  ///< of given poses its summary alone
  bool given = false;
  Table poses, events;
  std::optional<Table> error_bars;
  std::string verdict;
  std::vector<std::string> changes;
  std::vector<PoseRecord> records;  ///< of given poses
};

namespace {

/// "Changed since the file was read: AAC.stiffness = 18600 N (37200); without ACL*."
std::string sentence_of(const std::vector<std::string>& changes) {
  std::string all;
  for (const std::string& change : changes) all += (all.empty() ? "" : "; ") + change;
  return "Changed since the file was read: " + all + ".";
}

}  // namespace

Results results_of(std::shared_ptr<Ready> ready, Solution solution, std::vector<std::string> changes) {
  auto inside = std::make_shared<Results::Inside>();
  inside->ready = std::move(ready);
  inside->solution = std::make_shared<Solution>(std::move(solution));
  const Solution& kept = *inside->solution;
  const auto table = [&](const ResultTable& of_it) {
    return table_of(std::shared_ptr<const ResultTable>(inside->solution, &of_it));
  };
  inside->poses = table(kept.poses);
  inside->events = table(kept.event_rows);
  if (kept.error_bars) inside->error_bars = table(kept.error_bars->bars);
  inside->verdict = to_string(kept.summary.verdict_class);
  inside->changes = std::move(changes);
  inside->solution->summary.changed.words = inside->changes;
  return Results(std::move(inside));
}

Results results_of(std::shared_ptr<Ready> ready, std::vector<PoseRecord> records, ResultTable poses, RunSummary summary,
                   std::vector<std::string> changes) {
  auto inside = std::make_shared<Results::Inside>();
  inside->ready = std::move(ready);
  inside->given = true;
  inside->poses = table_of(std::move(poses));
  inside->verdict = "evaluated";
  inside->changes = std::move(changes);
  inside->records = std::move(records);
  inside->solution->summary = std::move(summary);
  inside->solution->summary.changed.words = inside->changes;
  return Results(std::move(inside));
}

const Table& Results::poses() const { return inside_->poses; }
const Table& Results::events() const { return inside_->events; }
const std::optional<Table>& Results::error_bars() const { return inside_->error_bars; }
const std::string& Results::verdict() const { return inside_->verdict; }
const std::vector<std::string>& Results::sentences() const { return inside_->solution->summary.verdict; }
bool Results::partial() const { return inside_->solution->summary.partial; }
int Results::asked() const { return inside_->solution->summary.poses_asked; }
int Results::solved() const { return inside_->solution->summary.poses_solved; }
const std::string& Results::title() const { return inside_->solution->summary.title; }
const std::vector<std::string>& Results::changes() const { return inside_->changes; }
std::string Results::summary_json() const { return to_json(inside_->solution->summary); }

std::vector<double> Results::coordinates() const {
  const auto free = free_coordinates(inside_->ready->prepared.model);
  std::vector<double> values;
  const auto add = [&](const State& state) {
    for (const CoordinateRef& c : free)
      values.push_back(state.coordinates.empty() ? std::numeric_limits<double>::quiet_NaN()
                                                 : state.coordinates[at(c.joint)][at(c.index)]);
  };
  for (const PoseRecord& r : inside_->given ? inside_->records : inside_->solution->records)
    add(r.point.pose.state.poses.empty() ? State() : r.point.pose.state);
  for (const MotionPoint& point : inside_->solution->motion) add(point.state);
  return values;
}

void Results::report(const std::string& file) const {
  if (inside_->given) refuse(Code::not_applicable, "report", {}, "shows poses that were solved, and these were given");
  if (const auto kept = why_not_replaced(file, kReportMark)) refuse(kept->code, {}, {}, kept->text);
  const Solution& solution = *inside_->solution;
  const std::string page = use(*inside_->ready, [&](const Prepared& prepared) {
    ReportRun run = report_run(prepared, solution);
    RunSummary summary = solution.summary;
    if (!inside_->changes.empty()) summary.verdict.push_back(sentence_of(inside_->changes));
    run.summary = &summary;
    return report_html({run});
  });
  if (const std::string why = write_file_atomically(file, page); !why.empty()) refuse(Code::cannot_write, {}, {}, why);
}

}  // namespace genu::api
