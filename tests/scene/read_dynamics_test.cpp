#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

const std::string kSwing = R"(format = 1
units = { length = "mm", angle = "deg" }
[body.ground]
fixed = true
[body.link]
mass = 2
centre_of_mass = [0, -100, 5]
inertia = [0.03, 0.02, 0.04, 0.001, 0.002, -0.003]
[joint.h]
type = "revolute"
parent = "ground"
child = "link"
axis = [0, 0, 1]
stiffness = 0.5
damping = 0.25
[ligament.cord]
from = { body = "ground", point = [50, 0, 0] }
to = { body = "link", point = [0, -50, 0] }
law = "linear"
stiffness = 10
slack_length = 80
damping = 3
[load.drive]
on = "h.angle"
[dynamics]
duration = 2
output_interval = 0.5
tolerance = 1e-6
start_rates = { "h.angle" = 90 }
)";

Scene read(const std::string& text) {
  Diagnostics out;
  const auto scene = parse_scene(text, "s", out);
  EXPECT_TRUE(scene) << all_messages(out);
  return scene.value_or(Scene{});
}

void refused(const std::string& piece, const std::string& by, const std::string& key, const std::string& found,
             const std::string& rule) {
  SCOPED_TRACE(by);
  expect_one_error(edited(piece, by, kSwing), key, found, rule);
}

TEST(ReadDynamics, AllOfItInSiUnits) {
  const Scene scene = read(kSwing);
  ASSERT_TRUE(scene.dynamics);
  EXPECT_EQ(scene.dynamics->duration, 2);
  EXPECT_EQ(scene.dynamics->output_interval, 0.5);
  EXPECT_EQ(scene.dynamics->tolerance, 1e-6);
  ASSERT_EQ(scene.dynamics->start_rates.size(), 1u);
  EXPECT_NEAR(scene.dynamics->start_rates[0].value, M_PI / 2, 1e-15);
  EXPECT_TRUE(scene.steps.empty());
  Mat3 inertia;
  inertia << 0.03, 0.001, 0.002, 0.001, 0.02, -0.003, 0.002, -0.003, 0.04;
  EXPECT_EQ(scene.bodies[1].inertia, inertia);
  EXPECT_NEAR(scene.bodies[1].centre_of_mass.y(), -0.1, 1e-15);
  EXPECT_NEAR(scene.joints[0].damping, 0.25 * 180 / M_PI, 1e-13) << "N m s/rad";
  EXPECT_NEAR(scene.ligaments[0].damping, 3000, 1e-10) << "N s/m";
  EXPECT_EQ(read(edited("tolerance = 1e-6\n", "", kSwing)).dynamics->tolerance, 1e-9);
}

TEST(ReadDynamics, Errors) {
  refused("[body.link]\nmass = 2\n", "[body.@link]\n", "body.link.mass", "", "is missing");
  refused("duration = 2", "duration = @0", "dynamics.duration", "0", "must be > 0 s");
  refused("output_interval = 0.5", "output_interval = @-1", "dynamics.output_interval", "-1", "must be > 0 s");
  refused("output_interval = 0.5", "output_interval = @3", "dynamics.output_interval", "3", "at most the duration");
  refused("output_interval = 0.5", "output_interval = @1e-9", "dynamics.output_interval", "1e-09", "rows");
  refused("tolerance = 1e-6", "tolerance = @0", "dynamics.tolerance", "0", "must be > 0");
  refused("tolerance = 1e-6", "tolerance = @1e-20", "dynamics.tolerance", "1e-20", "must be from 1e-12 to 0.01");
  refused("tolerance = 1e-6", "@tolerence = 1e-6", "dynamics.tolerence", "1e-06", "did you mean \"tolerance\"?");
  refused("{ \"h.angle\" = 90 }", "{ @\"h.angel\" = 90 }", "dynamics.start_rates.h.angel", "", "h.angle");
  refused("on = \"h.angle\"", "on = @\"k.angle\"", "load.drive.on", "\"k.angle\"", "unknown coordinate");
  refused("damping = 0.25", "damping = @-1", "joint.h.damping", "-1", "must be >= 0 N m s/deg");
  refused("damping = 3", "damping = @-3", "ligament.cord.damping", "-3", "must be >= 0 N s/mm");
}

TEST(ReadDynamics, InertiasThatNoBodyHas) {
  const std::string good = "[0.03, 0.02, 0.04, 0.001, 0.002, -0.003]";
  refused(good, "@[0.01, 0.01, 0.03]", "body.link.inertia", "[0.01, 0.01, 0.03]", "at most the sum of the other two");
  refused(good, "@[1, 1, 1, 2, 0, 0]", "body.link.inertia", "[1, 1, 1, 2, 0, 0]", "must be >= 0");
  refused(good, "[0.03, @-0.02, 0.04]", "body.link.inertia[2]", "-0.02", "must be >= 0 kg m^2");
  refused(good, "@[0.03, 0.02]", "body.link.inertia", "[0.03, 0.02]", "[xx, yy, zz]");
  EXPECT_EQ(read(edited(good, "[0.1, 0, 0.1]", kSwing)).bodies[1].inertia(1, 1), 0) << "a thin rod";
}

TEST(ReadDynamics, NotBuiltYet) {
  expect_one_error(kSwing + "[[@step]]\nincrements = 1\n", "step", "", "not built yet: steps in a scene with");
  const std::string contact =
      "[surface.a]\nbody = \"link\"\nshape = \"sphere\"\nradius = 9\n[surface.b]\nbody = "
      "\"ground\"\nshape = \"plane\"\n[contact.@c]\nsurfaces = [\"a\", \"b\"]\nmodel = ";
  expect_one_error(kSwing + contact + "\"rigid\"\n", "contact.c", "", "not built yet: rigid contact in motion");
  expect_one_error(kSwing + contact + "\"cartilage\"\nmodulus = 5\npoisson = 0.4\nthickness = 4\n", "contact.c", "",
                   "not built yet: cartilage in motion");
}

TEST(ReadDynamics, NothingThatCanMove) {
  const std::string held = edited("axis = [0, 0, 1]\nstiffness = 0.5\ndamping = 0.25\n", "",
                                  edited("\"revolute\"", "\"fixed\"",
                                         edited("on = \"h.angle\"", "body = \"link\"\nforce = [1, 0, 0]",
                                                edited("start_rates = { \"h.angle\" = 90 }\n", "", kSwing))));
  expect_one_error(edited("[dynamics]", "[@dynamics]", held), "dynamics", "", "every joint is fixed");
}

}  // namespace
}  // namespace genu::scene_test
