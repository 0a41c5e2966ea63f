// Bodies get the mass, centre and inertia of their meshes; meshes without an inside are refused by their key.
#include "genu/assemble/read_solids.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/assemble/prepare.h"
#include "genu/mesh/solid_inertia.h"
#include "genu/mesh_files/mesh_writer.h"
#include "genu/surface/tessellate.h"
#include "support/dirt.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

const Vec3 kRadii(0.03, 0.05, 0.02);

class ReadSolids : public testing::Test {
 protected:
  void write(const Mesh& mesh, double unit = 1e-3) { EXPECT_EQ(write_ply(mesh, folder_ / "link.ply", unit, ""), ""); }

  std::optional<Prepared> prepared(const std::string& solid, const std::string& cord = "0.1, 0, 0") {
    out_ = {};
    return prepare(folder_.write("scene.toml", R"(format = 1
units = { length = "m", angle = "deg" }
[body.ground]
fixed = true
[body.link]
solid = { file = "link.ply", )" + solid + R"( }
[joint.h]
type = "revolute"
parent = "ground"
child = "link"
origin = [)" + cord + R"(]
axis = [0, 0, 1]
[ligament.cord]
from = { body = "ground", point = [)" + cord + R"(] }
to = { body = "link", point = [)" + cord + R"(] }
law = "linear"
stiffness = 10
slack_length = 0.08
[dynamics]
duration = 1
output_interval = 0.5
)"),
                   out_);
  }

  std::string refused(const Mesh& mesh) {
    write(mesh);
    EXPECT_FALSE(prepared("units = \"mm\", density = 1100"));
    EXPECT_EQ(out_.items().size(), 1u) << test::messages(out_);
    if (out_.items().empty()) return {};
    const Diagnostic& d = out_.items().front();
    EXPECT_EQ(d.key, "body.link.solid.file");
    EXPECT_EQ(d.line, 6);
    EXPECT_EQ(d.column, 18);
    EXPECT_NE(d.found.find("link.ply"), std::string::npos);
    return d.rule;
  }

  test::TemporaryFolder folder_;
  Diagnostics out_;
};

const Mesh kMesh = geodesic_mesh(kRadii, 4e-3);

TEST_F(ReadSolids, GiveTheBodyItsInertiaInEitherUnitAndPlace) {
  const SolidInertia s = solid_inertia(kMesh);
  for (const auto& [unit, metres] : {std::pair{"mm", 1e-3}, std::pair{"m", 1.0}}) {
    write(kMesh, metres);
    const auto p = prepared(std::string("units = \"") + unit +
                            "\", density = 1100, origin = [0.2, 0, 0], x_axis = [0, 1, 0], z_axis = [1, 0, 0]");
    ASSERT_TRUE(p) << test::messages(out_);
    EXPECT_TRUE(out_.items().empty()) << test::messages(out_);
    ASSERT_EQ(p->model.inertias.size(), 1u);
    const Inertia& body = p->model.inertias[0];
    EXPECT_NEAR(body.mass, 1100 * s.volume, 1e-12);
    EXPECT_LT((body.centre_of_mass - Vec3(0.2, 0, 0)).norm(), 1e-12);
    // x of the file is y of the body, y is z, z is x.
    const Mat3 I = 1100 * s.about_centroid;
    EXPECT_NEAR(body.about_centre_of_mass(1, 1), I(0, 0), 1e-12 * I.norm());
    EXPECT_NEAR(body.about_centre_of_mass(2, 2), I(1, 1), 1e-12 * I.norm());
    EXPECT_NEAR(body.about_centre_of_mass(0, 0), I(2, 2), 1e-12 * I.norm());
    ASSERT_EQ(p->bodies.size(), 1u);
    EXPECT_EQ(p->bodies[0].name, "link");
    EXPECT_EQ(p->bodies[0].mass, body.mass);
  }
}

TEST_F(ReadSolids, FarFromTheOriginToo) {
  Mesh far = kMesh;
  for (Vec3& v : far.vertices) v += Vec3(100, -50, 20);
  write(far, 1);
  const auto p = prepared("units = \"m\", density = 1100", "100, -50, 20");
  ASSERT_TRUE(p) << test::messages(out_);
  const Vec3 own = p->model.inertias[0].centre_of_mass + p->model.bodies[1].centre;
  EXPECT_LT((own - Vec3(100, -50, 20)).norm(), 1e-9);
  EXPECT_LT((p->bodies[0].centre_of_mass - own).norm(), 1e-13);
}

TEST_F(ReadSolids, WhatHasNoInsideIsRefused) {
  Mesh open = kMesh;
  open.triangles.pop_back();
  EXPECT_NE(refused(open).find("is open: it ends along 1 line of free edges"), std::string::npos);
  EXPECT_NE(refused(test::dirtied(kMesh, test::Dirt::fin, {0.03, 0, 0}, 4e-3)).find("bounds no volume"),
            std::string::npos);
  Mesh flat;  // a box 1 um thick
  for (int k = 0; k < 8; ++k) flat.vertices.emplace_back(0.06 * (k & 1), 0.06 * ((k >> 1) & 1), 1e-6 * (k >> 2));
  flat.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  EXPECT_NE(refused(flat).find("closes no volume"), std::string::npos);
  Mesh large = kMesh;
  for (Vec3& v : large.vertices) v *= 1000;
  EXPECT_NE(refused(large).find("unit"), std::string::npos);
}

TEST_F(ReadSolids, WhatFacesInwardIsTurnedWithAWarning) {
  Mesh turned = kMesh;
  for (auto& t : turned.triangles) std::swap(t[1], t[2]);
  write(turned);
  const auto p = prepared("units = \"mm\", density = 1100");
  ASSERT_TRUE(p) << test::messages(out_);
  EXPECT_NEAR(p->model.inertias[0].mass, 1100 * solid_inertia(kMesh).volume, 1e-12);
  ASSERT_EQ(out_.items().size(), 1u);
  EXPECT_NE(out_.items()[0].rule.find("is inside out"), std::string::npos);
  // A cavity stays one, and with it a mesh that is inside out as a whole.
  Mesh hollow = turned;
  const int n = static_cast<int>(kMesh.vertices.size());
  for (const Vec3& v : kMesh.vertices) hollow.vertices.push_back(0.5 * v);
  for (const auto& t : kMesh.triangles) hollow.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  write(hollow);
  const auto q = prepared("units = \"mm\", density = 1100");
  ASSERT_TRUE(q) << test::messages(out_);
  EXPECT_NEAR(q->model.inertias[0].mass, 0.875 * 1100 * solid_inertia(kMesh).volume, 1e-12);
}

TEST_F(ReadSolids, AShellInsideAnotherIsACavityWhicheverSideItFaces) {
  Mesh nested = kMesh;
  const int n = static_cast<int>(kMesh.vertices.size());
  for (const Vec3& v : kMesh.vertices) nested.vertices.push_back(0.5 * v);
  for (const auto& t : kMesh.triangles) nested.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  write(nested);
  const auto p = prepared("units = \"mm\", density = 1100");
  ASSERT_TRUE(p) << test::messages(out_);
  const double volume = solid_inertia(kMesh).volume;
  EXPECT_NEAR(p->model.inertias[0].mass, 0.875 * 1100 * volume, 1e-12);
  ASSERT_EQ(out_.items().size(), 1u);
  const std::string& rule = out_.items()[0].rule;
  EXPECT_NE(rule.find("has 1 closed piece inside another one"), std::string::npos) << rule;
  EXPECT_NE(rule.find(fmt::format("the volume is {:.4g} cm3", 0.875e6 * volume)), std::string::npos) << rule;
  EXPECT_NE(rule.find(fmt::format("if there is no cavity ({:.4g} cm3)", 1e6 * volume)), std::string::npos) << rule;
}

TEST_F(ReadSolids, WhatRunsThroughItselfIsTold) {
  Mesh two = kMesh;
  const int n = static_cast<int>(kMesh.vertices.size());
  for (const Vec3& v : kMesh.vertices) two.vertices.push_back(v + Vec3(0.02, 0.001, 0.003));
  for (const auto& t : kMesh.triangles) two.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  write(two);
  const auto p = prepared("units = \"mm\", density = 1100");
  ASSERT_TRUE(p) << test::messages(out_);
  ASSERT_EQ(out_.items().size(), 1u);
  EXPECT_NE(out_.items()[0].rule.find("runs through itself"), std::string::npos) << out_.items()[0].rule;
  EXPECT_NEAR(p->model.inertias[0].mass, 2200 * solid_inertia(kMesh).volume, 1e-12);
}

}  // namespace
}  // namespace genu
