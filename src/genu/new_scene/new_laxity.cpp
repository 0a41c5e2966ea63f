#include "genu/new_scene/new_laxity.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "genu/assemble/with_numbers.h"
#include "genu/core/units.h"
#include "genu/equilibrium/sensitivity.h"
#include "genu/new_scene/tolerances.h"
#include "genu/study/laxity.h"

namespace genu {
namespace {

using Kind = LaxityTest::Kind;
using Value = NewKneeLaxity::Value;

constexpr double kFlexions[] = {0, 30, 60, 90};  // deg
constexpr LaxityTest kDrawer{Kind::drawer, 134}, kVarus{Kind::varus, 10}, kRotation{Kind::rotation, 5};
constexpr int kAngles = static_cast<int>(std::size(kFlexions));
constexpr int kCurves = 3 * kAngles;

/// The ligaments that are cut, and the direction that each holds.
struct Cut {
  const char* name;
  LaxityTest test;
  bool positive;
};
constexpr Cut kCuts[] = {
    {"ACL", kDrawer, true}, {"PCL", kDrawer, false}, {"MCL", kVarus, false}, {"LCL", kVarus, true}};
constexpr int kCutCurves = static_cast<int>(std::size(kCuts)) * 2 * kAngles;

/// A motion with its derivatives. m or rad
struct Moved {
  double value = std::nan("");
  VecX rates;

  Moved operator-(const Moved& other) const { return {value - other.value, rates - other.rates}; }
  Moved operator*(double factor) const { return {factor * value, factor * rates}; }
  Moved operator+(const Moved& other) const { return {value + other.value, rates + other.rates}; }
};

/// The curves of a knee, and how they change.
class TestedKnee {
 public:
  TestedKnee(const Prepared& prepared, const LaxityChoice& choice, const std::vector<NumberRates>& directions) {
    Diagnostics ignored;
    LaxityResult result;
    static_cast<void>(test_laxity(prepared, choice, ignored, result));
    angles_.resize(std::size(kFlexions));
    for (auto& curves : angles_) curves.resize(kLaxityTests, Curve{missing(directions), missing(directions)});
    if (result.scenes.empty()) return;
    const LaxityOfScene& tested = result.scenes.front();
    for (const LaxityAngle& angle : tested.angles)
      for (const LaxityCurve& curve : angle.curves) complete_ += curve.ended.empty() ? 1 : 0;
    tbb::parallel_for(std::size_t{0}, tested.angles.size(), [&](std::size_t a) {
      LaxityJoint own = tested.knee;
      own.prepared.model.meter = std::make_shared<EffectMeter>();  // this thread's
      for (const LaxityCurve& curve : tested.angles[a].curves) {
        if (curve.rows.empty()) continue;
        const Moved neutral = at(own, curve, &curve.rows.front(), directions);
        Curve& found = angles_[a][static_cast<std::size_t>(curve.test.kind)];
        found.positive = at(own, curve, curve.at(curve.test.load), directions) - neutral;
        found.negative = at(own, curve, curve.at(-curve.test.load), directions) - neutral;
      }
    });
  }

  int complete() const { return complete_; }

  /// From the neutral pose to the full load.
  const Moved& to(const LaxityTest& test, bool positive, int angle) const {
    const Curve& curve = angles_[static_cast<std::size_t>(angle)][static_cast<std::size_t>(test.kind)];
    return positive ? curve.positive : curve.negative;
  }
  Moved total(const LaxityTest& test, int angle) const { return to(test, true, angle) - to(test, false, angle); }

 private:
  struct Curve {
    Moved positive, negative;
  };

  static Moved missing(const std::vector<NumberRates>& directions) {
    return {std::nan(""), VecX::Zero(static_cast<Eigen::Index>(directions.size()))};
  }

  static Moved at(const LaxityJoint& knee, const LaxityCurve& curve, const LaxityRow* row,
                  const std::vector<NumberRates>& directions) {
    Moved out = missing(directions);
    if (row == nullptr) return out;
    out.value = curve.test.displacement(row->motion);
    Sensitivity sensitivity(knee.prepared.scene, knee.prepared.model);
    if (directions.empty() || !sensitivity.factor(row->record.point)) return out;
    for (std::size_t k = 0; k < directions.size(); ++k)
      for (const auto& [parameter, rate] : directions[k]) {
        sensitivity.differentiate(parameter);
        const auto motion = sensitivity.clinical(knee.joint);
        const double own = motion ? rate * curve.test.displacement(*motion) : 0;
        if (std::isfinite(own)) out.rates[static_cast<Eigen::Index>(k)] += own;
      }
    return out;
  }

  std::vector<std::vector<Curve>> angles_;  ///< of each angle, by the kind of the test
  int complete_ = 0;
};

/// So long that it carries nothing. Its index stays, and with it those of all others.
std::optional<Prepared> cut(const Prepared& prepared, const std::string& ligament) {
  std::vector<NewNumber> numbers;
  for (const Parameter& p : parameters_of(prepared.source))
    if (p.kind == Parameter::Kind::slack_length && p.name.starts_with(ligament))
      numbers.emplace_back(p, kCutLength * prepared.source.ligaments[static_cast<std::size_t>(p.object)].rest_value);
  Diagnostics ignored;
  return with_numbers(prepared, numbers, ignored);
}

void add(const Moved& moved, double least, double most, double margin, NewKneeLaxity& found,
         NewKneeLaxity::Range* range = nullptr) {
  found.values.push_back({moved.value, least, most, margin, moved.rates});
  if (range == nullptr || !std::isfinite(moved.value)) return;
  range->least = std::min(range->least, moved.value);
  range->most = std::max(range->most, moved.value);
}

void add_intact(const TestedKnee& knee, NewKneeLaxity& found) {
  for (int a = 0; a < kAngles; ++a) {
    add(knee.to(kDrawer, true, a), kLeastDrawer, kMostDrawer, kDrawerMargin, found, &found.drawer);
    add(knee.total(kVarus, a), kLeastSideways / to::kDegree, kMostSideways / to::kDegree, kSidewaysMargin / to::kDegree,
        found, &found.sideways);
    add(knee.total(kRotation, a), kLeastRotation / to::kDegree, kMostRotation / to::kDegree,
        kRotationMargin / to::kDegree, found, &found.rotation);
  }
}

/// What `knee` moves more than the intact one in the direction that a ligament holds, in the mean.
Moved more(const TestedKnee& knee, const TestedKnee& intact, const Cut& held) {
  Moved sum = knee.to(held.test, held.positive, 0) - intact.to(held.test, held.positive, 0);
  for (int a = 1; a < kAngles; ++a)
    sum = sum + (knee.to(held.test, held.positive, a) - intact.to(held.test, held.positive, a));
  return sum * ((held.positive ? 1.0 : -1.0) / kAngles);
}

void add_cuts(const std::vector<TestedKnee>& cuts, const TestedKnee& intact, NewKneeLaxity& found) {
  constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  for (std::size_t own = 0; own < cuts.size(); ++own) {
    const Cut& held = kCuts[own];
    const double one = 1 / held.test.shown();  // mm or deg
    const Moved added = more(cuts[own], intact, held);
    add(added, kLeastCut * one, kNoLimit, kCutMargin * one, found);
    for (std::size_t other = 0; other < cuts.size(); ++other)
      if (other != own) add(added - more(cuts[other], intact, held), 0, kNoLimit, kCutMargin * one, found);
    found.cut_complete += cuts[own].complete();
  }
}

}  // namespace

int NewKneeLaxity::missing_curves() const { return kCurves - complete + kCutCurves - cut_complete; }

bool NewKneeLaxity::usual(double margins) const {
  return all_complete() && std::all_of(values.begin(), values.end(), [&](const Value& v) {
           return v.value > v.least + margins * v.margin && v.value < v.most - margins * v.margin;
         });
}

std::string NewKneeLaxity::text() const {
  std::string unfinished = complete < kCurves ? fmt::format("; {} of {} curves complete", complete, kCurves) : "";
  if (cut_complete < kCutCurves) unfinished += fmt::format("; {} of {} with a ligament cut", cut_complete, kCutCurves);
  return fmt::format(
      "anterior {:.1f} to {:.1f} mm at 134 N, varus and valgus {:.1f} to {:.1f} deg at 10 N m, rotation {:.0f} to "
      "{:.0f} deg at 5 N m{}{}",
      to::kMillimetre * drawer.least, to::kMillimetre * drawer.most, to::kDegree * sideways.least,
      to::kDegree * sideways.most, to::kDegree * rotation.least, to::kDegree * rotation.most, unfinished,
      usual() ? "" : "; not all as of usual knees (docs/laxity.md)");
}

NewKneeLaxity laxity_of_new(const Prepared& prepared, const std::vector<NumberRates>& directions,
                            const Cancelled& cancelled) {
  LaxityChoice choice;
  choice.increments = kNewKneeIncrements;
  choice.cancelled = cancelled;
  for (const double angle : kFlexions) choice.flexions.push_back(angle / to::kDegree);
  choice.tests = {kDrawer, kVarus, kRotation};
  const TestedKnee intact(prepared, choice, directions);
  NewKneeLaxity found;
  found.complete = intact.complete();
  add_intact(intact, found);
  choice.tests = {kDrawer, kVarus};
  choice.back = false;
  std::vector<TestedKnee> cuts;
  for (const Cut& c : kCuts)
    if (const auto without = cut(prepared, c.name)) cuts.emplace_back(*without, choice, directions);
  if (cuts.size() == std::size(kCuts)) add_cuts(cuts, intact, found);
  return found;
}

}  // namespace genu
