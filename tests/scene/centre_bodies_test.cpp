#include "genu/scene/centre_bodies.h"

#include "genu/scene/read_parts.h"
#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

/// The good scene with the points of the femur `by` (m) farther from the femur's origin.
Scene shifted(const Vec3& by) {
  Scene scene = good(kGoodScene);
  scene.surfaces[0].placement.p += by;
  scene.ligaments[0].from.point += by;
  scene.loads[0].point += by;
  return scene;
}

TEST(CentreBodies, LeavesOrdinaryScenesAlone) {
  Scene scene = good(kGoodScene);
  const Scene before = scene;
  centre_bodies(scene);
  for (const BodyDef& body : scene.bodies) EXPECT_EQ(body.centre, Vec3::Zero());
  EXPECT_EQ(scene.surfaces[0].placement.p, before.surfaces[0].placement.p);
}

TEST(CentreBodies, EveryPointOfAFarBodyMovesWithItsOrigin) {
  const Vec3 by(1000, -200, 30);
  Scene scene = shifted(by);
  scene.joints[0].grood_suntay = GroodSuntayDef{true, {1, Vec3::UnitZ(), Vec3::UnitY(), by}, {0}};
  scene.bodies[1].centre_of_mass = by;
  scene.ligaments[0].via = {{1, by + Vec3(0.01, 0, 0)}, {0, Vec3(0, 0.02, 0)}};
  const Scene before = scene;
  centre_bodies(scene);
  const Vec3 centre = scene.bodies[1].centre;
  EXPECT_LT((centre - by).norm(), 0.05);
  EXPECT_EQ(scene.bodies[0].centre, Vec3::Zero());
  EXPECT_EQ(scene.surfaces[0].placement.p, before.surfaces[0].placement.p - centre);
  EXPECT_EQ(scene.ligaments[0].from.point, before.ligaments[0].from.point - centre);
  EXPECT_EQ(scene.ligaments[0].to.point, before.ligaments[0].to.point);
  EXPECT_EQ(scene.ligaments[0].via[0].point, before.ligaments[0].via[0].point - centre);
  EXPECT_EQ(scene.ligaments[0].via[1].point, before.ligaments[0].via[1].point);
  EXPECT_EQ(scene.loads[0].point, before.loads[0].point - centre);
  EXPECT_EQ(scene.bodies[1].centre_of_mass, by - centre);
  EXPECT_EQ(scene.joints[0].grood_suntay->femur.origin, by - centre);
  EXPECT_EQ(scene.contacts[0].regions[0].conditions[0].value, before.contacts[0].regions[0].conditions[0].value);
}

TEST(CentreBodies, RegionsMoveWithTheSecondSurfacesBody) {
  Scene scene = good(kGoodScene);
  const Vec3 by(0, 50, 700);
  scene.surfaces[1].placement.p += by;
  scene.ligaments[0].to.point += by;
  centre_bodies(scene);
  EXPECT_DOUBLE_EQ(scene.contacts[0].regions[0].conditions[0].value, -scene.bodies[0].centre.z());
  EXPECT_GT(scene.bodies[0].centre.z(), 690);
}

TEST(CentreBodies, ABodyWithoutPointsHasThemWhereTheOthersAre) {
  Scene scene = good(kGoodScene);
  scene.joints[0].reference[3] = 2000;  // the femur far from the tibia's origin, and nothing on the tibia
  scene.surfaces.clear();
  scene.contacts.clear();
  scene.loads.clear();
  scene.ligaments[0].to.body = 1;
  centre_bodies(scene);
  EXPECT_NEAR(scene.bodies[0].centre.x(), 2000, 0.1);
  EXPECT_EQ(scene.bodies[1].centre, Vec3::Zero());
}

TEST(CentreBodies, AMeshThatItsPlacementBringsBackIsWhereItsFileAndThatLeaveIt) {
  Scene scene = shifted(Vec3(0, -4000, 0));
  SurfaceDef& mesh = scene.surfaces[0];
  ASSERT_EQ(mesh.body, 1);
  mesh.shape = SurfaceDef::Shape::mesh;
  scene.ligaments.clear();
  scene.loads.clear();
  const Scene before = scene;
  int asked = 0;
  const auto in_its_file = [&](const Vec3& middle) {
    return [&asked, middle](const SurfaceDef& s) -> std::optional<Vec3> {
      EXPECT_EQ(s.name, "ball");
      ++asked;
      return middle;
    };
  };
  centre_bodies(scene, in_its_file(Vec3(0, 4000, 0.01)));
  EXPECT_EQ(scene.bodies[1].centre, Vec3::Zero()) << "the file has it 4 km the other way";
  scene = before;
  centre_bodies(scene, in_its_file(Vec3(0, 0, 0.01)));
  EXPECT_LT((scene.bodies[1].centre - Vec3(0, -4000, 0)).norm(), 0.1) << "the file has it at its origin";
  EXPECT_EQ(asked, 2);
}

}  // namespace
}  // namespace genu::scene_test
