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

TEST(EffectMeter, ScalesTheTimeOfTheCallsItTimed) {
  EffectMeter meter;
  const double least = 2e-4;
  for (int i = 0; i < 33; ++i)
    evaluate_effect(&meter, Effect::ligaments, 1, [&] {
      for (const Timer timer; timer.seconds() < least;) continue;
    });
  EXPECT_GE(meter.seconds(Effect::ligaments), 33 * least);
  EXPECT_EQ(meter.seconds(Effect::loads), 0);
}

}  // namespace
}  // namespace genu
