// Several threads solve at once on the same surfaces, rigid and with a layer: each finds what one alone finds.
#include <thread>

#include <gtest/gtest.h>

#include "genu/mesh_files/stl_writer.h"
#include "genu/study/run_scene.h"
#include "genu/surface/analytic.h"
#include "support/judged.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

/// A meshed egg in a meshed bowl, rolled by 4 deg under 10 N.
std::string egg_in_bowl(const test::TemporaryFolder& folder, const std::string& contact) {
  const auto mesh = [&](const std::string& name, double radius) {
    const Mesh egg = make_ellipsoid({}, {radius, 1.1 * radius, 0.95 * radius}, false)->triangles(1.5e-3, {}, 0.1);
    EXPECT_EQ(write_stl(egg, folder / (name + ".stl"), 1e-3, name), "");
    return "[surface." + name + "]\nshape = \"mesh\"\nfile = \"" + name + ".stl\"\nunits = \"mm\"\n";
  };
  return folder.write("scene.toml",
                      "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n[body.ground]\nfixed = true\n"
                      "[body.bone]\n[joint.j]\ntype = \"free\"\nparent = \"ground\"\nchild = \"bone\"\n"
                      "rotations = [\"a x\", \"b y\", \"c z\"]\ntranslations = [\"x\", \"y\", \"z\"]\n"
                      "reference = { z = -9.5 }\n" +
                          mesh("egg", 0.01) + "body = \"bone\"\n" + mesh("bowl", 0.02) +
                          "body = \"ground\"\ninside = true\n[contact.foot]\nsurfaces = [\"egg\", \"bowl\"]\n" +
                          contact +
                          "[load.weight]\nbody = \"bone\"\nforce = [0, 0, -10]\n"
                          "[[step]]\nprescribe = { \"j.a\" = [0, 4], \"j.b\" = 0, \"j.c\" = 0 }\nincrements = 4\n");
}

void solve_at_once(const std::string& contact) {
  constexpr std::size_t kThreads = 4;
  const test::TemporaryFolder folder;
  Diagnostics out;
  const auto prepared = prepare(egg_in_bowl(folder, contact), out);
  ASSERT_TRUE(prepared) << test::messages(out);
  std::vector<std::string> tables(kThreads);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < kThreads; ++i)
    threads.emplace_back([&, i] {
      Prepared own = *prepared;  // the surfaces stay shared
      own.model.meter = std::make_shared<EffectMeter>();
      ContactField field(own.model);
      tables[i] = solve(own, field, {}).poses.to_csv();
    });
  for (std::thread& t : threads) t.join();
  ContactField field(prepared->model);
  const Solution alone = test::judged(*prepared, solve(*prepared, field, {}));
  EXPECT_EQ(alone.summary.poses_solved, 5);
  for (const std::string& table : tables) EXPECT_TRUE(table == alone.poses.to_csv());
}

TEST(SharedSurfaces, RigidContact) { solve_at_once("model = \"rigid\"\n"); }

TEST(SharedSurfaces, Layer) {
  solve_at_once(
      "model = \"cartilage\"\nmodulus = 5\npoisson = 0.4\nthickness = 4\nquadrature = \"triangles\"\ncast_from = "
      "\"egg\"\n");
}

}  // namespace
}  // namespace genu
