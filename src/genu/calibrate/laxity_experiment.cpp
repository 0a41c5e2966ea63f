#include "genu/calibrate/laxity_experiment.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "genu/core/units.h"
#include "genu/path/path.h"
#include "genu/study/solve_path.h"
#include "genu/study/tolerances.h"

namespace genu {
namespace {

bool is_displacement(const std::string& column) {
  return column == kDisplacementColumns[0] || column == kDisplacementColumns[1];
}

class LaxityExperiment : public CalibrationExperiment {
 public:
  LaxityExperiment(const LaxityJoint& knee, const std::vector<CalibrationUnknown>& unknowns, LaxityTarget target,
                   double compression, Cancelled cancelled)
      : knee_(knee),
        scene_(knee.prepared, unknowns),
        target_(std::move(target)),
        compression_(compression),
        cancelled_(std::move(cancelled)) {
    for (const std::string& name : target_.columns) columns_.push_back({name, spread_of(name)});
    for (const auto& v : target_.values) values_.push_back({v.column, v.value});
    const Prepared& p = knee.prepared;
    const StepPlan neutral = laxity_step(knee_, compression_, 0, -1, 0, 0, 1);
    const std::vector<Output> known = outputs_of(p.scene, p.model, {neutral}, kMaxNamedContacts);
    for (const std::string& name : target_.columns) {
      const auto same = [&](const Output& o) { return o.column == name; };
      const auto found = std::find_if(known.begin(), known.end(), same);
      exact_ = exact_ && (is_displacement(name) || found != known.end());
      if (found != known.end()) outputs_.push_back(*found);
    }
  }

  CalibrationPrediction predict(const VecX& u, bool derivatives) const override {
    CalibrationPrediction out;
    const auto p = scene_.with(u);
    if (!p) {
      out.failed = "a ligament's law cannot be with these numbers";
      return out;
    }
    std::vector<double> flexions;
    for (const auto& curve : target_.curves)
      if (flexions.empty() || flexions.back() != curve.flexion) flexions.push_back(curve.flexion);
    std::vector<Part> parts(flexions.size());
    tbb::parallel_for(std::size_t{0}, flexions.size(),
                      [&](std::size_t k) { parts[k] = at_angle(*p, u, flexions[k], derivatives && exact_); });
    out.values = VecX::Zero(static_cast<Eigen::Index>(values_.size()));
    if (derivatives && exact_) out.derivatives = MatX::Zero(out.values.size(), u.size());
    out.stretch = scene_.no_stretch();
    std::vector<bool> there(values_.size(), true);
    for (const Part& part : parts) take(part, there, out);
    if (out.failed.empty()) return out;
    const bool some = std::none_of(parts.begin(), parts.end(), [](const Part& part) { return part.nothing; }) &&
                      std::find(there.begin(), there.end(), false) != there.end();
    if (some) out.part = {out.values, out.derivatives, std::move(there)};
    out.values.resize(0);
    out.derivatives.resize(0, 0);
    return out;
  }

  std::vector<std::string> place_columns() const override { return {"flexion_deg", "test", "load_N", "load_Nm"}; }
  void set_place(std::size_t k, ResultTable& table) const override {
    const LaxityTarget::Value& v = target_.values[k];
    const auto& curve = target_.curves[v.curve];
    const LaxityTest test{curve.kind, 0};
    table.set("flexion_deg", to::kDegree * curve.flexion);
    table.set("test", std::string(v.load == 0 ? "neutral" : test.name()));
    if (v.load != 0) table.set(test.turns() ? "load_Nm" : "load_N", v.load);
  }
  std::string label(std::size_t k) const override {
    const auto& curve = target_.curves[target_.values[k].curve];
    return fmt::format("{:.4g} deg, {}", to::kDegree * curve.flexion, LaxityTest{curve.kind, 0}.name());
  }

  /// One picture a test, one panel an angle.
  std::vector<std::pair<std::string, Chart>> pictures(const VecX& values, const VecX& deviations) const override {
    std::vector<std::pair<std::string, Chart>> out;
    for (std::size_t kind = 0; kind < kLaxityTests; ++kind) {
      const LaxityTest test{static_cast<LaxityTest::Kind>(kind), 0};
      std::set<double> loads;
      for (const auto& curve : target_.curves)
        if (curve.kind == test.kind) loads.insert(curve.loads.begin(), curve.loads.end());
      if (loads.empty()) continue;
      Chart chart;
      chart.title = std::string("Laxity, measured and fitted: ") + test.name();
      chart.x_title = std::string("load (") + test.load_unit() + ")";
      chart.x.assign(loads.begin(), loads.end());
      for (std::size_t c = 0; c < target_.curves.size(); ++c)
        if (target_.curves[c].kind == test.kind) add_panel(c, loads, values, deviations, chart);
      if (!chart.panels.empty()) out.emplace_back(test.name(), chart);
    }
    return out;
  }

 private:
  /// One angle: values of the target, by their index.
  struct Part {
    std::vector<std::pair<std::size_t, double>> values;
    std::vector<std::pair<std::size_t, VecX>> derivatives;
    std::vector<State> states;  ///< all poses, for the stretch of ligaments
    const Prepared* at_u = nullptr;
    bool exact = true;
    bool nothing = false;              ///< no value exists
    std::vector<std::size_t> missing;  ///< values that do not exist
    std::string failed;                ///< why
  };

  struct Row {
    PoseRecord record;
    KneeMotion motion;
    std::optional<MatX> motion_rate;  ///< of the three tests' displacements, SI by u
  };

  double spread_of(const std::string& name) const {
    double square = 0, count = 0;
    for (const auto& v : target_.values)
      if (target_.columns[v.column] == name) square += v.value * v.value, ++count;
    return square > 0 ? std::sqrt(square / count) : 1;
  }

  /// The clinical motion, with its derivatives where there is a `sensitivity`.
  Row row_of(const Prepared& own, const VecX& u, const PoseRecord& record, Sensitivity* sensitivity) const {
    Row row{record, {}, {}};
    const GroodSuntayDef& axes = *own.scene.joints[genu::at(knee_.joint)].grood_suntay;
    const auto& poses = record.point.pose.state.poses;
    if (const auto motion = grood_suntay(axes, poses[genu::at(axes.femur.body)], poses[genu::at(axes.tibia.body)]))
      row.motion = *motion;
    if (sensitivity == nullptr) return row;
    std::vector<Output> outputs;
    for (std::size_t kind = 0; kind < kLaxityTests; ++kind) {
      const LaxityTest test{static_cast<LaxityTest::Kind>(kind), 0};
      outputs.push_back({test.name(), test.unit(), test.shown(), [this, test](const PosePoint&, const Sensitivity& s) {
                           const auto rate = s.clinical(knee_.joint);
                           return rate ? test.displacement(*rate) : std::nan("");
                         }});
    }
    row.motion_rate = scene_.derivatives(*sensitivity, u, record.point, outputs);
    return row;
  }

  Part at_angle(const Prepared& p, const VecX& u, double flexion, bool derivatives) const {
    Part part;
    part.at_u = &p;
    Prepared own = p;
    own.model.meter = std::make_shared<EffectMeter>();
    own.steps = {laxity_step(knee_, compression_, flexion, -1, 0, 0, 1)};
    const std::vector<PoseRecord> solved = poses_of(own);
    const std::string place = fmt::format("{:.4g} deg", to::kDegree * flexion);
    if (solved.empty() || !solved.back().point.solved()) {
      part.failed = "no neutral pose at " + place;
      part.nothing = true;
      return part;
    }
    Sensitivity rates(own.scene, own.model);
    Sensitivity* sensitivity = derivatives ? &rates : nullptr;
    const Row neutral = row_of(own, u, solved.back(), sensitivity);
    part.states.push_back(neutral.record.point.pose.state);
    for (std::size_t j = 0; j < own.model.joints.size(); ++j)
      own.model.joints[j].start = part.states.front().coordinates[j];
    for (std::size_t c = 0; c < target_.curves.size(); ++c) {
      const LaxityTarget::Curve& curve = target_.curves[c];
      if (curve.flexion != flexion) continue;
      take_row(c, 0, own, u, neutral, neutral, sensitivity, part);
      for (const bool positive : {true, false}) follow(c, positive, own, u, neutral, sensitivity, part);
    }
    return part;
  }

  /// Along the steps of `own`; of layers and gaps only what columns of the target need.
  std::vector<PoseRecord> poses_of(const Prepared& own) const {
    RunOptions options;
    options.cancelled = cancelled_;
    options.path.locate_law_breaks = false;
    ContactField field = contact_field(own);
    if (!std::all_of(target_.columns.begin(), target_.columns.end(), is_displacement))
      return solve_path(own, field, options).records;
    std::vector<PoseRecord> poses;
    PathObserver observer;
    observer.cancelled = cancelled_;
    observer.pose = [&](const PosePoint& point, LayerMemories*) { poses.push_back({point, {}}); };
    (void)follow_path(own.model, field, own.steps, path_options(own.scene, options), observer);
    return poses;
  }

  /// From 0 outward, as few steps as equal distances allow: each step begins its prediction anew.
  std::vector<StepPlan> steps_to(const std::vector<double>& loads, double flexion, int load) const {
    std::vector<StepPlan> steps;
    double from = 0;
    for (std::size_t k = 0; k < loads.size();) {
      const double distance = loads[k] - from;
      std::size_t end = k + 1;
      while (end < loads.size() && std::abs(loads[end] - loads[end - 1] - distance) <= kSameLoad * std::abs(loads[end]))
        ++end;
      steps.push_back(laxity_step(knee_, compression_, flexion, load, from, loads[end - 1], static_cast<int>(end - k)));
      from = loads[end - 1];
      k = end;
    }
    return steps;
  }

  /// One test in one direction. Where it ends early, its rows from there on are missing.
  void follow(std::size_t c, bool positive, Prepared& own, const VecX& u, const Row& neutral, Sensitivity* sensitivity,
              Part& part) const {
    const LaxityTarget::Curve& curve = target_.curves[c];
    const int load = knee_.loads[static_cast<std::size_t>(curve.kind)];
    std::vector<double> loads;
    for (const double f : curve.loads)
      if ((f > 0) == positive) loads.push_back(f);
    if (loads.empty()) return;
    own.steps = steps_to(loads, curve.flexion, load);
    own.model.meter = std::make_shared<EffectMeter>();
    const std::vector<PoseRecord> solved = poses_of(own);
    for (std::size_t k = 0; k < loads.size(); ++k) {
      const PoseRecord* record = solved.size() == loads.size() + 1 ? &solved[k + 1] : nullptr;
      if (record == nullptr || !record->point.solved() || record->point.branch != solved.front().point.branch) {
        for (std::size_t v = 0; v < target_.values.size(); ++v)
          if (target_.values[v].curve == c && std::find(loads.begin() + static_cast<std::ptrdiff_t>(k), loads.end(),
                                                        target_.values[v].load) != loads.end())
            part.missing.push_back(v);
        if (!part.failed.empty()) return;
        part.failed =
            fmt::format("{:.4g} deg, {}: the path ends before {:.4g} {}", to::kDegree * curve.flexion,
                        LaxityTest{curve.kind, 0}.name(), loads.back(), LaxityTest{curve.kind, 0}.load_unit());
        return;
      }
      const Row row = row_of(own, u, *record, sensitivity);
      part.states.push_back(record->point.pose.state);
      take_row(c, loads[k], own, u, row, neutral, sensitivity, part);
    }
  }

  /// The target's values at one load of a curve.
  void take_row(std::size_t c, double load, const Prepared& own, const VecX& u, const Row& row, const Row& neutral,
                Sensitivity* sensitivity, Part& part) const {
    const LaxityTest test{target_.curves[c].kind, 0};
    std::optional<ResultTable> table;
    std::optional<MatX> rates;
    for (std::size_t k = 0; k < target_.values.size(); ++k) {
      const LaxityTarget::Value& v = target_.values[k];
      if (v.curve != c || v.load != load) continue;
      const std::string& column = target_.columns[v.column];
      if (is_displacement(column)) {
        part.values.emplace_back(k, test.shown() * (test.displacement(row.motion) - test.displacement(neutral.motion)));
        if (sensitivity == nullptr) continue;
        part.exact = part.exact && row.motion_rate && neutral.motion_rate;
        const auto kind = static_cast<Eigen::Index>(test.kind);
        if (part.exact)
          part.derivatives.emplace_back(
              k, VecX((row.motion_rate->row(kind) - neutral.motion_rate->row(kind)).transpose()));
        continue;
      }
      PoseRecord alone = row.record;
      alone.point.step = 0;
      if (!table) table = pose_table(own.scene, own.model, {laxity_step(knee_, compression_, 0, -1, 0, 0, 1)}, {alone});
      part.values.emplace_back(k, table->number(0, column));
      if (sensitivity == nullptr) continue;
      if (!rates) rates = scene_.derivatives(*sensitivity, u, row.record.point, outputs_);
      part.exact = part.exact && rates;
      const auto same = [&](const Output& o) { return o.column == column; };
      const auto o = std::find_if(outputs_.begin(), outputs_.end(), same) - outputs_.begin();
      if (part.exact) part.derivatives.emplace_back(k, VecX(rates->row(o).transpose()));
    }
  }

  void take(const Part& part, std::vector<bool>& there, CalibrationPrediction& out) const {
    if (out.failed.empty()) out.failed = part.failed;
    for (const std::size_t k : part.missing) there[k] = false;
    for (const auto& [k, value] : part.values) {
      out.values[static_cast<Eigen::Index>(k)] = std::isfinite(value) ? value : 0;
      if (std::isfinite(value)) continue;
      there[k] = false;
      if (out.failed.empty()) out.failed = "a value of the target's columns does not exist";
    }
    for (const State& state : part.states) scene_.note_stretch(*part.at_u, state, out);
    if (!part.exact) out.derivatives.resize(0, 0);
    if (out.derivatives.size() == 0) return;
    for (const auto& [k, rate] : part.derivatives) out.derivatives.row(static_cast<Eigen::Index>(k)) = rate.transpose();
  }

  void add_panel(std::size_t c, const std::set<double>& loads, const VecX& values, const VecX& deviations,
                 Chart& chart) const {
    const std::vector<double> none(loads.size(), std::nan(""));
    ChartSeries scene{"scene", none}, target{"target", none};
    bool any = false;
    if (deviations.size() > 0) scene.bar.assign(loads.size(), 0.0);
    for (std::size_t k = 0; k < values_.size(); ++k) {
      const LaxityTarget::Value& v = target_.values[k];
      if (v.curve != c || v.load == 0 || !is_displacement(target_.columns[v.column])) continue;
      const auto x = static_cast<std::size_t>(std::distance(loads.begin(), loads.find(v.load)));
      any = true;
      scene.y[x] = values[static_cast<Eigen::Index>(k)];
      target.y[x] = v.value;
      if (deviations.size() > 0) scene.bar[x] = deviations[static_cast<Eigen::Index>(k)];
    }
    const LaxityTest test{target_.curves[c].kind, 0};
    if (any)
      chart.panels.push_back(
          {fmt::format("{:.4g} deg ({})", to::kDegree * target_.curves[c].flexion, test.unit()), {scene, target}});
  }

  LaxityJoint knee_;
  ScenesUnknowns scene_;
  LaxityTarget target_;
  double compression_;
  Cancelled cancelled_;
  std::vector<Output> outputs_;  ///< of the columns that are no displacements
  bool exact_ = true;
};

}  // namespace

std::unique_ptr<CalibrationExperiment> laxity_experiment(const LaxityJoint& knee,
                                                         const std::vector<CalibrationUnknown>& unknowns,
                                                         LaxityTarget target, double compression,
                                                         const Cancelled& cancelled) {
  return std::make_unique<LaxityExperiment>(knee, unknowns, std::move(target), compression, cancelled);
}

}  // namespace genu
