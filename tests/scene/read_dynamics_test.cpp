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

Scene motion_of(const std::string& text) {
  Diagnostics out;
  const auto scene = parse_scene(text, "s", out);
  EXPECT_TRUE(scene) << all_messages(out);
  return scene.value_or(Scene{});
}

void expect_dynamics_refused(const std::string& piece, const std::string& by, const std::string& key,
                             const std::string& found, const std::string& rule) {
  SCOPED_TRACE(by);
  expect_one_error(edited(piece, by, kSwing), key, found, rule);
}

TEST(ReadDynamics, AllOfItInSiUnits) {
  const Scene scene = motion_of(kSwing);
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
  EXPECT_EQ(motion_of(edited("tolerance = 1e-6\n", "", kSwing)).dynamics->tolerance, 1e-9);
}

TEST(ReadDynamics, Errors) {
  expect_dynamics_refused("[body.link]\nmass = 2\n", "[body.@link]\n", "body.link.mass", "", "is missing");
  expect_dynamics_refused("duration = 2", "duration = @0", "dynamics.duration", "0", "must be > 0 s");
  expect_dynamics_refused("output_interval = 0.5", "output_interval = @-1", "dynamics.output_interval", "-1",
                          "must be > 0 s");
  expect_dynamics_refused("output_interval = 0.5", "output_interval = @3", "dynamics.output_interval", "3",
                          "at most the duration");
  expect_dynamics_refused("output_interval = 0.5", "output_interval = @1e-9", "dynamics.output_interval", "1e-09",
                          "rows");
  expect_dynamics_refused("tolerance = 1e-6", "tolerance = @0", "dynamics.tolerance", "0", "must be > 0");
  expect_dynamics_refused("tolerance = 1e-6", "tolerance = @1e-20", "dynamics.tolerance", "1e-20",
                          "must be from 1e-12 to 0.01");
  expect_dynamics_refused("tolerance = 1e-6", "@tolerence = 1e-6", "dynamics.tolerence", "1e-06",
                          "did you mean \"tolerance\"?");
  expect_dynamics_refused("{ \"h.angle\" = 90 }", "{ @\"h.angel\" = 90 }", "dynamics.start_rates.h.angel", "",
                          "h.angle");
  expect_dynamics_refused("on = \"h.angle\"", "on = @\"k.angle\"", "load.drive.on", "\"k.angle\"",
                          "unknown coordinate");
  expect_dynamics_refused("damping = 0.25", "damping = @-1", "joint.h.damping", "-1", "must be >= 0 N m s/deg");
  expect_dynamics_refused("damping = 3", "damping = @-3", "ligament.cord.damping", "-3", "must be >= 0 N s/mm");
}

TEST(ReadDynamics, ALayerThatIsDamped) {
  const std::string layer = R"([surface.tip]
body = "link"
shape = "sphere"
radius = 20
[surface.floor]
body = "ground"
shape = "plane"
[contact.c]
surfaces = ["tip", "floor"]
model = "cartilage"
modulus = 5
poisson = 0.4
thickness = 4
damping = 0.002
)";
  const Scene scene = motion_of(edited("[dynamics]", layer + "[dynamics]", kSwing));
  ASSERT_EQ(scene.layers.size(), 1u);
  EXPECT_NEAR(scene.layers[0].damping, 2, 1e-15) << "s/m";
}

TEST(ReadDynamics, InertiasThatNoBodyHas) {
  const std::string good = "[0.03, 0.02, 0.04, 0.001, 0.002, -0.003]";
  expect_dynamics_refused(good, "@[0.01, 0.01, 0.03]", "body.link.inertia", "[0.01, 0.01, 0.03]",
                          "at most the sum of the other two");
  expect_dynamics_refused(good, "@[1, 1, 1, 2, 0, 0]", "body.link.inertia", "[1, 1, 1, 2, 0, 0]", "must be >= 0");
  expect_dynamics_refused(good, "[0.03, @-0.02, 0.04]", "body.link.inertia[2]", "-0.02", "must be >= 0 kg m^2");
  expect_dynamics_refused(good, "@[0.03, 0.02]", "body.link.inertia", "[0.03, 0.02]", "[xx, yy, zz]");
  EXPECT_EQ(motion_of(edited(good, "[0.1, 0, 0.1]", kSwing)).bodies[1].inertia(1, 1), 0) << "a thin rod";
}

TEST(ReadDynamics, HasNoSteps) {
  expect_one_error(kSwing + "[[@step]]\nincrements = 1\n", "step", "", "a scene with [dynamics] has no steps");
}

std::string prescribing(const std::string& entries) {
  return edited("start_rates = { \"h.angle\" = 90 }", entries, kSwing);
}

TEST(ReadDynamics, PrescribedCourses) {
  const std::string sine = "{ sine = { amplitude = 10, frequency = 2, start = 0.5, offset = 20 } }";
  for (const std::string& entry : {"prescribe = { \"h.angle\" = " + sine + " }", "prescribe.h.angle = " + sine}) {
    const Scene scene = motion_of(prescribing(entry));
    ASSERT_EQ(scene.dynamics->prescribe.size(), 1u) << entry;
    const DynamicsDef::Drive& drive = scene.dynamics->prescribe[0];
    EXPECT_EQ(drive.quantity, QuantityRef(0, 0));
    EXPECT_EQ(drive.course.kind, ScaleDef::Kind::sine);
    EXPECT_NEAR(drive.course.amplitude, 10 * M_PI / 180, 1e-16);
    EXPECT_NEAR(drive.course.offset, 20 * M_PI / 180, 1e-16);
    EXPECT_EQ(drive.course.frequency, 2) << "Hz";
  }
  const auto course = [](const std::string& text) {
    return motion_of(prescribing("prescribe = { \"h.angle\" = " + text + " }")).dynamics->prescribe[0].course;
  };
  const ScaleDef step = course("{ step = { to = 90, start = 1, rise = 0.25 } }");
  EXPECT_EQ(step.kind, ScaleDef::Kind::step);
  EXPECT_EQ(step.from, 0);
  EXPECT_NEAR(step.to, M_PI / 2, 1e-15);
  EXPECT_EQ(step.rise, 0.25) << "s";
  EXPECT_NEAR(course("{ table = [[0, 0], [1, 180]] }").table[1].second, M_PI, 1e-15);
  EXPECT_NEAR(course("45").table[0].second, M_PI / 4, 1e-15);
  EXPECT_FALSE(motion_of(kSwing).dynamics->from_equilibrium);
  EXPECT_TRUE(motion_of(prescribing("start = \"equilibrium\"")).dynamics->from_equilibrium);
}

TEST(ReadDynamics, PrescribedErrors) {
  const auto wrong = [](const std::string& entry, const std::string& key, const std::string& found,
                        const std::string& rule) {
    SCOPED_TRACE(entry);
    expect_one_error(prescribing(entry), "dynamics." + key, found, rule);
  };
  wrong("prescribe = { @\"h.angel\" = 3 }", "prescribe.h.angel", "", "it holds all coordinates but \"h.angle\"");
  wrong("prescribe = { \"h.angle\" = @\"fast\" }", "prescribe.h.angle", "\"fast\"", "must be a table");
  wrong("prescribe = { @\"h.angle\" = {} }", "prescribe.h.angle", "", "give `table`, `sine` or `step`");
  wrong("prescribe = { \"h.angle\" = { step = { to = 90, rise = @0 } } }", "prescribe.h.angle.step.rise", "0",
        "must be > 0 s");
  wrong("prescribe = { \"h.angle\" = { table = @[[0, 1]] } }", "prescribe.h.angle.table", "[[0, 1]]", "at least two");
  wrong("start_rates = { \"h.angle\" = 3 }\nprescribe = { @\"h.angle\" = 3 }", "prescribe.h.angle", "",
        "is prescribed and has a rate");
  wrong("start = @\"rest\"", "start", "\"rest\"", "\"given\"");
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
