#include "genu/calibrate/run_experiment.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "genu/results/columns.h"
#include "genu/study/run_motion.h"
#include "genu/study/solve_path.h"
#include "genu/study/tolerances.h"

namespace genu {

std::vector<TargetAxis> axes_of(const Prepared& prepared) {
  std::vector<TargetAxis> axes;
  if (prepared.scene.dynamics || prepared.steps.empty()) return axes;
  for (const auto& first : prepared.steps.front().prescribed) {
    const double start = shown_value(first.coordinate, first.from);
    TargetAxis axis{coordinate_column(prepared.scene, first.coordinate), start, start};
    bool grows = true, falls = true, all = true;
    for (const StepPlan& step : prepared.steps) {
      const auto same = [&](const auto& p) { return p.coordinate == first.coordinate; };
      const auto p = std::find_if(step.prescribed.begin(), step.prescribed.end(), same);
      all = all && p != step.prescribed.end();
      if (!all) break;
      grows = grows && p->to > p->from;
      falls = falls && p->to < p->from;
      for (const double end : {shown_value(p->coordinate, p->from), shown_value(p->coordinate, p->to)})
        axis.low = std::min(axis.low, end), axis.high = std::max(axis.high, end);
    }
    if (all && (grows || falls)) axes.push_back(axis);
  }
  return axes;
}

namespace {

class RunExperiment : public CalibrationExperiment {
 public:
  RunExperiment(const Prepared& prepared, const std::vector<CalibrationUnknown>& unknowns, CalibrationTarget target,
                const RunOptions& options)
      : scene_(prepared, unknowns), target_(std::move(target)) {
    options_.path = options.path;
    options_.cancelled = options.cancelled;
    for (const auto& c : target_.columns) columns_.push_back({c.name, c.scale});
    for (const auto& v : target_.values) values_.push_back({v.column, v.value});
    if (!prepared.scene.dynamics) choose_outputs(prepared);
  }

  CalibrationPrediction predict(const VecX& u, bool derivatives) const override {
    CalibrationPrediction out;
    const auto p = scene_.with(u);
    if (!p) {
      out.failed = "a ligament's law cannot be with these numbers";
      return out;
    }
    if (p->scene.dynamics) {
      const Solution s = solve_motion(*p, options_);
      take(s.poses, s.summary.poses_solved == s.summary.poses_asked, out);
      return out;
    }
    ContactField field = contact_field(*p);
    const Solved s = solve_path(*p, field, options_);
    const ResultTable table = pose_table(p->scene, p->model, p->steps, s.records);
    take(table, s.solved() == s.asked, out);
    if (out.values.size() == 0) return out;
    out.stretch = scene_.no_stretch();
    for (const PoseRecord& record : s.records) scene_.note_stretch(*p, record.point.pose.state, out);
    if (derivatives && exact_) differentiate(*p, u, s.records, rows_of(target_, table), out);
    return out;
  }

  std::vector<std::string> place_columns() const override { return {target_.axis}; }
  void set_place(std::size_t k, ResultTable& table) const override { table.set(target_.axis, target_.values[k].time); }
  std::string label(std::size_t k) const override {
    return fmt::format("{} {:.6g}", target_.axis, target_.values[k].time);
  }

  std::vector<std::pair<std::string, Chart>> pictures(const VecX& values, const VecX& deviations) const override {
    std::set<double> times;
    for (const auto& v : target_.values) times.insert(v.time);
    Chart chart;
    chart.title = "Target and fitted scene";
    chart.x_title = target_.axis;
    chart.x.assign(times.begin(), times.end());
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const std::vector<double> none(chart.x.size(), std::nan(""));
      ChartSeries scene{"scene", none, {}, columns_[c].name}, target{"target", none};
      if (deviations.size() > 0) scene.bar.assign(chart.x.size(), 0.0);
      for (std::size_t k = 0; k < values_.size(); ++k) {
        if (values_[k].column != c) continue;
        const auto x = static_cast<std::size_t>(std::distance(times.begin(), times.find(target_.values[k].time)));
        const auto row = static_cast<Eigen::Index>(k);
        scene.y[x] = values[row];
        target.y[x] = values_[k].wanted;
        if (deviations.size() > 0) scene.bar[x] = deviations[row];
      }
      chart.panels.push_back({columns_[c].name, {scene, target}});
    }
    return {{"", chart}};
  }

 private:
  /// An output for each column; without one for each there are no exact derivatives.
  void choose_outputs(const Prepared& prepared) {
    const std::vector<Output> known = outputs_of(prepared.scene, prepared.model, prepared.steps, kMaxNamedContacts);
    for (const Column& column : columns_)
      for (const Output& o : known)
        if (o.column == column.name) outputs_.push_back(o);
    exact_ = outputs_.size() == columns_.size();
  }

  void take(const ResultTable& table, bool whole, CalibrationPrediction& out) const {
    const auto values = whole ? values_at(target_, table) : std::nullopt;
    if (values)
      out.values = *values;
    else
      out.failed = "not all of its rows can be computed (genu run says why)";
  }

  void differentiate(const Prepared& p, const VecX& u, const std::vector<PoseRecord>& records,
                     const std::vector<std::vector<RowWeight>>& rows, CalibrationPrediction& out) const {
    Sensitivity sensitivity(p.scene, p.model);
    std::map<std::size_t, MatX> at_row;
    MatX J = MatX::Zero(static_cast<Eigen::Index>(values_.size()), u.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (const RowWeight& r : rows[k]) {
        auto found = at_row.find(r.row);
        if (found == at_row.end()) {
          const auto own = scene_.derivatives(sensitivity, u, records[r.row].point, outputs_);
          if (!own) return;
          found = at_row.emplace(r.row, *own).first;
        }
        J.row(static_cast<Eigen::Index>(k)) +=
            r.weight * found->second.row(static_cast<Eigen::Index>(values_[k].column));
      }
    out.derivatives = J;
  }

  ScenesUnknowns scene_;
  CalibrationTarget target_;
  RunOptions options_;
  std::vector<Output> outputs_;  ///< of each column, where all have one
  bool exact_ = false;
};

}  // namespace

std::unique_ptr<CalibrationExperiment> run_experiment(const Prepared& prepared,
                                                      const std::vector<CalibrationUnknown>& unknowns,
                                                      CalibrationTarget target, const RunOptions& options) {
  return std::make_unique<RunExperiment>(prepared, unknowns, std::move(target), options);
}

}  // namespace genu
