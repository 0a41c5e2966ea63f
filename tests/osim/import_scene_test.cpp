#include "genu/osim/import_scene.h"

#include <sstream>

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "osim/osim_support.h"

namespace genu::test {
namespace {

struct Imported {
  explicit Imported(const std::string& text = leg_text(), const std::vector<std::string>& joints = {"knee_r"},
                    const osim::CoordinateValues& values = {}, osim::SceneRequest request = {})
      : model(model_of(text)) {
    Diagnostics out;
    const auto skeleton = osim::Skeleton::build(model, joints, values, out);
    EXPECT_FALSE(out.has_errors()) << to_string(out.items().front());
    for (const char* file : {"condyle.obj", "condyle-bone.obj", "plateau.obj"})
      request.meshes[file] = std::string("model/Geometry/") + file;
    imported = osim::import_scene(model, *skeleton, request);
    auto read = parse_scene(imported.text, source_folder() + "/tests/osim/scene.toml", out);
    EXPECT_FALSE(out.has_errors()) << to_string(out.items().front()) << "\n" << imported.text;
    if (read) scene = *read;
  }
  const LigamentDef& ligament(const std::string& name) const { return named(scene.ligaments, name); }
  const LoadDef& load(const std::string& name) const { return named(scene.loads, name); }
  const SurfaceDef& surface(const std::string& name) const { return named(scene.surfaces, name); }
  /// The row of import.csv of an element.
  std::string row(const std::string& type, const std::string& name) const {
    std::istringstream in(imported.table);
    for (std::string line; std::getline(in, line);)
      if (contains(line, "," + type + "," + name + ",")) return line;
    return {};
  }

  osim::Model model;
  osim::ImportedScene imported;
  Scene scene;

 private:
  template <typename T>
  static const T& named(const std::vector<T>& all, const std::string& name) {
    for (const T& one : all)
      if (one.name == name) return one;
    ADD_FAILURE() << "no " << name;
    static const T none;
    return none;
  }
};

TEST(ImportScene, HasBodiesAndJointOfTheModel) {
  const Imported leg;
  ASSERT_EQ(leg.scene.bodies.size(), 2u);
  EXPECT_TRUE(leg.scene.bodies[0].fixed);
  EXPECT_EQ(leg.scene.bodies[1].name, "tibia_r");
  EXPECT_DOUBLE_EQ(leg.scene.bodies[1].mass, 4);
  ASSERT_EQ(leg.scene.joints.size(), 1u);
  const JointDef& knee = leg.scene.joints[0];
  EXPECT_EQ(knee.rotations[0].name, "flex");
  EXPECT_EQ(knee.rotations[1].name, "add");
  EXPECT_EQ(knee.translations[0], "tx");
  EXPECT_LT((*leg.scene.gravity - Vec3(0, -9.81, 0)).norm(), 1e-12);
  ASSERT_EQ(leg.scene.steps.size(), 1u);
  EXPECT_EQ(leg.scene.steps[0].prescribe.size(), 2u);  // the first rotation, and what is locked
}

TEST(ImportScene, GravityTurnsWithTheFixedBody) {
  const Imported leg(leg_text(), {"knee_r"}, {{"hip_flex_r", std::numbers::pi / 2}});
  EXPECT_LT((*leg.scene.gravity - Vec3(-9.81, 0, 0)).norm(), 1e-9);
}

TEST(ImportScene, LigamentsHaveTheirLawsAndUnits) {
  const Imported leg;
  EXPECT_EQ(leg.ligament("LCL1").law, "blankevoort");
  EXPECT_EQ(leg.ligament("LCL1").number("stiffness"), 2000);
  EXPECT_EQ(leg.ligament("LCL1").number("transition_strain"), 0.05);
  EXPECT_NEAR(leg.ligament("LCL1").rest_value, 0.069, 1e-15);
  EXPECT_EQ(leg.ligament("capsule").law, "linear");
  EXPECT_NEAR(leg.ligament("capsule").number("stiffness"), 1000 * 0.05, 1e-12);  // k L0 per strain
  EXPECT_EQ(leg.ligament("spring").law, "spring");
  EXPECT_NEAR(leg.ligament("spring").number("stiffness"), 500, 1e-9);  // N/m
  EXPECT_EQ(leg.scene.ligaments.size(), 4u);
  EXPECT_TRUE(contains(leg.row("Blankevoort1991Ligament", "ACL_cut"), "left out,,its appliesForce is false"));
  EXPECT_TRUE(contains(leg.row("Blankevoort1991Ligament", "MCL1"), "damping 0.003 acts in motion only"));
}

TEST(ImportScene, WrapObjectsAreSurfacesWithTheirSide) {
  const Imported leg;
  ASSERT_EQ(leg.ligament("MCL1").wraps.size(), 1u);
  EXPECT_TRUE(leg.ligament("MCL1").wraps[0].ignore_inside);
  EXPECT_FALSE(leg.ligament("MCL1").wraps[0].side.has_value());
  const SurfaceDef& edge = leg.surface("medial_edge");
  EXPECT_LT((edge.radii - Vec3(0.02, 0.015, 0.01)).norm(), 1e-15);
  EXPECT_LT((edge.placement.R - exp_rotation(0.2 * Vec3::UnitZ())).cwiseAbs().maxCoeff(), 1e-11);
  const LoadDef& calf = leg.load("gastrocnemius");
  ASSERT_EQ(calf.wraps.size(), 1u);
  EXPECT_LT((*calf.wraps[0].side - Vec3(-1, 0, 0)).norm(), 1e-12);  // quadrant -x
  EXPECT_EQ(leg.surface("condyles").radius, 0.02);
  EXPECT_TRUE(contains(leg.row("WrapTorus", "ring"), "left out,,no path that is imported wraps round it"));
}

TEST(ImportScene, MusclesAreCablesWithTheTensionGiven) {
  EXPECT_EQ(Imported().load("hamstring").value, 0);
  osim::SceneRequest request;
  request.tensions["hamstring"] = 123.5;
  const Imported leg(leg_text(), {"knee_r"}, {}, request);
  EXPECT_EQ(leg.load("hamstring").value, 123.5);
  EXPECT_EQ(leg.load("gastrocnemius").value, 0);
  EXPECT_TRUE(contains(leg.row("Thelen2003Muscle", "psoas"), "left out,,pulls on one rigid body alone"));
}

TEST(ImportScene, ContactHasBothLayers) {
  const Imported leg;
  ASSERT_EQ(leg.scene.layers.size(), 1u);
  const LayerDef& layer = leg.scene.layers[0];
  EXPECT_NEAR(layer.modulus, 10e6, 1);  // lumped: the mean of 8 and 12 MPa
  EXPECT_EQ(layer.poisson, 0.45);
  EXPECT_EQ(layer.rim, LayerDef::Rim::cut);
  EXPECT_EQ(layer.search_depth, 0.008);
  EXPECT_EQ(leg.scene.surfaces[at(layer.cast_from)].name, "plateau");
  EXPECT_TRUE(leg.surface("condyle").thickness->measured);
  EXPECT_EQ(leg.surface("plateau").thickness->constant, 0.002);
  EXPECT_LT((leg.surface("plateau").placement.p - Vec3(0, -0.029, 0)).norm(), 1e-15);  // its frame, then its location
}

/// Springs in series: at a pressure p both layers together give way by p (h1 / M1 + h2 / M2).
TEST(ImportScene, LayersOneOverTheOtherAreSpringsInSeries) {
  std::string text = leg_with("<use_lumped_contact_model>true", "<use_lumped_contact_model>false");
  text.replace(text.find("<use_variable_thickness>true"), 28, "<use_variable_thickness>false");
  const Imported leg(text);  // the condyle's thickness is OpenSim's own default, 5 mm
  const double h1 = 0.005, h2 = 0.002, factor = 0.55 / (1.45 * 0.1);
  const double soft = h1 / (8e6 * factor) + h2 / (12e6 * factor);
  EXPECT_NEAR(leg.scene.layers[0].modulus * factor, (h1 + h2) / soft, 1);
}

TEST(ImportScene, SpringsOfCoordinatesAreFeedback) {
  const Imported leg;
  const LoadDef& spring = leg.load("varus_spring");
  ASSERT_TRUE(spring.scale.has_value());
  EXPECT_TRUE(contains(leg.imported.text, "gain = 0.349065850399"));   // 20 N m/rad per deg
  EXPECT_TRUE(contains(leg.imported.text, "target = 5.72957795131"));  // 0.1 rad
  EXPECT_TRUE(contains(leg.row("SpringGeneralizedForce", "knee_damper"), "left out,,has no stiffness"));
}

TEST(ImportScene, EveryElementHasOneRow) {
  const Imported leg;
  std::istringstream in(leg.imported.table);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "line,set,type,name,fate,in_scene,reason");
  std::size_t rows = 0, named = 0;
  for (; std::getline(in, line); ++rows) {
    named += contains(line, ",kept,") + contains(line, ",frozen,") + contains(line, ",left out,");
    EXPECT_EQ(std::atoi(line.c_str()), leg.model.items[rows].where.line);
  }
  EXPECT_EQ(rows, leg.model.items.size());
  EXPECT_EQ(named, rows);
  EXPECT_EQ(leg.imported.kept + leg.imported.frozen + leg.imported.left_out, rows);
  EXPECT_TRUE(contains(leg.row("HuntCrossleyForce", "heel"), "WARNING: contact that genu does not import"));
  EXPECT_TRUE(contains(leg.row("PrescribedController", "brain"), "left out,,would excite muscles"));
  EXPECT_TRUE(contains(leg.row("SomethingNew", "novelty"), "WARNING: genu does not know this kind"));
  EXPECT_TRUE(
      contains(leg.row("PinJoint", "ankle_r"), "frozen,,held at the pose of the import: ankle_angle_r = 0.2 rad"))
      << leg.imported.table;
  EXPECT_TRUE(contains(leg.row("PhysicalOffsetFrame", "plateau_frame"), "frozen,body.tibia_r"));
}

TEST(ImportScene, SummaryCountsByKindAndReason) {
  const Imported leg;
  std::string text;
  for (const std::string& line : leg.imported.summary) text += line + "\n";
  EXPECT_TRUE(contains(text, "kept        2 Blankevoort1991Ligament (LCL1, MCL1)")) << text;
  EXPECT_TRUE(contains(text, "left out    1 Marker (R.KNEE): marks a point"));
  EXPECT_TRUE(contains(text, "left out    1 SomethingNew (novelty): WARNING"));
}

TEST(ImportScene, RevoluteJointsKeepTheirAxis) {
  const Imported leg(leg_text(), {"knee_r", "ankle_r"});
  ASSERT_EQ(leg.scene.joints.size(), 2u);
  EXPECT_EQ(leg.scene.bodies.size(), 3u);
  EXPECT_EQ(leg.imported.columns, "ankle_r.angle=ankle_angle_r");
  EXPECT_TRUE(contains(leg.imported.text, "reference = { angle = 11.4591559026 }"));
}

TEST(ImportScene, NamesThatAreNoKeysAreMade) {
  std::string text =
      leg_with("Blankevoort1991Ligament name=\"LCL1\"", "Blankevoort1991Ligament name=\"LCL 1\n[load.x]\"");
  const Imported leg(text);
  EXPECT_EQ(leg.scene.ligaments[0].name, "LCL_1__load_x_");
  text = leg_text();
  for (std::size_t at = 0; (at = text.find("knee_rot_r", at)) != std::string::npos;)
    text.replace(at, 10, "knee_;} x&#10;[y]_r");
  EXPECT_EQ(Imported(text).scene.joints[0].rotations[2].name, "___x__y_");
}

/// Changes of the model in which two elements of one kind of table have one name.
TEST(ImportScene, NamesThatCollideAreToldApart) {
  const auto with = [](std::initializer_list<std::pair<const char*, const char*>> changes) {
    std::string text = leg_text();
    for (const auto& [from, to] : changes)
      for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += std::string(to).size())
        text.replace(at, std::string(from).size(), to);
    return text;
  };
  const Imported mesh(with({{"\"medial edge\"", "\"plateau\""}, {">medial edge<", ">plateau<"}}));
  EXPECT_EQ(mesh.surface("plateau").shape, SurfaceDef::Shape::mesh);
  EXPECT_EQ(mesh.surface("plateau_2").shape, SurfaceDef::Shape::ellipsoid);
  EXPECT_EQ(mesh.scene.surfaces[at(mesh.ligament("MCL1").wraps.at(0).surface)].name, "plateau_2");
  const Imported force(with({{"PathSpring name=\"capsule\"", "PathSpring name=\"LCL1\""}}));
  EXPECT_EQ(force.ligament("LCL1").law, "blankevoort");
  EXPECT_EQ(force.ligament("LCL1_2").law, "linear");
  const Imported load(with({{"Force name=\"varus_spring\"", "Force name=\"hamstring\""}}));
  EXPECT_TRUE(load.load("hamstring_2").scale.has_value());
  const Imported nameless(with({{"<PathSpring name=\"capsule\">", "<PathSpring>"},
                                {"<PointToPointSpring name=\"spring\">", "<PointToPointSpring>"}}));
  EXPECT_EQ(nameless.ligament("_").law, "linear");
  EXPECT_EQ(nameless.ligament("__2").law, "spring");
  const Imported coordinate(with({{"knee_rot_r", "flex"}}));
  EXPECT_EQ(coordinate.scene.joints[0].rotations[0].name, "knee_flex_r");
  EXPECT_EQ(coordinate.scene.joints[0].rotations[2].name, "flex");
  EXPECT_EQ(coordinate.imported.columns, "knee_r.knee_flex_r=knee_flex_r, knee_r.flex=flex");
}

TEST(ImportScene, SomethingIsAlwaysFree) {
  const Imported ankle(leg_text(), {"ankle_r"});
  EXPECT_TRUE(ankle.scene.steps.at(0).prescribe.empty());
  const Imported idle(leg_with("</coordinates>",
                               "<Coordinate name=\"idle\"><locked>true</locked></Coordinate></coordinates>",
                               "CustomJoint name=\"knee_r\""));
  EXPECT_EQ(idle.scene.steps.at(0).prescribe.size(), 2u);
  EXPECT_TRUE(contains(idle.row("Coordinate", "idle"), "left out,,moves nothing"));
  std::string text = leg_text();
  for (std::size_t at = text.find("name=\"knee_flex_r\""), end = text.find("<frames>", at); at < end; ++at)
    if (text.compare(at, 16, "</default_value>") == 0) {
      text.insert(at + 16, "<locked>true</locked>");
      end += 21;
    }
  text.erase(text.find("<locked>true</locked><locked>"), 21);
  const Imported locked(text);
  EXPECT_EQ(locked.scene.steps.at(0).prescribe.size(), 5u);
  EXPECT_TRUE(contains(locked.row("Coordinate", "knee_tz_r"), "kept,knee_r.tz,\"WARNING: fixed in the model, free"));
  EXPECT_TRUE(contains(locked.row("Coordinate", "knee_ty_r"), "locked in the model: prescribed in the step"));
}

TEST(ImportScene, PrescribedCoordinatesKeepTheirValue) {
  const std::string value = "<default_value>0</default_value>";
  const Imported leg(leg_with(value,
                              value + "<prescribed>true</prescribed><prescribed_function><Constant><value>0.7</value>"
                                      "</Constant></prescribed_function>",
                              "Coordinate name=\"knee_rot_r\""));
  EXPECT_EQ(leg.scene.steps.at(0).prescribe.size(), 3u);
  EXPECT_TRUE(contains(leg.imported.text, "\"knee_r.rot\" = 40.1070456592"));
  EXPECT_TRUE(contains(leg.row("Coordinate", "knee_rot_r"), "prescribed by a function of time in the model"));
}

TEST(ImportScene, SaysWhatCouplersWouldDo) {
  const auto row = [](const std::string& text) {
    return Imported(text).row("CoordinateCouplerConstraint", "ankle_follows_hip");
  };
  const std::string independent = "<independent_coordinate_names>", dependent = "<dependent_coordinate_name>";
  EXPECT_TRUE(contains(row(leg_text()), "frozen,,both coordinates are held"));
  const std::string moving = leg_with(independent + "hip_flex_r", independent + "knee_flex_r");
  EXPECT_TRUE(contains(row(moving), "frozen,,WARNING: in the"));
  EXPECT_TRUE(
      contains(row(leg_with(dependent + "ankle_angle_r", dependent + "knee_rot_r")), "left out,,WARNING: would"));
  EXPECT_TRUE(contains(row(leg_with("<isEnforced>true", "<isEnforced>false")), "left out,,is not enforced"));
  const std::string chain = leg_with("</objects>\n    </ConstraintSet>",
                                     leg_coupler("knee_flex_r", "hip_flex_r") + "</objects></ConstraintSet>");
  EXPECT_TRUE(contains(row(chain), "WARNING: in the model its dependent coordinate follows one that moves"));
}

TEST(ImportScene, WhatWouldActIsAWarning) {
  osim::SceneRequest request;
  request.tensions["hamstring"] = -30;
  const Imported leg(leg_with("<HuntCrossleyForce name=\"heel\"", "<CoordinateLimitForce name=\"stop\""), {"knee_r"},
                     {}, request);
  EXPECT_TRUE(contains(leg.row("CoordinateLimitForce", "stop"), "left out,,WARNING: would push a coordinate back"));
  EXPECT_EQ(leg.load("hamstring").value, 0);
  EXPECT_TRUE(contains(leg.row("Thelen2003Muscle", "hamstring"), "WARNING: it would push with 30 N"));
  EXPECT_TRUE(contains(leg.imported.summary.back(), "kept          Thelen2003Muscle hamstring: "));
}

}  // namespace
}  // namespace genu::test
