// The cubic between two poses, against a motion that is known everywhere.
#include "genu/path/path_cubic.h"

#include "support/known_motion.h"

namespace genu {
namespace {

TEST(PathCubic, ErrsWithTheFourthPowerOfTheSpan) {
  const JointModel model = test::one_bone();
  double last = 0;
  for (const double span : {0.2, 0.1, 0.05}) {
    const test::KnownMotion from(model, 0.4), to(model, 0.4 + span), here(model, 0.4 + 0.3 * span);
    PathCubic cubic(model, from.state, from.tangent, to.state, to.tangent, span);
    State found;
    ASSERT_TRUE(cubic.at(1, found));
    EXPECT_LT((found.poses[1].R - to.state.poses[1].R).norm(), 1e-14);
    ASSERT_TRUE(cubic.at(0.3, found));
    const double error = distance(here, found);
    if (last > 0) {
      EXPECT_GT(last / error, 12) << span;
    }
    last = error;
  }
  EXPECT_LT(last, 1e-5);
}

}  // namespace
}  // namespace genu
