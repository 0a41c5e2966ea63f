#include "genu/scene/centre_bodies.h"

#include <type_traits>

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

PlacedScene placed(const Scene& scene) { return place(scene, choose_origins(scene)); }

/// Nothing that takes one kind of scene takes the other.
static_assert(!std::is_convertible_v<Scene, PlacedScene> && !std::is_convertible_v<PlacedScene, Scene>);
static_assert(!std::is_assignable_v<Scene&, const PlacedScene&> && !std::is_assignable_v<PlacedScene&, const Scene&>);

TEST(CentreBodies, LeavesOrdinaryScenesAlone) {
  const Scene before = good(kGoodScene);
  const PlacedScene scene = placed(before);
  for (const Vec3& origin : scene.origins) EXPECT_EQ(origin, Vec3::Zero());
  EXPECT_EQ(scene.surfaces[0].placement.p, before.surfaces[0].placement.p);
}

TEST(CentreBodies, EveryPointOfAFarBodyMovesWithItsOrigin) {
  const Vec3 by(1000, -200, 30);
  Scene before = shifted(by);
  before.joints[0].grood_suntay = GroodSuntayDef{true, false, {1, Vec3::UnitZ(), Vec3::UnitY(), by}, {0}};
  before.bodies[1].centre_of_mass = by;
  before.ligaments[0].via = {{1, by + Vec3(0.01, 0, 0)}, {0, Vec3(0, 0.02, 0)}};
  const PlacedScene scene = placed(before);
  const Vec3 centre = scene.origins[1];
  EXPECT_LT((centre - by).norm(), 0.05);
  EXPECT_EQ(scene.origins[0], Vec3::Zero());
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
  const PlacedScene moved = placed(scene);
  EXPECT_DOUBLE_EQ(moved.contacts[0].regions[0].conditions[0].value, -moved.origins[0].z());
  EXPECT_GT(moved.origins[0].z(), 690);
}

TEST(CentreBodies, ABodyWithoutPointsHasThemWhereTheOthersAre) {
  Scene scene = good(kGoodScene);
  scene.joints[0].reference[3] = 2000;  // the femur far from the tibia's origin, and nothing on the tibia
  scene.surfaces.clear();
  scene.contacts.clear();
  scene.loads.clear();
  scene.ligaments[0].to.body = 1;
  const std::vector<Vec3> origins = choose_origins(scene);
  EXPECT_NEAR(origins[0].x(), 2000, 0.1);
  EXPECT_EQ(origins[1], Vec3::Zero());
}

TEST(CentreBodies, AMeshThatItsPlacementBringsBackIsWhereItsFileAndThatLeaveIt) {
  Scene scene = shifted(Vec3(0, -4000, 0));
  SurfaceDef& mesh = scene.surfaces[0];
  ASSERT_EQ(mesh.body, 1);
  mesh.shape = SurfaceDef::Shape::mesh;
  scene.ligaments.clear();
  scene.loads.clear();
  int asked = 0;
  const auto in_its_file = [&](const Vec3& middle) {
    return [&asked, middle](const SurfaceDef& s) -> std::optional<Vec3> {
      EXPECT_EQ(s.name, "ball");
      ++asked;
      return middle;
    };
  };
  EXPECT_EQ(choose_origins(scene, in_its_file(Vec3(0, 4000, 0.01)))[1], Vec3::Zero())
      << "the file has it 4 km the other way";
  EXPECT_LT((choose_origins(scene, in_its_file(Vec3(0, 0, 0.01)))[1] - Vec3(0, -4000, 0)).norm(), 0.1)
      << "the file has it at its origin";
  EXPECT_EQ(asked, 2);
}

}  // namespace
}  // namespace genu::scene_test
