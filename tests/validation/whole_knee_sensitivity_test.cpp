// Derivatives of whole knees and of wrapped paths, held to solving the edited scene again.
#include "support/crank_scene.h"
#include "support/data.h"
#include "support/knee_scene.h"
#include "support/places.h"
#include "validation/sensitivity_case.h"

namespace genu::test {
namespace {

TEST(SensitivityOfWraps, ACrankOnWrappedCordsAndCables) {
  compare("crank with a cord and a cable over a rod", crank_scene(R"([surface.rod]
body = "frame"
shape = "cylinder"
radius = 10
[surface.egg]
body = "frame"
shape = "ellipsoid"
radii = [9, 12, 15]
[ligament.cord]
from = { body = "frame", point = [-50, 12, 0] }
to = { body = "crank", point = [40, 5, 3] }
wrap = [{ surface = "rod", side = [0, 1, 0] }]
law = "blankevoort"
stiffness = 500
transition_strain = 0.06
reference_strain = 0.03
[load.cable]
from = { body = "frame", point = [-50, 14, 2] }
to = { body = "crank", point = [35, 6, -2] }
wrap = [{ surface = "egg", side = [0, 1, 0] }]
magnitude = 20
[[step]]
prescribe = { "hinge.angle" = [-20, -40] }
increments = 4
)"),
          {1, 3}, {{"all"}, {"cord.*", "rod.*", "egg.radii.?", "egg.origin.?", "cable.*", "hinge.angle"}});
}

/// Sums over triangles have kinks where a ray passes from one triangle to the next: differences see some of them.
constexpr double kKinks = 1e-3;

TEST(SensitivityOfWraps, TheWholeMeasuredKnee) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-patella-cart_shift.stl");
  const Prepared p = prepared(replaced(replaced(read_text(source_folder() + "/meshes/lenhart2015_whole/scene.toml"),
                                                "../../../shared/data/", data_path("")),
                                       "increments = 90", "increments = 3"));
  const SensitivityResult r =
      differentiated(p, {{"knee.adduction", "knee.x", "pf.gs.*", "pf.quadriceps.force", "pf.patellar_tendon.force",
                          "pf.tendon_to_quadriceps", "MCLs1.force", "knee.flexion.reaction"},
                         {"ACLam1.slack_length", "MCLs1.from.y", "medial.radii.y", "medial.origin.z",
                          "femur_front.radius", "rectus.magnitude", "lateralis.factor"}});
  const Worst worst = worst_error(p, r, {1}, 1e-4);
  std::printf("whole measured knee: %zu derivatives (%zu not 0): worst error %.2g (%s)\n", worst.compared,
              worst.not_zero, worst.error, worst.where.c_str());
  EXPECT_LT(worst.error, kKinks) << worst.where;
  EXPECT_GT(worst.not_zero, worst.compared / 2);
}

}  // namespace
}  // namespace genu::test
