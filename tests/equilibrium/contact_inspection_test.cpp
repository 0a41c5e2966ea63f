// Each thing that can be wrong with the contacts of a pose is found where it was put, and nothing where all is well.
#include "genu/equilibrium/contact_inspection.h"

#include <memory>

#include <gtest/gtest.h>

#include "genu/equilibrium/tolerances.h"
#include "genu/path/path.h"
#include "support/solved.h"

namespace genu {
namespace {

/// The ball of held_ball with its centre at `z` mm, held to the floor or not.
struct InspectedBall {
  test::SceneModel scene;
  ContactField field;
  ContactInspector inspector;
  State state;

  explicit InspectedBall(double z)
      : scene(test::scene_model(test::held_ball("", z))),
        field(scene.model),
        inspector(scene.model, field),
        state(reference_state(scene.model)) {}
  void hold(double force) {
    test::hold(scene.model, state, 0, Vec3::Zero());
    state.contacts.back().force = force;
  }
  Findings findings() {
    Findings out;
    inspector.inspect(state, out);
    return out;
  }
};

TEST(ContactInspection, NothingIsWrongWithABallThatStands) {
  InspectedBall bench(20);
  bench.hold(50);
  const Findings f = bench.findings();
  EXPECT_TRUE(f.none()) << f.where;
  EXPECT_GE(f.worst, 0);
  const Certificate c = bench.inspector.certify(bench.state, 1e-13);
  EXPECT_EQ(c.smallest_force, 50);
  EXPECT_NEAR(c.least_opposed, -1, 1e-14);
  EXPECT_NEAR(c.smallest_gap, 0, 1e-12);
  EXPECT_EQ(c.residual, 1e-13);
}

TEST(ContactInspection, FindsAnOverlapThatIsNotHeld) {
  InspectedBall bench(19.9);
  const Findings f = bench.findings();
  EXPECT_FALSE(f.none());
  ASSERT_EQ(f.overlapping.size(), 1u);
  EXPECT_NEAR(f.overlapping[0].minimum.gap, -1e-4, 1e-12);
  EXPECT_NEAR(f.worst, -1e-4 / bench.scene.model.scales.length, 1e-9);
  EXPECT_FALSE(f.deep_overlap);
}

TEST(ContactInspection, FindsAContactThatPullsButNotRounding) {
  InspectedBall bench(20);
  bench.hold(-0.5);
  EXPECT_EQ(bench.findings().pulling, std::vector<int>{0});
  EXPECT_FALSE(bench.findings().none());
  bench.state.contacts[0].force = -0.5 * kPullTolerance * bench.scene.model.scales.force;
  EXPECT_TRUE(bench.findings().none());
}

TEST(ContactInspection, MarginOfTheOnlyContactIsThatOfItsForceOrGap) {
  InspectedBall pulled(20);
  pulled.hold(-0.5);
  Findings f = pulled.findings();
  ASSERT_TRUE(f.only_a_contact());
  pulled.state.contacts[0].force = 3;
  const double scale = pulled.scene.model.scales.force, length = pulled.scene.model.scales.length;
  EXPECT_NEAR(pulled.inspector.margin_of_contact(pulled.state, f), 3 / scale, 2 * kPullTolerance);
  InspectedBall deep(19.9);
  f = deep.findings();
  ASSERT_TRUE(f.only_a_contact());
  for (const double gap : {-1e-4, -1e-5, 1e-5, 1e-4}) {
    deep.state.poses[1].p.z() = 0.02 + gap;
    EXPECT_NEAR(deep.inspector.margin_of_contact(deep.state, f), gap / length, 1e-9) << gap;
    EXPECT_NEAR(f.overlapping[0].minimum.gap, gap, 1e-12) << "it moves along";
  }
}

TEST(ContactInspection, ForcesAloneTakeNoSearch) {
  InspectedBall bench(19.9);
  bench.hold(-0.5);
  bench.scene.model.meter = std::make_shared<EffectMeter>();
  const auto before = bench.scene.model.meter->evaluations(Effect::contact_search);
  Findings f;
  bench.inspector.inspect_forces(bench.state, f);
  EXPECT_EQ(f.pulling, std::vector<int>{0});
  EXPECT_TRUE(f.overlapping.empty());
  EXPECT_EQ(bench.scene.model.meter->evaluations(Effect::contact_search), before);
}

TEST(ContactInspection, ToleranceOfGapsGrowsWithTheDistanceFromTheOrigin) {
  InspectedBall here(20), there(20);
  there.scene.model.reference_poses[1].p.x() = 1e3;
  const ContactInspector far(there.scene.model, there.field);
  EXPECT_LT(here.inspector.gap_tolerance(), 1e-14);
  EXPECT_GT(far.gap_tolerance(), 1e3 * std::numeric_limits<double>::epsilon());
  EXPECT_LT(far.gap_tolerance(), 1e-10);
}

TEST(ContactInspection, HeldMeansNearOnBothSurfacesOfTheSamePair) {
  InspectedBall bench(20);
  bench.hold(1);
  Candidate same{0, {bench.state.contacts[0].geometry, 0}};
  EXPECT_TRUE(bench.inspector.held(bench.state, same));
  same.minimum.contact.a.p.x() += 0.9 * bench.inspector.same_contact();
  EXPECT_TRUE(bench.inspector.held(bench.state, same));
  Candidate beside = same;
  beside.minimum.contact.b.p.y() += 1.1 * bench.inspector.same_contact();
  EXPECT_FALSE(bench.inspector.held(bench.state, beside));
  same.pair = 1;
  EXPECT_FALSE(bench.inspector.held(bench.state, same));
}

/// A plane that ends at x = `end`.
struct Shelf final : Surface {
  std::unique_ptr<Surface> plane = make_plane({}, false);
  double end;
  explicit Shelf(double x) : end(x) {}
  bool project(const Vec3& x, SurfacePoint& out) const override { return plane->project(x, out); }
  std::optional<double> gap(const Vec3& x) const override { return plane->gap(x); }
  double edge_distance(const Vec3& p) const override { return end - p.x(); }
  Mesh triangles(double edge, const Vec3& centre, double reach) const override {
    return plane->triangles(edge, centre, reach);
  }
};

TEST(ContactInspection, FindsAContactPastAnEdgeAndNamesIt) {
  for (const auto& [end, past] : {std::pair{1e-3, false}, {-1e-3, true}}) {
    test::SceneModel scene = test::scene_model(test::held_ball("", 20));
    scene.model.pairs[0].b = std::make_shared<Shelf>(end);
    ContactField field(scene.model);
    ContactInspector inspector(scene.model, field);
    State state = reference_state(scene.model);
    test::hold(scene.model, state, 0, Vec3::Zero());
    state.contacts[0].force = 1;
    Findings f;
    inspector.inspect(state, f);
    EXPECT_EQ(f.over_edge, past);
    EXPECT_EQ(f.none(), !past);
    EXPECT_EQ(f.where, past ? "foot.1" : "");
    EXPECT_NEAR(inspector.certify(state, 0).edge_distance, end, 1e-12);
  }
}

/// A plane with a place round (x, 0, 0) that is not to be trusted.
struct Flawed final : Surface {
  std::unique_ptr<Surface> plane = make_plane({}, false);
  std::vector<DoubtfulPlace> places;
  Flawed(double x, double half, double reach, bool missing)
      : places{{"a hole near here", {{x - half, 0, 0}, {x, 0, 0}, {x + half, 0, 0}}, reach, missing}} {}
  bool project(const Vec3& x, SurfacePoint& out) const override { return plane->project(x, out); }
  std::optional<double> gap(const Vec3& x) const override { return plane->gap(x); }
  Mesh triangles(double edge, const Vec3& centre, double reach) const override {
    return plane->triangles(edge, centre, reach);
  }
  std::span<const DoubtfulPlace> doubtful() const override { return places; }
};

TEST(ContactInspection, FindsAContactThatLeansOnAFlawAndNamesIt) {
  // The ball of 20 mm touches at x = 0; it is 0.4 mm above the plane at 4 mm. 4 mm of missing surface stand out by at
  // most 0.32 mm, 5 mm by 0.5 mm.
  struct Case {
    double x, half, reach;
    bool missing, leans;
  };
  constexpr Case kCases[] = {{1e-3, 0, 3e-3, false, true},     {4e-3, 0, 3e-3, false, false},
                             {8e-3, 4e-3, 3e-3, true, false},  {9e-3, 5e-3, 3e-3, true, true},
                             {9e-3, 5e-3, 3e-3, false, false}, {9e-3, 5e-3, 4e-3, true, true},
                             {4e-3, 1e-3, 2e-3, true, false}};
  for (const auto& [x, half, reach, missing, leans] : kCases) {
    test::SceneModel scene = test::scene_model(test::held_ball("", 20));
    scene.model.pairs[0].b = std::make_shared<Flawed>(x, half, reach, missing);
    ContactField field(scene.model);
    ContactInspector inspector(scene.model, field);
    State state = reference_state(scene.model);
    test::hold(scene.model, state, 0, Vec3::Zero());
    state.contacts[0].force = 1;
    Findings f;
    inspector.inspect(state, f);
    EXPECT_EQ(f.doubtful, leans) << x << " " << missing;
    EXPECT_EQ(f.none(), !leans) << x << " " << missing;
    EXPECT_EQ(f.final(), leans);
    EXPECT_EQ(f.where, leans ? "a hole near here" : "");
    EXPECT_EQ(end_of(f), leans ? PathEvent::Kind::flawed_mesh : PathEvent::Kind::overlap);
  }
}

/// Knows only a shell of 1 mm: what overlaps deeper is seen through its triangles alone.
struct Shell final : Surface {
  std::unique_ptr<Surface> plane = make_plane({}, false);
  static bool known(const Vec3& x) { return std::abs(x.z()) < 1e-3; }
  bool project(const Vec3& x, SurfacePoint& out) const override { return known(x) && plane->project(x, out); }
  std::optional<double> gap(const Vec3& x) const override { return known(x) ? plane->gap(x) : std::nullopt; }
  Mesh triangles(double edge, const Vec3& centre, double reach) const override {
    return plane->triangles(edge, centre, reach);
  }
  bool is_global() const override { return false; }
};

TEST(ContactInspection, SeesOverlapDeeperThanTheSmoothBand) {
  test::SceneModel scene = test::scene_model(test::held_ball("", 17));
  scene.model.pairs[0].b = std::make_shared<Shell>();
  ContactField field(scene.model);
  ContactInspector inspector(scene.model, field);
  Findings f;
  inspector.inspect(reference_state(scene.model), f);
  EXPECT_FALSE(f.none());
  EXPECT_NEAR(f.worst * scene.model.scales.length, -3e-3, 1e-4);
}

}  // namespace
}  // namespace genu
