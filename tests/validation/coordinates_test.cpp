// What coordinates must not depend on: the side of the body, the place and turn of the whole joint, the origins of the
// bodies, the unit of length; and what they must mean: angles that act along their axes, in any sequence.
#include <cmath>
#include <cstdio>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "genu/core/units.h"
#include "genu/model/potential_energy.h"
#include "support/knee_scene.h"
#include "support/scenes.h"
#include "support/solved.h"

namespace genu {
namespace {

/// Dortmans' right knee flexed to 70 deg, x lateral, y anterior, z proximal, with its clinical description.
Scene right_knee() {
  Diagnostics out;
  Scene scene = read_scene(test::dortmans_file(), out).value();
  GroodSuntayDef def;
  def.femur.body = scene.joints[0].child;
  def.tibia.body = scene.joints[0].parent;
  def.femur.origin = Vec3(1e-3, -2e-3, 4e-3);
  def.tibia.origin = Vec3(-2e-3, 3e-3, -5e-3);
  scene.joints[0].grood_suntay = def;
  scene.steps[0].increments = 14;
  return scene;
}

ResultTable solved(const Scene& scene) {
  const Solution solution = test::solved(scene);
  EXPECT_EQ(solution.summary.exit_code, kExitOk);
  return solution.poses;
}

/// Calls visit(body, point), turn(placement's axes) and direct(direction) for what a scene fixes to a body.
template <typename Visit, typename Turn, typename Direct>
void for_geometry(Scene& scene, Visit visit, Turn turn, Direct direct) {
  for (SurfaceDef& s : scene.surfaces) {
    visit(s.body, s.placement.p);
    turn(s.placement.R);
  }
  for (LigamentDef& l : scene.ligaments)
    for (LigamentDef::End* end : {&l.from, &l.to}) visit(end->body, end->point);
  for (LoadDef& l : scene.loads) visit(l.body, l.point);
  for (JointDef& j : scene.joints) {
    if (!j.grood_suntay) continue;
    for (GroodSuntayDef::Bone* bone : {&j.grood_suntay->femur, &j.grood_suntay->tibia}) {
      visit(bone->body, bone->origin);
      direct(bone->proximal);
      direct(bone->anterior);
    }
  }
}

/// Largest difference of a column to `sign` times the other's, relative to the larger of 1 and the column's largest.
double worst_of(const ResultTable& a, const ResultTable& b, const std::string& column, double sign = 1) {
  double worst = 0, size = 1;
  EXPECT_EQ(a.rows(), b.rows());
  for (std::size_t row = 0; row < std::min(a.rows(), b.rows()); ++row) {
    const double x = a.number(row, column), y = sign * b.number(row, column);
    if (std::isnan(x) && std::isnan(y)) continue;
    size = std::max(size, std::abs(x));
    worst = std::abs(x - y) <= worst ? worst : std::abs(x - y);  // NaN wins
  }
  return worst / size;
}

std::vector<std::string> number_columns(const ResultTable& t) {
  const std::set<std::string> others{"step",      "increment",         "time_s",  "status",
                                     "stability", "newton.iterations", "residual"};
  std::vector<std::string> names;
  for (const std::string& name : t.columns())
    if (others.count(name) == 0) names.push_back(name);
  return names;
}

TEST(Coordinates, AMirroredKneeHasMirroredResults) {
  const Scene right = right_knee();
  Scene left = right;
  const Mat3 mirror = Vec3(-1, 1, 1).asDiagonal();
  // Planes and tori are their own mirror images.
  for_geometry(
      left, [&](int, Vec3& p) { p = mirror * p; }, [&](Mat3& R) { R = mirror * R * mirror; },
      [&](Vec3& v) { v = mirror * v; });
  JointDef& joint = left.joints[0];
  joint.grood_suntay->right = false;
  for (auto& r : joint.rotations) r.axis = -mirror * r.axis;  // an axis of rotation is a pseudo-vector
  joint.reference[3] *= -1;
  const ResultTable a = solved(right), b = solved(left);
  double worst = 0;
  for (const std::string& name : number_columns(a)) {
    const double difference = worst_of(a, b, name, name.ends_with(".x_mm") ? -1 : 1);
    EXPECT_LT(difference, 1e-10) << name;
    worst = std::max(worst, difference);
  }
  std::printf("mirrored knee: worst difference %.1e of %zu columns\n", worst, number_columns(a).size());
  // The knee screws: the description has something to mirror.
  EXPECT_GT(std::abs(a.number(a.rows() - 1, "knee.gs.external_rotation_deg")), 0.1);
  EXPECT_NEAR(a.number(a.rows() - 1, "knee.gs.flexion_deg"), 70, 2);
}

/// The joint's translation in the frame of the tibia that was, from a table of the moved joint: the fixed body's points
/// were carried by X, those of the other turned by X and then moved by `away` from its origin.
Vec3 moved_back(const Scene& moved, const ResultTable& t, std::size_t row, const Pose& X, const Vec3& away) {
  const JointDef& joint = moved.joints[0];
  Mat3 R = Mat3::Identity();
  Vec3 p;
  for (std::size_t i = 0; i < 3; ++i) {
    const double angle = units::kDegree * t.number(row, fmt::format("knee.{}_deg", joint.rotations[i].name));
    R = R * exp_rotation(angle * joint.rotations[i].axis);
    p[static_cast<Eigen::Index>(i)] = 1e-3 * t.number(row, fmt::format("knee.{}_mm", joint.translations[i]));
  }
  return X.inverse() * Vec3(p + R * away);
}

/// Everything moved by X, the femur's own origin moved `away` from it besides.
Scene moved_knee(const Scene& here, const Pose& X, const Vec3& away) {
  Scene there = here;
  const int parent = here.joints[0].parent;
  for_geometry(
      there, [&](int body, Vec3& p) { p = body == parent ? Vec3(X * p) : Vec3(X.R * p + away); },
      [&](Mat3& R) { R = X.R * R; }, [&](Vec3& v) { v = X.R * v; });
  JointDef& joint = there.joints[0];
  Mat3 R = Mat3::Identity();
  for (std::size_t i = 0; i < 3; ++i) {
    joint.rotations[i].axis = X.R * joint.rotations[i].axis;
    R = R * exp_rotation(joint.reference[i] * joint.rotations[i].axis);
  }
  const Vec3 origin = X * Vec3(joint.reference[3], joint.reference[4], joint.reference[5]) - R * away;
  std::copy(origin.begin(), origin.end(), joint.reference.begin() + 3);
  return there;
}

void expect_same_knee(const Scene& here, const Pose& X, const Vec3& away) {
  SCOPED_TRACE(fmt::format("moved by {:.0f} m, own origin {:.0f} m away", X.p.norm(), away.norm()));
  const Scene there = moved_knee(here, X, away);
  const ResultTable a = solved(here), b = solved(there);
  ASSERT_EQ(a.rows(), b.rows());
  double translation = 0, point = 0, other = 0;
  for (std::size_t row = 0; row < a.rows(); ++row) {
    const auto vector = [&](const ResultTable& t, const std::string& name) {
      return Vec3(1e-3 *
                  Vec3(t.number(row, name + ".x_mm"), t.number(row, name + ".y_mm"), t.number(row, name + ".z_mm")));
    };
    translation = std::max(translation, (moved_back(there, b, row, X, away) - vector(a, "knee")).norm());
    for (const ContactDef& c : here.contacts)
      for (const int surface : {c.surface_a, c.surface_b}) {
        const SurfaceDef& s = here.surfaces[at(surface)];
        const std::string name = c.name + "." + s.name;
        const Vec3 there_point = vector(b, name);
        const Vec3 back = here.bodies[at(s.body)].fixed ? Vec3(X.inverse() * there_point)
                                                        : Vec3(X.R.transpose() * (there_point - away));
        point = std::max(point, (back - vector(a, name)).norm());
      }
    EXPECT_EQ(test::word(b, row, "stability"), test::word(a, row, "stability"));
  }
  for (const std::string& name : number_columns(a)) {
    const bool of_a_frame = name.ends_with(".x_mm") || name.ends_with(".y_mm") || name.ends_with(".z_mm");
    if (of_a_frame || (name == "stability.min_eigenvalue_Nmm" && !away.isZero())) continue;
    const double difference = worst_of(a, b, name);
    EXPECT_LT(difference, 1e-7) << name;
    other = std::max(other, difference);
  }
  std::printf("moved by %.0f m, own origin %.0f m away: origin %.1e mm, contact points %.1e mm, other columns %.1e\n",
              X.p.norm(), away.norm(), 1e3 * translation, 1e3 * point, other);
  EXPECT_LT(1e3 * translation, 1e-7);
  EXPECT_LT(1e3 * point, 1e-7);
}

TEST(Coordinates, AJointMovedByAKilometreAndTurnedIsTheSameJoint) {
  const Pose far{exp_rotation(Vec3(0.7, -1.1, 2.0)), Vec3(700, -400, 600)};
  const Vec3 away(-300, 800, 500);
  const Scene knee = right_knee();
  expect_same_knee(knee, far, Vec3::Zero());
  expect_same_knee(knee, {}, away);
  expect_same_knee(knee, far, away);
  expect_same_knee(knee, {}, 0.1 * away);
  expect_same_knee(knee, {}, 1e-3 * away);
}

TEST(Coordinates, AMeasuredJointFarFromItsOrigins) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart.stl");
  Diagnostics out;
  auto knee = parse_scene(test::lenhart_scene("-coarse", 0, 30, 6), "scene.toml", out);
  ASSERT_TRUE(knee.has_value()) << test::messages(out);
  for (ContactDef& c : knee->contacts) c.regions.clear();
  // Moved, but not turned: a mesh's smooth surface has its nodes where the axes of its body put them.
  expect_same_knee(*knee, {}, Vec3(-300, 800, 500));
  expect_same_knee(*knee, {Mat3::Identity(), Vec3(700, -400, 600)}, Vec3(-300, 800, 500));
}

TEST(Coordinates, MillimetresAndMetresInEveryColumn) {
  const auto text = [](double unit, const char* name) {
    const auto p = [&](double x, double y, double z) {
      return fmt::format("[{}, {}, {}]", x * unit, y * unit, z * unit);
    };
    return "format = 1\nunits = { length = \"" + std::string(name) + "\", angle = \"deg\" }\n" +
           fmt::format(
               "[body.tibia]\nfixed = true\n[body.femur]\n[joint.knee]\ntype = \"free\"\nparent = "
               "\"tibia\"\nchild = \"femur\"\nrotations = [\"a x\", \"b y\", \"c z\"]\ntranslations = "
               "[\"x\", \"y\", \"z\"]\nreference = {{ z = {} }}\ngrood_suntay = {{ side = \"left\", femur = {{ "
               "body = \"femur\", proximal = \"z\", anterior = \"y\", origin = {} }}, tibia = {{ body = "
               "\"tibia\", proximal = [0, 0.1, 1], anterior = \"y\", origin = {} }} }}\n",
               20 * unit, p(1, 2, 3), p(-3, 2, 1)) +
           fmt::format(
               "[surface.ball]\nbody = \"femur\"\nshape = \"ellipsoid\"\nradii = {}\n[surface.floor]\nbody = "
               "\"tibia\"\nshape = \"plane\"\n[contact.foot]\nsurfaces = [\"ball\", \"floor\"]\nmodel = "
               "\"rigid\"\n[load.weight]\nbody = \"femur\"\nforce = [1, 2, -30]\npoint = {}\n",
               p(25, 30, 20), p(3, -2, 5)) +
           fmt::format(
               "[ligament.one]\nfrom = {{ body = \"femur\", point = {} }}\nto = {{ body = \"tibia\", point = {} "
               "}}\nlaw = \"spring\"\nstiffness = {}\nslack_length = {}\n",
               p(20, 5, 0), p(30, 0, -25), 4 / unit, 25 * unit) +
           fmt::format(
               "[ligament.two]\nfrom = {{ body = \"femur\", point = {} }}\nto = {{ body = \"tibia\", point = {} "
               "}}\nlaw = \"quadratic\"\nstiffness = 9000\nreference_strain = 0.04\n",
               p(-22, -5, 3), p(-30, 4, -25)) +
           fmt::format(
               "[ligament.three]\nfrom = {{ body = \"femur\", point = {} }}\nto = {{ body = \"tibia\", point = "
               "{} }}\nlaw = \"blankevoort\"\nstiffness = 7000\ntransition_strain = 0.06\nreference_strain = "
               "0.05\n[[step]]\nprescribe = {{ \"knee.a\" = [0, 20], \"knee.x\" = {} }}\nincrements = 10\n",
               p(3, 28, -2), p(-4, 35, -20), unit);
  };
  const ResultTable mm = test::table_of(text(1, "mm")), m = test::table_of(text(1e-3, "m"));
  double worst = 0;
  for (const std::string& name : number_columns(mm)) {
    const double difference = worst_of(mm, m, name);
    EXPECT_LT(difference, 1e-10) << name;
    worst = std::max(worst, difference);
  }
  std::printf("mm and m: worst difference %.1e of %zu columns\n", worst, number_columns(mm).size());
}

/// The whole leg on a cart: the tibia is a moving body as well, and the scene says where it stands.
Scene knee_on_a_cart(const JointValues& place) {
  Scene scene = right_knee();
  const int tibia = scene.joints[0].parent;
  scene.bodies[at(tibia)].fixed = false;
  BodyDef ground;
  ground.name = "ground";
  ground.fixed = true;
  scene.bodies.push_back(ground);
  JointDef cart;
  cart.name = "cart";
  cart.parent = static_cast<int>(scene.bodies.size()) - 1;
  cart.child = tibia;
  for (std::size_t i = 0; i < 3; ++i) {
    cart.rotations[i] = {std::string(1, "abc"[i]), Vec3::Unit(static_cast<Eigen::Index>(i))};
    cart.translations[i] = std::string(1, "uvw"[i]);
  }
  cart.reference = place;
  scene.joints.push_back(cart);
  for (int i = 0; i < 6; ++i) scene.steps[0].prescribe.push_back({{1, i}, place[at(i)], place[at(i)]});
  return scene;
}

TEST(Coordinates, ACartPlacesTheJointAnywhere) {
  const ResultTable a = solved(knee_on_a_cart({})), b = solved(knee_on_a_cart({0.7, -1.1, 2.0, 700, -400, 600}));
  double worst = 0;
  for (const std::string& name : number_columns(a)) {
    if (name.starts_with("cart.")) continue;
    const double difference = worst_of(a, b, name);
    EXPECT_LT(difference, 1e-7) << name;
    worst = std::max(worst, difference);
  }
  std::printf("on a cart 1 km away: worst difference %.1e\n", worst);
  const ResultTable fixed = solved(right_knee());
  EXPECT_LT(worst_of(fixed, a, "knee.rotation_deg"), 1e-9);
}

/// R1 R2 R3 about the axes x, -x, y, -y, z, -z (by index).
Mat3 product_of(const int* axes, const double* angles) {
  Mat3 R = Mat3::Identity();
  for (int n = 0; n < 3; ++n)
    R = R * Eigen::AngleAxisd((axes[n] % 2 ? -1 : 1) * angles[n], Vec3::Unit(axes[n] / 2)).matrix();
  return R;
}

/// Four springs that the bone stretches alike wherever it is turned: their anchors are turned with it.
std::string springs_about(const Mat3& R) {
  const auto spring = [&](const char* name, const char* point, const Vec3& anchor, double stiffness) {
    const Vec3 a = R * anchor;
    return test::spring(name, point, fmt::format("[{:.17g}, {:.17g}, {:.17g}]", a[0], a[1], a[2]), stiffness, 5);
  };
  return spring("one", "[40, 3, -5]", {60, 20, 10}, 5) + spring("two", "[-10, 35, 5]", {0, 70, -20}, 7) +
         spring("three", "[4, -10, 45]", {-30, 5, 70}, 6) + spring("four", "[-20, -30, -10]", {-50, -40, 0}, 8);
}

TEST(Coordinates, EveryAngleOfEverySequenceActsAlongItsAxis) {
  const char* axes[] = {"x", "-x", "y", "-y", "z", "-z"};
  const double reference[] = {0.3, 0.5, -0.4};
  double worst_pose = 0, worst_work = 0;
  int sequences = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      for (int k = 0; k < 6; ++k) {
        if (i / 2 == j / 2 || j / 2 == k / 2) continue;
        ++sequences;
        const int index[] = {i, j, k};
        const Mat3 reference_rotation = product_of(index, reference);
        const std::string text =
            fmt::format(
                "format = 1\nunits = {{ length = \"mm\", angle = \"rad\" }}\n[body.ground]\nfixed = true\n[body.bone]\n"
                "[joint.j]\ntype = \"free\"\nparent = \"ground\"\nchild = \"bone\"\n"
                "rotations = [\"q0 {}\", \"q1 {}\", \"q2 {}\"]\ntranslations = [\"x\", \"y\", \"z\"]\n"
                "reference = {{ q0 = 0.3, q1 = 0.5, q2 = -0.4 }}\n",
                axes[i], axes[j], axes[k]) +
            springs_about(reference_rotation);
        for (int angle = 0; angle < 3; ++angle) {
          constexpr double kStep = 4e-3;  // rad
          const double q = reference[angle];
          const auto s = test::scene_model(
              text + test::step(fmt::format("prescribe = {{ \"j.q{}\" = [{:.17g}, {:.17g}] }}\nincrements = 4", angle,
                                            q - 2 * kStep, q + 2 * kStep)));
          const test::Followed follow = test::follow(s);
          ASSERT_TRUE(follow.result.complete) << text << follow.story();
          std::vector<double> energy;
          for (const PosePoint& point : follow.points) {
            energy.push_back(*potential_energy(s.model, point.pose.state, point.target));
            const JointValues& found = point.pose.state.coordinates[0];
            const Mat3 R = product_of(index, found.data());
            worst_pose = std::max({worst_pose, (R - point.pose.state.poses[1].R).norm(),
                                   std::abs(found[at(angle)] - point.target.prescribed[0].value)});
          }
          // What holds the angle does all the work on the springs.
          const double slope = (8 * (energy[3] - energy[1]) - (energy[4] - energy[0])) / (12 * kStep);
          const double reaction = follow.points[2].pose.state.multipliers[0];
          worst_work = std::max(worst_work, std::abs(slope - reaction) / std::max(0.1, std::abs(reaction)));
        }
      }
  std::printf("%d sequences: rotation off by %.1e, reaction off its work by %.1e\n", sequences, worst_pose, worst_work);
  EXPECT_EQ(sequences, 96);
  EXPECT_LT(worst_pose, 1e-11);
  EXPECT_LT(worst_work, 1e-6);
}

}  // namespace
}  // namespace genu
