// Counts every evaluation and times some.
#include "genu/model/effect_meter.h"

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(EffectMeter, CountsEveryEvaluationOfWhatThereIs) {
  EffectMeter meter;
  int done = 0;
  for (int i = 0; i < 40; ++i) evaluate_effect(&meter, Effect::loads, 3, [&] { ++done; });
  evaluate_effect(&meter, Effect::layers, 0, [&] { ++done; });
  evaluate_effect(nullptr, Effect::weights, 2, [&] { ++done; });
  EXPECT_EQ(done, 41) << "what there is none of is not called";
  EXPECT_EQ(meter.evaluations(Effect::loads), 120);
  EXPECT_EQ(meter.evaluations(Effect::layers), 0);
  EXPECT_EQ(meter.evaluations(Effect::weights), 0);
}

void wait(double seconds) {
  for (const Timer timer; timer.seconds() < seconds;) continue;
}

/// A cold start is no sixteenth of anything, and of calls that differ much each one counts.
TEST(EffectMeter, DoesNotScaleWhatIsSlow) {
  const double slow = 5e-3;
  EffectMeter meter;
  const Timer timer;
  for (int i = 0; i < 64; ++i) evaluate_effect(&meter, Effect::loads, 1, [&] { wait(i == 0 ? slow : 0); });
  EXPECT_GE(meter.seconds(Effect::loads), slow);
  EXPECT_LE(meter.seconds(Effect::loads), timer.seconds() + slow) << "scaled it would be 16 times as long";
  const Timer second;
  for (int i = 0; i < 65; ++i) evaluate_effect(&meter, Effect::layers, 1, [&] { wait(i % 16 == 1 ? slow : 0); });
  EXPECT_GE(meter.seconds(Effect::layers), 4 * slow);
  EXPECT_LE(meter.seconds(Effect::layers), second.seconds());
}

TEST(EffectMeter, ScalesTheTimeOfTheCallsItTimed) {
  EffectMeter meter;
  const double least = 2e-6;
  for (int i = 0; i < 33; ++i) evaluate_effect(&meter, Effect::ligaments, 1, [&] { wait(least); });
  EXPECT_GE(meter.seconds(Effect::ligaments), 33 * least);
  EXPECT_EQ(meter.seconds(Effect::loads), 0);
}

}  // namespace
}  // namespace genu
