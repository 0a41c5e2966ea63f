// What noise leaves of a contact's place: a noisy ball on a plane against the closed form and against other noise.
#include "genu/appraise/contact_location.h"

#include <cstdio>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/mesh_care/noise_field.h"
#include "genu/mesh_files/stl_writer.h"
#include "genu/study/run_scene.h"
#include "support/blend_meshes.h"
#include "support/judged.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

constexpr double kCap = 40;  // 1/m: curvature of the bowl at its bottom, along x; a quarter of it along y
const MeshNoise kNoise{20e-6, 1.5e-3};

/// A bowl that springs press onto a plane, its orientation held: it rests on its lowest point.
std::string scene(const std::string& mesh) {
  std::string text = fmt::format(R"(format = 1
units = {{ length = "mm", angle = "deg" }}
[body.base]
fixed = true
[body.bowl]
[joint.j]
type = "free"
parent = "base"
child = "bowl"
rotations = ["a x", "b y", "c z"]
translations = ["x", "y", "z"]
[surface.bowl]
body = "bowl"
shape = "mesh"
file = "{}"
units = "m"
[surface.ground]
body = "base"
shape = "plane"
[contact.c]
surfaces = ["ground", "bowl"]
model = "rigid"
)",
                                 mesh);
  for (int k = 0; k < 4; ++k) {
    const int x = k < 2 ? -30 : 30, y = k % 2 == 0 ? -30 : 30;
    text += fmt::format(R"([ligament.spring_{}]
from = {{ body = "bowl", point = [{}, {}, 2] }}
to = {{ body = "base", point = [{}, {}, -40] }}
law = "spring"
stiffness = 1
slack_length = 20
)",
                        k, x, y, x, y);
  }
  return text + "[[step]]\nprescribe = { \"j.a\" = 0, \"j.b\" = 0, \"j.c\" = 0, \"j.x\" = 0 }\nincrements = 1\n";
}

Mesh bowl() {
  return test::jittered_patch(
      20e-3, 1e-3, [](double x, double y) { return kCap / 2 * (x * x + y * y / 4); }, true);
}

Solution run(const Mesh& mesh) {
  const test::TemporaryFolder folder;
  std::string error = write_stl(mesh, folder / "bowl.stl", 1, "bowl");
  EXPECT_EQ(error, "");
  Diagnostics diagnostics;
  const auto prepared = prepare(folder.write("scene.toml", scene("bowl.stl")), diagnostics);
  for (const Diagnostic& d : diagnostics.items()) ADD_FAILURE() << to_string(d);
  if (!prepared) return {};
  ContactField field(prepared->model);
  return test::judged(*prepared, solve(*prepared, field, {}));
}

TEST(ContactLocation, OfExactSurfacesIsNotQualified) {
  const Solution exact = run(bowl());
  ASSERT_EQ(exact.summary.exit_code, kExitOk);
  for (const ContactLocation& c : exact.summary.locations) {
    EXPECT_EQ(c.doubtful, 0) << c.ratio();  // single precision is all the noise there is
    EXPECT_LT(c.spread, 1e-5);
  }
  EXPECT_EQ(exact.summary.verdict.size(), 1u);
}

TEST(ContactLocation, SpreadIsThatOfOtherNoise) {
  constexpr int kSeeds = 24;
  double square = 0, said = 0, mean = 0;
  std::vector<double> places;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Solution s = run(perturbed(bowl(), kNoise, seed));
    ASSERT_EQ(s.summary.exit_code, kExitOk) << seed;
    ASSERT_EQ(s.summary.locations.size(), 1u);
    const ContactLocation& c = s.summary.locations[0];
    EXPECT_EQ(c.poses, 2);
    EXPECT_EQ(c.doubtful, 2) << c.ratio();
    said += c.spread / kSeeds;
    const double y = s.records.back().point.pose.state.contacts.at(0).geometry.b.p.y();
    places.push_back(y);
    mean += y / kSeeds;
    if (seed > 1) continue;
    ASSERT_GE(s.summary.verdict.size(), 2u);
    EXPECT_NE(s.summary.verdict[1].find("The contact point of c is uncertain by ±"), std::string::npos)
        << s.summary.verdict[1];
    std::printf("%s\n", s.summary.verdict[1].c_str());
  }
  for (double y : places) square += std::pow(y - mean, 2) / (kSeeds - 1);
  std::printf("place along the flat direction: scatter %.3f mm over %d meshes, said %.3f mm\n", 1e3 * std::sqrt(square),
              kSeeds, 1e3 * said);
  EXPECT_LT(std::sqrt(square), 2 * said);
  EXPECT_GT(std::sqrt(square), said / 2);
}

}  // namespace
}  // namespace genu
