#include "genu/results/curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "genu/results/columns.h"
#include "genu/results/ligament_groups.h"
#include "genu/results/tolerances.h"

namespace genu {
namespace {

constexpr std::size_t kMostLigaments = 8;

const char* unit(const QuantityRef& c) { return c.is_rotation() ? "deg" : "mm"; }

std::vector<double> column(const ResultTable& poses, const std::string& name) {
  std::vector<double> values(poses.rows(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t row = 0; poses.has_column(name) && row < poses.rows(); ++row) values[row] = poses.number(row, name);
  return values;
}

bool unilateral(const std::vector<double>& values) {
  if (values.size() < 2) return false;
  const double sign = values[1] > values[0] ? 1 : -1;
  for (std::size_t k = 1; k < values.size(); ++k)
    if (!(sign * (values[k] - values[k - 1]) > 0)) return false;
  return true;
}

class Curves {
 public:
  Curves(const PlacedScene& scene, const std::vector<StepPlan>& steps, const ResultTable& poses,
         const ResultTable* bars)
      : scene_(scene), steps_(steps), poses_(poses), bars_(bars) {
    for (const StepPlan& step : steps)
      for (const auto& p : step.prescribed)
        if (std::find(prescribed_.begin(), prescribed_.end(), p.coordinate) == prescribed_.end())
          prescribed_.push_back(p.coordinate);
  }

  Chart draw(const std::vector<PathEvent>& events) {
    chart_.title = scene_.title.empty() ? scene_.file : scene_.title;
    choose_x();
    find_breaks();
    add("Rotations [deg]", coordinates(0), false);
    add("Translations [mm]", coordinates(3), false);
    add("Contact force [N]", contact_forces(), true);
    add("Ligament force [N]", ligament_forces(), true);
    add("Reaction moment [N m]", reactions(true), true);
    add("Reaction force [N]", reactions(false), true);
    add("Load factor [1]", load_factors(), true);
    if (scene_.dynamics) {
      add_motion();
      for (std::size_t k = 0; k < events.size(); ++k) add_event(events, k);
      return std::move(chart_);
    }
    add("Smallest stiffness eigenvalue [N mm]", {series("eigenvalue", "stability.min_eigenvalue_Nmm")}, true);
    const auto located = [](const PathEvent& e) { return e.kind == PathEvent::Kind::stability_changed; };
    chart_.panels.back().mark_zero_crossings = std::none_of(events.begin(), events.end(), located);
    for (std::size_t k = 0; k < events.size(); ++k) add_event(events, k);
    return std::move(chart_);
  }

 private:
  std::string coordinate_column(const QuantityRef& c) const { return quantity_name(scene_, c) + "_" + unit(c); }

  void find_breaks() {
    if (!poses_.has_column("branch")) return;
    for (std::size_t row = 1; row < poses_.rows(); ++row)
      if (poses_.number(row, "branch") != poses_.number(row - 1, "branch")) chart_.breaks.push_back(row);
  }

  void choose_x() {
    if (scene_.dynamics) return over_time();
    for (const QuantityRef& c : prescribed_) {
      chart_.x = column(poses_, coordinate_column(c));
      if (!unilateral(chart_.x)) continue;
      x_ = c;
      chart_.x_title = fmt::format("{} [{}]", quantity_name(scene_, c), unit(c));
      return;
    }
    if (choose_driven()) return;
    const auto in_time = [](const LoadDef& l) { return l.in_time(); };
    if (std::any_of(scene_.loads.begin(), scene_.loads.end(), in_time)) return over_time();
    chart_.x_title = "row of results.csv";
    chart_.x.resize(poses_.rows());
    for (std::size_t k = 0; k < chart_.x.size(); ++k) chart_.x[k] = static_cast<double>(k + 1);
  }

  void over_time() {
    over_time_ = true;
    chart_.x = column(poses_, "time_s");
    chart_.x_title = "time [s]";
  }

  /// Moments on hinges and loads, and where the energy is.
  void add_motion() {
    std::vector<ChartSeries> moments, scales;
    for (const JointDef& joint : scene_.joints)
      for (const char* part : {"spring", "damper"})
        if (poses_.has_column(joint.name + "." + part + "_Nm"))
          moments.push_back(series(joint.name + " " + part, joint.name + "." + part + "_Nm"));
    for (const LoadDef& load : scene_.loads)
      if (load.scale) scales.push_back(series(load.name, load.name + ".scale"));
    add("Joint moment [N m]", std::move(moments), true);
    add("Load scale [1]", std::move(scales), true);
    add("Energy [J]",
        {series("kinetic", "energy.kinetic_J"), series("stored", "energy.stored_J"),
         series("load work", "energy.load_work_J"), series("dissipated", "energy.dissipated_J")},
        true);
  }

  /// Where loads alone drive the joint: the coordinate that changes most, if it goes one way.
  bool choose_driven() {
    if (prescribed_changes() || load_factors().empty()) return false;
    double most = 0;
    for (int j = 0; j < static_cast<int>(scene_.joints.size()); ++j)
      for (int i = 0; i < 3; ++i) {
        const CoordinateRef c{j, i};
        if (!scene_.joints[static_cast<std::size_t>(j)].leaves(i)) continue;
        const std::vector<double> x = column(poses_, coordinate_column(c));
        if (!unilateral(x) || std::abs(x.back() - x.front()) <= std::max(most, kMinDrivenAngle)) continue;
        most = std::abs(x.back() - x.front());
        x_ = c;
        chart_.x = x;
        chart_.x_title = fmt::format("{} [{}]", quantity_name(scene_, c), unit(c));
      }
    return x_.has_value();
  }

  bool prescribed_changes() const {
    return std::any_of(steps_.begin(), steps_.end(), [](const StepPlan& s) {
      return std::any_of(s.prescribed.begin(), s.prescribed.end(), [](const auto& p) { return p.from != p.to; });
    });
  }

  ChartSeries series(const std::string& name, const std::string& of) const {
    ChartSeries out{name, column(poses_, of), {}, of};
    if (bars_ != nullptr && bars_->has_column(of)) out.bar = column(*bars_, of);
    return out;
  }

  void add(const char* title, std::vector<ChartSeries> series, bool from_zero) {
    if (!series.empty()) chart_.panels.push_back({title, std::move(series), from_zero, false});
  }

  /// "adduction", with the joint's name where there are several.
  std::string short_name(const QuantityRef& c) const {
    const std::string name = quantity_name(scene_, c);
    return scene_.joints.size() > 1 || c.combination >= 0 ? name : name.substr(name.find('.') + 1);
  }

  std::vector<ChartSeries> coordinates(int first) const {
    std::vector<ChartSeries> out;
    for (int j = 0; j < static_cast<int>(scene_.joints.size()); ++j) {
      for (int i = first; i < first + 3; ++i) {
        const CoordinateRef c{j, i};
        if (x_ == QuantityRef(c) || !scene_.joints[static_cast<std::size_t>(j)].leaves(i)) continue;
        out.push_back(series(short_name(c), coordinate_column(c)));
      }
    }
    return out;
  }

  std::vector<ChartSeries> contact_forces() const {
    std::vector<const ContactDef*> contacts;
    for (const ContactDef& contact : scene_.contacts) contacts.push_back(&contact);
    for (const LayerDef& layer : scene_.layers) contacts.push_back(&layer.pair);
    const bool several = contacts.size() > 1;
    std::vector<ChartSeries> out;
    for (const ContactDef* contact : contacts) {
      for (const RegionDef& region : contact->regions) {
        const std::string name = contact->name + "." + region.name;
        out.push_back(series(several ? name : region.name, name + ".force_N"));
      }
      out.push_back(
          series(contact->regions.empty() || several ? contact->name : "whole pair", contact->name + ".force_N"));
    }
    return out;
  }

  std::vector<ChartSeries> reactions(bool moments) const {
    std::vector<ChartSeries> out;
    for (const QuantityRef& c : prescribed_) {
      if (c.is_rotation() != moments) continue;
      out.push_back(series(short_name(c), quantity_name(scene_, c) + (moments ? ".reaction_Nm" : ".reaction_N")));
    }
    return out;
  }

  /// The fibres of one ligament are added up.
  std::vector<ChartSeries> ligament_forces() const {
    std::vector<ChartSeries> groups;
    for (const LigamentGroup& g : ligament_groups(scene_)) {
      const std::string first = scene_.ligaments[g.members.front()].name + ".force_N";
      groups.push_back({g.name, column(poses_, first), {}, force_column(scene_, g)});
      for (std::size_t i = 1; i < g.members.size(); ++i) {
        const std::vector<double> force = column(poses_, scene_.ligaments[g.members[i]].name + ".force_N");
        for (std::size_t k = 0; k < force.size(); ++k) groups.back().y[k] += force[k];
      }
    }
    const auto peak = [](const ChartSeries& g) {
      double most = 0;
      for (const double f : g.y) most = std::max(most, std::isfinite(f) ? std::abs(f) : 0);
      return most;
    };
    std::stable_sort(groups.begin(), groups.end(),
                     [&](const ChartSeries& a, const ChartSeries& b) { return peak(a) > peak(b); });
    if (groups.size() > kMostLigaments) groups.resize(kMostLigaments);
    return groups;
  }

  std::vector<ChartSeries> load_factors() const {
    std::vector<ChartSeries> out;
    for (const LoadDef& l : scene_.loads)
      if (poses_.has_column(l.name + ".factor")) out.push_back(series(l.name, l.name + ".factor"));
    return out;
  }

  /// Where an event lies on the x axis.
  double place(const PathEvent& event) const {
    if (x_) {
      for (const auto& p : event.target.prescribed)
        if (p.coordinate == *x_) return shown_value(p.coordinate, p.value);
      const auto joint = static_cast<std::size_t>(x_->first.joint);
      if (x_->combination >= 0 || event.coordinates.size() <= joint) return std::numeric_limits<double>::quiet_NaN();
      return shown_value(*x_, event.coordinates[joint][static_cast<std::size_t>(x_->first.index)]);
    }
    if (over_time_) return event.target.time;
    // On the axis of rows: between the last row before it and the next.
    const auto k = static_cast<std::size_t>(std::max(1, event.step)) - 1;
    if (event.step == 0 || k >= steps_.size()) return event.rows_before;
    const double increments = event.t * steps_[k].increments;
    return event.rows_before + (steps_[k].arc_length ? 0.5 : increments - std::floor(increments));
  }

  std::string text(double x) const {
    if (over_time_) return fmt::format("{:.4g} s", x);
    return x_ ? fmt::format("{:.4g} {}", x, unit(*x_)) : fmt::format("row {:.4g}", x);
  }

  void add_event(const std::vector<PathEvent>& events, std::size_t k) {
    using Kind = PathEvent::Kind;
    const PathEvent& e = events[k];
    const double x = place(e);
    if (!std::isfinite(x)) return;
    if (e.kind == Kind::stepped_over) {  // they come in pairs: where the window begins and where it ends
      if (window_from_) {
        chart_.events.push_back({ChartEvent::Kind::window, *window_from_, x,
                                 fmt::format("stepped over, {} to {}", text(*window_from_), text(x))});
        window_from_.reset();
      } else {
        window_from_ = x;
      }
      return;
    }
    // A knee's ligaments become taut and slack so often that their marks would hide all others.
    if (e.kind == Kind::taut || e.kind == Kind::slack || e.kind == Kind::transition) return;
    std::string word = to_string(e.kind);
    std::replace(word.begin(), word.end(), '_', ' ');
    const ChartEvent::Kind kind = e.kind == Kind::contact_gained ? ChartEvent::Kind::gained
                                  : e.kind == Kind::contact_lost ? ChartEvent::Kind::lost
                                                                 : ChartEvent::Kind::other;
    chart_.events.push_back(
        {kind, x, x, fmt::format("{} at {}{}{}", word, text(x), e.what.empty() ? "" : ": ", e.what)});
  }

  const PlacedScene& scene_;
  const std::vector<StepPlan>& steps_;
  const ResultTable& poses_;
  const ResultTable* bars_;
  std::vector<QuantityRef> prescribed_;
  std::optional<QuantityRef> x_;
  bool over_time_ = false;
  std::optional<double> window_from_;
  Chart chart_;
};

}  // namespace

Chart curves(const PlacedScene& scene, const std::vector<StepPlan>& steps, const ResultTable& poses,
             const std::vector<PathEvent>& events, const ResultTable* bars) {
  return Curves(scene, steps, poses, bars).draw(events);
}

}  // namespace genu
