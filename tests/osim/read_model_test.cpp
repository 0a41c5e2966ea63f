#include "genu/osim/read_model.h"

#include <gtest/gtest.h>

#include "genu/osim/tolerances.h"
#include "osim/osim_support.h"

namespace genu::test {
namespace {

TEST(ReadModel, HasWhatTheFileSays) {
  const osim::Model m = leg();
  EXPECT_EQ(m.name, "leg");
  EXPECT_EQ(m.gravity, Vec3(0, -9.81, 0));
  ASSERT_EQ(m.bodies.size(), 4u);
  EXPECT_EQ(m.bodies[2].name, "tibia_r");
  EXPECT_EQ(m.bodies[2].mass, 3);
  EXPECT_EQ(m.bodies[1].centre, Vec3(0, -0.2, 0));
  EXPECT_EQ(m.bodies[1].inertia(1, 1), 0.02);
  ASSERT_EQ(m.joints.size(), 4u);
  const osim::Joint& knee = m.joints[2];
  EXPECT_EQ(knee.type, "CustomJoint");
  EXPECT_EQ(knee.coordinates[0].default_value, 0.1);
  EXPECT_TRUE(knee.coordinates[1].locked);
  EXPECT_EQ(knee.rotations[0].function.coefficients[0], -1);
  EXPECT_EQ(knee.translations[2].coordinate, "knee_tz_r");
  EXPECT_EQ(knee.where.line, line_of(leg_text(), "<CustomJoint name=\"knee_r\""));
  EXPECT_EQ(m.joints[1].translations[0].function.scale, 2);
  EXPECT_EQ(m.couplers.size(), 1u);
  EXPECT_EQ(m.wraps.size(), 3u);
  EXPECT_EQ(m.ligaments.size(), 5u);
  EXPECT_EQ(m.muscles.size(), 3u);
  EXPECT_EQ(m.contact_meshes.size(), 2u);
  EXPECT_EQ(m.contact_forces.size(), 1u);
  EXPECT_EQ(m.springs.size(), 2u);
}

TEST(ReadModel, TakesWhatIsMissingFromTheDefaults) {
  const osim::Model m = leg();
  EXPECT_EQ(m.ligaments[0].transition_strain, 0.05);  // of <defaults>
  EXPECT_EQ(m.ligaments[1].transition_strain, 0.06);  // its own
  EXPECT_EQ(model_of(leg_with("<transition_strain>0.05</transition_strain>", "")).ligaments[0].transition_strain, 0.06);
}

TEST(ReadModel, PrescribedCoordinatesHaveTheValueOfTheirFunction) {
  const std::string course =
      "<prescribed>true</prescribed><prescribed_function><LinearFunction><coefficients>1 0.7</coefficients>"
      "</LinearFunction></prescribed_function>";
  const auto hip = [](const std::string& more) {
    const std::string value = "<default_value>0</default_value>";
    return model_of(leg_with(value, value + more, "Coordinate name=\"hip_flex_r\"")).joints[1].coordinates[0];
  };
  EXPECT_TRUE(hip(course).prescribed);
  EXPECT_EQ(hip(course).default_value, 0.7);
  EXPECT_EQ(hip(course + "<locked>true</locked>").default_value, 0);
  EXPECT_FALSE(hip("<prescribed>true</prescribed><prescribed_function/>").prescribed);
  EXPECT_FALSE(hip("<prescribed>false" + course.substr(16)).prescribed);
}

TEST(ReadModel, ListsEveryElementOnceInOrder) {
  const osim::Model m = leg();
  int markers = 0, coordinates = 0, wraps = 0;
  for (std::size_t k = 0; k < m.items.size(); ++k) {
    markers += m.items[k].type == "Marker";
    coordinates += m.items[k].type == "Coordinate";
    wraps += m.items[k].type.rfind("Wrap", 0) == 0;
    EXPECT_NE(m.items[k].type, "PathPoint");
    if (k > 0) {
      EXPECT_GT(std::pair(m.items[k].where.line, m.items[k].where.column),
                std::pair(m.items[k - 1].where.line, m.items[k - 1].where.column));
    }
  }
  EXPECT_EQ(markers, 1);
  EXPECT_EQ(coordinates, 14);
  EXPECT_EQ(wraps, 3);
}

/// A change that makes the model wrong, the place of its message and some of its words.
struct Broken {
  const char* from;
  const char* to;
  const char* after;
  const char* words;
};

TEST(ReadModel, RefusesWrongValuesWithTheirPlace) {
  const Broken broken[] = {
      {"Version=\"40000\"", "Version=\"30000\"", "", "opensim-cmd update-file"},
      {"Version=\"40000\"", "Version=\"50000\"", "", "newer than OpenSim 4"},
      {"Version=\"40000\"", "Version=\"four\"", "", "must be the version"},
      {"Version=\"40000\"", "", "", "must be the version"},
      {"<slack_length>0.069", "<slack_length>nan", "", "\"nan\" is no finite number"},
      {"<slack_length>0.069", "<slack_length>inf", "", "is no finite number"},
      {"<slack_length>0.069", "<slack_length>0,069", "", "\"0,069\" is no finite number"},
      {"<slack_length>0.069", "<slack_length>-1", "", "must be > 0"},
      {"<slack_length>0.069", "<slack_length>1 2", "", "must be one number"},
      {"<slack_length>0.069", "<slack_length>1e999", "", "is no finite number"},
      {"<slack_length>0.069</slack_length>", "", "", "slack_length: is missing"},
      {"<linear_stiffness>2000", "<linear_stiffness>0", "", "must be > 0"},
      {"<location>0 -0.4 0.035", "<location>0 -0.4", "", "must be three numbers"},
      {"<mass>3", "<mass>-3", "", "must be >= 0 kg"},
      {"<inertia>0.1 0.1", "<inertia>0.1", "", "must be six numbers"},
      {"<axis>0 0 1", "<axis>0 0 0", "", "must not be zero"},
      {"<coordinates>knee_flex_r", "<coordinates>knee_bend_r", "", "must be one coordinate of the joint knee_r"},
      {"name=\"rotation1\"", "name=\"spin\"", "", "must be rotation1 to rotation3"},
      {"<x>-2 0 1 2", "<x>-2 0 0 2", "", "growing numbers"},
      {"<x>-2 0 1 2", "<x>-2 0 1", "", "growing numbers"},
      {"SimmSpline", "GCVSpline", "<MultiplierFunction", ""},
      {"<PinJoint", "<ScrewJoint", "", ""},
      {"true</active>", "yes</active>", "", "must be true or false"},
      {"<quadrant>-x", "<quadrant>x+", "", "must be all, x, -x, y, -y, z or -z"},
      {"<dimensions>0.02 0.015", "<dimensions>0.02 0", "", "must be > 0"},
      {"<socket_parent_frame>/bodyset/femur_r", "<socket_parent_frame>", "LCL1-P1", "is missing"},
      {"<wrap_object>medial edge</wrap_object>", "", "", "wrap_object: is missing"},
      {"<range>-1 -1", "<range>-1", "", "must be two numbers"},
      {"<poissons_ratio>0.45", "<poissons_ratio>0.5", "", "infinitely stiff"},
      {"<elastic_foundation_formulation>linear", "<elastic_foundation_formulation>cubic", "", "linear or nonlinear"},
      {"<mesh_file>condyle.obj</mesh_file>", "", "", "mesh_file: is missing"},
      {"Body name=\"foot_r\"", "Body name=\"tibia_r\"", "", "another body"},
      {"Coordinate name=\"pelvis_ry\"", "Coordinate name=\"pelvis_rx\"", "", "another coordinate"},
      {"<Coordinate name=\"ankle_angle_r\"><default_value>0.2</default_value></Coordinate>", "", "",
       "has 1 coordinates"},
      {"for tests &amp; for", "for tests & for", "", "well-formed"},
      {"</Body>", "</Bodi>", "", "well-formed"},
      {"<?xml", "<!DOCTYPE x [<!ENTITY a \"b\">]><?xml", "", "document type"},
  };
  for (const Broken& b : broken) {
    std::string text = leg_with(b.from, b.to, b.after);
    if (std::string(b.from) == "SimmSpline") {  // both of its tags
      text.replace(text.find("</SimmSpline>"), 13, "</GCVSpline>");
    } else if (std::string(b.from) == "<PinJoint") {
      text.replace(text.find("</PinJoint>"), 11, "</ScrewJoint>");
    }
    const std::string message = refusal_of(text);
    EXPECT_TRUE(contains(message, b.words)) << b.from << " -> " << b.to << ": " << message;
    EXPECT_EQ(message.rfind("leg.osim:", 0), 0u) << message;
    const std::size_t colon = message.find(':', 9);
    EXPECT_GT(std::atoi(message.c_str() + 9), 0) << message;
    EXPECT_GT(std::atoi(message.c_str() + colon + 1), 0) << message;
  }
}

TEST(ReadModel, NamesTheLineOfWhatIsWrong) {
  const std::string text = leg_with("<slack_length>0.069", "<slack_length>nan");
  EXPECT_EQ(refusal_of(text), "leg.osim:" + std::to_string(line_of(text, "<slack_length>nan")) +
                                  ":11: Blankevoort1991Ligament LCL1.slack_length = nan: \"nan\" is no finite number");
}

TEST(ReadModel, ReportsAllErrorsAtOnce) {
  std::string text = leg_with("<slack_length>0.069", "<slack_length>nan");
  text.replace(text.find("<mass>3"), 7, "<mass>x");
  Diagnostics out;
  EXPECT_FALSE(osim::parse_model(text, "leg.osim", out).has_value());
  EXPECT_EQ(out.items().size(), 2u);
}

TEST(ReadModel, RefusesFilesThatAreNoModels) {
  EXPECT_TRUE(contains(refusal_of("<html></html>"), "is no model of OpenSim"));
  EXPECT_TRUE(
      contains(refusal_of("<OpenSimDocument Version=\"40000\"><Storage/></OpenSimDocument>"), "Model: is missing"));
  Diagnostics out;
  EXPECT_FALSE(osim::read_model("/nowhere/leg.osim", out).has_value());
  EXPECT_EQ(out.items().at(0).code, Code::no_such_file);
}

TEST(ReadModel, RefusesHugeFilesBeforeReadingThem) {
  const TemporaryFolder folder;
  const std::string file = folder.write("huge.osim", "<OpenSimDocument/>");
  std::filesystem::resize_file(file, osim::kMaxFileSize + 1);
  Diagnostics out;
  EXPECT_FALSE(osim::read_model(file, out).has_value());
  EXPECT_EQ(out.items().at(0).code, Code::too_large);
}

}  // namespace
}  // namespace genu::test
