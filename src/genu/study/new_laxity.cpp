#include "genu/study/new_laxity.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/study/laxity.h"
#include "genu/study/tolerances.h"

namespace genu {
namespace {

constexpr double kFlexions[] = {0, 30, 60, 90};  // deg
constexpr double kDrawerForce = 134, kVarusMoment = 10, kRotationMoment = 5;
constexpr int kCurves = 12;
constexpr int kTestIncrements = 2;

void add(double value, NewKneeLaxity::Range& range) {
  range.least = std::min(range.least, value);
  range.most = std::max(range.most, value);
}

void add(const LaxityCurve& curve, NewKneeLaxity& found) {
  const LaxityRow *up = curve.at(curve.test.load), *down = curve.at(-curve.test.load);
  if (!curve.ended.empty() || up == nullptr || down == nullptr) return;
  ++found.complete;
  const auto moved = [&](const LaxityRow& row) { return curve.test.displacement(row.motion); };
  const double positive = moved(*up) - moved(curve.rows.front()), total = moved(*up) - moved(*down);
  if (curve.test.kind == LaxityTest::Kind::drawer) add(positive, found.drawer);
  if (curve.test.kind == LaxityTest::Kind::varus) add(total, found.sideways);
  if (curve.test.kind == LaxityTest::Kind::rotation) add(total, found.rotation);
}

}  // namespace

std::string text_of(const NewKneeAims& aims) {
  std::string out;
  const auto add = [&](bool changed, const std::string& words) {
    if (changed) out += (out.empty() ? "; for it " : ", ") + words;
  };
  add(aims.anterior != 0, fmt::format("strain of the ACL {:+.1f} %", -100 * aims.anterior));
  add(aims.sideways != 0, fmt::format("strain of the collaterals and the PCL {:+.1f} %", 100 * aims.sideways));
  add(aims.rotation != 0, fmt::format("strain of the posterior corners {:+.1f} %", -100 * aims.rotation));
  add(aims.collaterals != 1, fmt::format("collaterals {:.2f} times as stiff", aims.collaterals));
  add(aims.menisci != 1, fmt::format("menisci {:.2f} times as stiff", aims.menisci));
  return out;
}

bool NewKneeLaxity::usual() const {
  return complete == kCurves && drawer.least > kLeastDrawer && drawer.most < kMostDrawer &&
         sideways.least > kLeastSideways / to::kDegree && sideways.most < kMostSideways / to::kDegree &&
         rotation.least > kLeastRotation / to::kDegree && rotation.most < kMostRotation / to::kDegree;
}

std::string NewKneeLaxity::text() const {
  const std::string unfinished = complete < kCurves ? fmt::format("; {} of 12 curves complete", complete) : "";
  return fmt::format(
      "anterior {:.1f} to {:.1f} mm at 134 N, varus and valgus {:.1f} to {:.1f} deg at 10 N m, rotation {:.0f} to "
      "{:.0f} "
      "deg at 5 N m{}{}",
      to::kMillimetre * drawer.least, to::kMillimetre * drawer.most, to::kDegree * sideways.least,
      to::kDegree * sideways.most, to::kDegree * rotation.least, to::kDegree * rotation.most, unfinished,
      usual() ? "" : "; not all as of usual knees (docs/laxity.md)");
}

NewKneeLaxity laxity_of_new(const Prepared& prepared, const Cancelled& cancelled) {
  using Kind = LaxityTest::Kind;
  LaxityChoice choice;
  choice.tests = {{Kind::drawer, kDrawerForce}, {Kind::varus, kVarusMoment}, {Kind::rotation, kRotationMoment}};
  choice.increments = kTestIncrements;
  choice.cancelled = cancelled;
  for (const double angle : kFlexions) choice.flexions.push_back(angle / to::kDegree);
  constexpr double kNothingSeen = std::numeric_limits<double>::infinity();
  NewKneeLaxity found{{kNothingSeen, -kNothingSeen}, {kNothingSeen, -kNothingSeen}, {kNothingSeen, -kNothingSeen}, 0};
  Diagnostics ignored;
  LaxityResult result;
  static_cast<void>(test_laxity(prepared, choice, ignored, result));
  for (const LaxityOfScene& scene : result.scenes)
    for (const LaxityAngle& angle : scene.angles)
      for (const LaxityCurve& curve : angle.curves) add(curve, found);
  return found;
}

bool aim_at_ranges(const NewKneeLaxity& found, NewKneeAims& aims) {
  const NewKneeAims before = aims;
  const bool stiff = found.rotation.least < (kLeastRotation + kRotationMargin) / to::kDegree;
  const bool lax = found.complete < kCurves || found.sideways.most > (kMostSideways - kSidewaysMargin) / to::kDegree;
  if (lax) {
    // Stiff menisci hide a cut PCL: they come last.
    if (aims.sideways == kMostAim && aims.collaterals == kStiffestCollaterals)
      aims.menisci = std::min(kMenisciStep * aims.menisci, kStiffestMenisci);
    aims.sideways = std::min(aims.sideways + kSidewaysStep, kMostAim);
    aims.collaterals = std::min(kCollateralStep * aims.collaterals, kStiffestCollaterals);
  } else if (stiff && aims.rotation == kMostRotationAim) {
    aims.menisci = std::max(aims.menisci / kMenisciStep, kSoftestMenisci);
  }
  if (stiff) aims.rotation = std::min(aims.rotation + kRotationStep, kMostRotationAim);
  if (found.drawer.least < kLeastDrawer + kDrawerMargin)
    aims.anterior = std::min(aims.anterior + kAnteriorStep, kMostAim);
  return aims.menisci != before.menisci || aims.sideways != before.sideways || aims.anterior != before.anterior ||
         aims.rotation != before.rotation || aims.collaterals != before.collaterals;
}

}  // namespace genu
