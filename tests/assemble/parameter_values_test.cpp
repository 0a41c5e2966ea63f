// Every parameter's number is found in the scene as data and in its text, and is the same there.
#include "genu/assemble/parameter_values.h"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/assemble/scene_values.h"
#include "genu/scene/reader.h"
#include "support/leskovar.h"
#include "support/number_text.h"
#include "support/scenes.h"

namespace genu {
namespace {

using test::number_count;
using test::number_text;

const KindOf<JointDef>& kRevolute = kJointKinds[static_cast<int>(JointDef::Type::revolute)];

ChosenUnits units_of(bool metres) {
  return {metres ? units::kMetre : units::kMillimetre, units::kDegree, metres ? "m" : "mm", "deg"};
}

/// A surface of each shape that has a formula.
std::string surfaces(const ChosenUnits& chosen) {
  std::string out;
  for (const KindOf<SurfaceDef>& kind : kSurfaceKinds) {
    const bool polynomial = kind.word == std::string("polynomial");
    if (kind.word == std::string("mesh") || (polynomial && out.find("polynomial") != std::string::npos)) continue;
    out += fmt::format("[surface.{0}]\nbody = \"link\"\nshape = \"{0}\"\n", kind.word) + number_text(kind, chosen);
    if (polynomial) out += fmt::format("terms = [[2, 0, {}], [0, 0, {}]]\n", 10 * chosen.length, 4e-3 / chosen.length);
  }
  return out;
}

/// Every kind of load, law, rest and surface, with all numbers that their tables have, in mm and in m.
std::string scene_in_units(bool metres) {
  const ChosenUnits chosen = units_of(metres);
  const auto l = [&](double mm) { return std::to_string(metres ? mm / 1000 : mm); };
  return std::string("format = 1\nunits = { length = \"") + chosen.length_name + R"(", angle = "deg" }
gravity = [0, -9.81, 0]
[body.ground]
fixed = true
[body.link]
inertia = [0.03, 0.03, 0.04]
)" + number_text(kBodyKinds[0], chosen) +
         R"([joint.h]
type = "revolute"
parent = "ground"
child = "link"
axis = [0, 0, 1]
)" + number_text(kRevolute, chosen) +
         "[joint.h.limits]\n" + number_text(kRevolute, chosen, "limits") + surfaces(chosen) + R"([ligament.a]
from = { body = "ground", point = [)" +
         l(50) + ", 0, " + l(3) + R"(] }
to = { body = "link", point = [0, )" +
         l(-50) + R"(, 0] }
via = [{ body = "ground", point = [)" +
         l(40) + ", " + l(-20) + R"(, 0] }]
law = "blankevoort"
stiffness = 100
transition_strain = 0.06
reference_strain = -0.01
[ligament.b]
from = { body = "ground", point = [)" +
         l(-50) + R"(, 0, 0] }
to = { body = "link", point = [0, )" +
         l(-60) + R"(, 0] }
law = "spring"
stiffness = 10
slack_length = )" +
         l(70) + R"(
damping = 3
[load.push]
body = "link"
)" + number_text(kLoadKinds[0], chosen) +
         "[load.pull]\nbody = \"link\"\n" + number_text(kLoadKinds[1], chosen) +
         "[load.pull.toward]\nbody = \"ground\"\n" + number_text(kLoadKinds[1], chosen, "toward") +
         "[load.turn]\non = \"h.angle\"\n" + number_text(kLoadKinds[2], chosen) + R"([dynamics]
duration = 2
output_interval = 0.5
)";
}

/// The numbers of the tables in that scene.
int numbers_of_tables() {
  int count = number_count(kBodyKinds[0]) + number_count(kRevolute);
  for (int k = 0; k < 3; ++k) count += number_count(kLoadKinds[k]);
  for (const KindOf<SurfaceDef>& kind : kSurfaceKinds) count += number_count(kind);
  return count - 2 * number_count(kSurfaceKinds[static_cast<int>(SurfaceDef::Shape::mesh)]);  // polynomials: one of two
}

TEST(ParameterValues, TextAndDataSayTheSame) {
  const test::TemporaryFolder folder;
  for (const bool metres : {false, true}) {
    const std::string file = folder.write("scene.toml", scene_in_units(metres));
    Diagnostics out;
    auto scene = read_scene(file, out);
    ASSERT_TRUE(scene) << test::messages(out);
    const auto document = parse_toml(scene_in_units(metres), file, out);
    int found = 0;
    for (const Parameter& p : parameters_of(*scene)) {
      const double* number = parameter_number(*scene, p);
      if (number == nullptr) continue;
      const ParameterPlace place = parameter_place(*scene, p, *document);
      ASSERT_TRUE(place.node) << p.name << " at " << place.key;
      EXPECT_NEAR(place.node->number * place.file_unit, *number, 1e-12 * std::abs(*number)) << p.name;
      EXPECT_EQ(p.positive, p.change_text == "1 %") << p.name;
      ++found;
    }
    // Ligaments a: 3 + 9, b: 3 + 6; two terms
    EXPECT_EQ(found, numbers_of_tables() + 12 + 9 + 2);
  }
}

TEST(ParameterValues, NewNumbersAreReadBack) {
  const test::TemporaryFolder folder;
  for (const bool metres : {false, true}) {
    const std::string file = folder.write("scene.toml", scene_in_units(metres));
    Diagnostics out;
    auto scene = read_scene(file, out);
    ASSERT_TRUE(scene);
    std::vector<std::pair<Parameter, double>> values;
    for (const Parameter& p : parameters_of(*scene))
      if (const double* number = parameter_number(*scene, p)) values.emplace_back(p, *number + 0.7 * p.change);
    const std::string text = with_values(file, *scene, values, folder / "out", out);
    auto changed = parse_scene(text, file, out);
    ASSERT_TRUE(changed) << test::messages(out) << text;
    for (const auto& [p, value] : values)
      EXPECT_NEAR(*parameter_number(*changed, p), value, 1e-14 * std::abs(value)) << p.name;
    EXPECT_EQ(changed->title, scene->title);
  }
}

}  // namespace
}  // namespace genu
