// Files as 3D Slicer 3 to 5 write them, tables, and what is wrong with others.
#include "genu/landmarks/landmark_file.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/text.h"

namespace genu {
namespace {

std::string markups(const std::string& frame, const std::string& points) {
  return R"({
    "@schema": "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/markups-schema-v1.0.3.json#",
    "markups": [
        {
            "type": "Fiducial",
            )" +
         frame + R"(
            "locked": false,
            "controlPoints": [)" +
         points + R"(]
        }
    ]
})";
}

std::string control_point(const std::string& label, const std::string& position,
                          const std::string& status = "defined") {
  return "{ \"id\": \"1\", \"label\": \"" + label + "\", \"position\": " + position + ",\n \"positionStatus\": \"" +
         status + "\" }";
}

LandmarkFile read(const std::string& file, const std::string& text, double unit = 1e-3) {
  Diagnostics out;
  const auto found = read_landmark_text(file, text, unit, out);
  EXPECT_TRUE(found && out.items().empty()) << test::messages(out);
  return found.value_or(LandmarkFile{});
}

void refused(const std::string& file, const std::string& text, const std::vector<std::string>& said) {
  Diagnostics out;
  EXPECT_FALSE(read_landmark_text(file, text, 1e-3, out)) << text;
  ASSERT_EQ(out.items().size(), said.size()) << test::messages(out);
  for (std::size_t i = 0; i < said.size(); ++i)
    EXPECT_TRUE(test::contains(to_string(out.items()[i]), said[i])) << to_string(out.items()[i]) << "\nnot\n"
                                                                    << said[i];
}

TEST(LandmarkFile, MarkupsOfSlicer) {
  const std::string two =
      control_point("ACL_femur", "[1.5, -2.0, 3]") + ",\n" + control_point("b", "[0, 0, 0]", "undefined");
  const LandmarkFile lps =
      read("p.mrk.json", markups("\"coordinateSystem\": \"LPS\", \"coordinateUnits\": \"mm\",", two));
  ASSERT_EQ(lps.points.size(), 1u);  // the other is not placed yet
  EXPECT_EQ(lps.space, "LPS");
  EXPECT_EQ(lps.points[0].name, "ACL_femur");
  EXPECT_TRUE(lps.points[0].at.isApprox(Vec3(1.5e-3, -2e-3, 3e-3)));
  EXPECT_EQ(lps.points[0].place.at.line, 8);
  EXPECT_EQ(read("p.json", markups("", two)).space, "LPS");
  const LandmarkFile ras =
      read("P.MRK.JSON", markups(R"("coordinateSystem": "RAS", "coordinateUnits": ["m", "UCUM", "meter"],)", two));
  EXPECT_EQ(ras.space, "RAS");
  EXPECT_TRUE(ras.points[0].at.isApprox(Vec3(1.5, -2, 3)));
}

TEST(LandmarkFile, ListsOfTwoFramesAreBroughtIntoTheFirst) {
  const std::string text = R"({"markups": [
 {"coordinateSystem": "LPS", "controlPoints": [{"label": "a", "position": [1, 2, 3]}]},
 {"coordinateSystem": "RAS", "controlPoints": [{"label": "b", "position": [1, 2, 3]}]}]})";
  const LandmarkFile found = read("p.mrk.json", text);
  ASSERT_EQ(found.points.size(), 2u);
  EXPECT_TRUE(found.points[1].at.isApprox(Vec3(-1e-3, -2e-3, 3e-3)));
}

TEST(LandmarkFile, AllMistakesOfMarkupsAtOnce) {
  refused("p.mrk.json",
          markups("\"coordinateSystem\": \"IJK\", \"coordinateUnits\": \"inch\",",
                  control_point("a", "[1, 2]") + ",\n" + control_point("b", "[1, \"x\", 1e9]") + ",\n" +
                      control_point("", "[1, 2, 3]")),
          {"p.mrk.json:6:33: markups[0].coordinateSystem = \"IJK\": must be \"LPS\" or \"RAS\"",
           "p.mrk.json:6:59: markups[0].coordinateUnits = \"inch\": must be",
           "p.mrk.json:8:70: markups[0].controlPoints[0].position: must be three numbers",
           "p.mrk.json:10:44: markups[0].controlPoints[1].position[1] = \"x\": must be a number",
           "p.mrk.json:10:49: markups[0].controlPoints[1].position[2] = 1e9: must be within 1e+06",
           "p.mrk.json:12:23: markups[0].controlPoints[2].label = \"\": must name the point"});
  refused("p.mrk.json", "{}", {"markups: is missing"});
  refused("p.mrk.json", R"({"markups": [{}]})", {"markups[0].controlPoints: must list the points"});
  refused("p.mrk.json", markups("", ""), {"has no points"});
  refused("p.mrk.json", R"({"markups": [{"controlPoints": [3, {"label": "a"}]}]})",
          {"controlPoints[0].label", "controlPoints[0].position", "controlPoints[1].position: is missing"});
}

TEST(LandmarkFile, FiducialsOfEverySlicer) {
  const std::string row =
      "vtkMRMLMarkupsFiducialNode_0,1.5,-2,3,0,0,0,1,1,1,0,\"ACL, femur\",,vtkMRMLScalarVolumeNode1\n";
  const std::string columns = "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n";
  const std::pair<const char*, const char*> versions[] = {
      {"# Markups fiducial file version = 4.5\n# CoordinateSystem = 0\n", "RAS"},
      {"# Markups fiducial file version = 4.10\r\n# CoordinateSystem = 1\r\n", "LPS"},
      {"# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n", "LPS"},
      {"# Markups fiducial file version = 5.6\n# CoordinateSystem = RAS\n", "RAS"},
      {"# Markups fiducial file version = 4.6\n", "RAS"}};
  for (const auto& [header, space] : versions) {
    const LandmarkFile found = read("p.fcsv", header + columns + row);
    ASSERT_EQ(found.points.size(), 1u) << header;
    EXPECT_EQ(found.space, space) << header;
    EXPECT_EQ(found.points[0].name, "ACL, femur");
    EXPECT_TRUE(found.points[0].at.isApprox(Vec3(1.5e-3, -2e-3, 3e-3)));
    EXPECT_EQ(read("p.fcsv", header + row).points.size(), 1u);  // without its columns
  }
  const LandmarkFile old = read("p.fcsv",
                                "# Fiducial List file /data/F.fcsv\n# version = 2\n# name = L\n"
                                "# columns = label,x,y,z,sel,vis\nACL_femur,1.5,-2,3,1,1\n");
  EXPECT_EQ(old.points.at(0).name, "ACL_femur");
  EXPECT_EQ(old.space, "RAS");
}

TEST(LandmarkFile, AllMistakesOfFiducialsAtOnce) {
  refused("p.fcsv",
          "# Markups fiducial file version = 4.11\n# CoordinateSystem = IJK\n# columns = id,x,y,z,label\n"
          "1,2,3,4,a\n1,2,x,4,b\n1,2,3,4,a\n1,2\n1,2,3,4,\n",
          {"p.fcsv:2:22: CoordinateSystem = \"IJK\": counts voxels", "p.fcsv:5:5: y = \"x\": must be a number",
           "p.fcsv:7: name: is missing", "p.fcsv:7: y: is missing", "p.fcsv:7: z: is missing",
           "p.fcsv:8: name: is missing", "p.fcsv:6:9: name = \"a\": is the name of the point on line 4, too"});
  refused("p.fcsv", "id,x,y,z\n1,2,3,4\n", {"does not begin as a list of fiducials"});
  refused("p.fcsv", "# Markups fiducial file version = 4.11\n# columns = id,x,y\n1,2,3\n",
          {"p.fcsv:2: columns: must name"});
  refused("p.fcsv", "# Markups fiducial file version = 4.11\n# CoordinateSystem = up\na",
          {"must be LPS or RAS", "name: is", "x: is", "y: is", "z: is"});
}

TEST(LandmarkFile, Tables) {
  const LandmarkFile found = read("p.csv", "\xef\xbb\xbfName,X,Y,Z,error\nACL_femur,1.5,-2,3,0.5\nb,0,0,0,\n", 1);
  ASSERT_EQ(found.points.size(), 2u);
  EXPECT_EQ(found.space, "");
  EXPECT_TRUE(found.points[0].at.isApprox(Vec3(1.5, -2, 3)));
  EXPECT_EQ(found.points[0].error, 0.5);
  EXPECT_FALSE(found.points[1].error);
  EXPECT_EQ(found.points[1].place.at, (SourceLocation{3, 1}));
  EXPECT_EQ(read("p.csv", "x;y;z;label\n1;2;3;ACL femur\n").points.at(0).name, "ACL femur");
}

TEST(LandmarkFile, AllMistakesOfTablesAtOnce) {
  refused("p.csv", "name,x,y,z,error\na,1,2,nan,0\nb,1e7,2,3,-1\n\"c,1,2,3\n",
          {"p.csv:2:7: z = \"nan\": must be a number", "p.csv:2:11: error = 0: must be > 0",
           "p.csv:3:3: x = 1e7: must be within", "p.csv:3:11: error = -1: must be > 0", "p.csv:4: has a quote"});
  refused("p.csv", "ACL_femur,1,2,3\n", {"p.csv:1:1: must name the columns: name,x,y,z"});
  refused("p.csv", "name;x;y;z\na;1,5;2;3\n", {"p.csv:2:3: x = \"1,5\": must have a point in the place of the comma"});
  refused("p.csv", "", {"has no points"});
  refused("p.csv", "name,x,y,z\n", {"has no points"});
  refused("p.txt", "name,x,y,z\n", {"must be landmarks"});
  refused("p.csv",
          std::string("\xff\xfe"
                      "n\0a\0",
                      6),
          {"UTF-16"});
  refused("p.csv", "name,x,y,z\n\xe9,1,2,3\n", {"p.csv:2:1: is no UTF-8"});
  Diagnostics out;
  EXPECT_FALSE(read_landmarks("none.csv", 1, out));
  EXPECT_TRUE(test::contains(test::messages(out), "none.csv"));
}

}  // namespace
}  // namespace genu
