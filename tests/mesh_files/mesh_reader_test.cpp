#include "genu/mesh_files/mesh_reader.h"

#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/mesh/mesh_check.h"
#include "genu/mesh/solid_inertia.h"
#include "genu/mesh_files/stl_writer.h"
#include "genu/surface/tessellate.h"
#include "support/data.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

using test::TemporaryFolder;

std::string ascii_facet(const std::string& corners) {
  return "facet normal 0 0 1\nouter loop\n" + corners + "endloop\nendfacet\n";
}

const std::string kFirst = ascii_facet("vertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n");
const std::string kSecond = ascii_facet("vertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\n");
const std::string kBinaryTitle(80, 'x');

// The only error that reading `path` gives.
std::string error(const std::string& path) {
  Diagnostics out;
  EXPECT_FALSE(read_mesh(path, 1, out));
  EXPECT_EQ(out.items().size(), 1u);
  EXPECT_TRUE(out.has_errors());
  return out.items().empty() ? "" : to_string(out.items().front());
}

TEST(MeshReader, BinaryStlComesBackAsItWasWrittenAndWelded) {
  TemporaryFolder folder;
  const Mesh mesh = geodesic_mesh({0.03, 0.02, 0.01}, 0.002);
  ASSERT_EQ(write_stl(mesh, folder / "a.STL", 1e-3, "solid title that is not ASCII STL"), "");
  Diagnostics out;
  const auto back = read_mesh(folder / "a.STL", 1e-3, out);
  ASSERT_TRUE(back);
  EXPECT_TRUE(out.items().empty());
  ASSERT_EQ(back->vertices.size(), mesh.vertices.size());
  ASSERT_EQ(back->triangles.size(), mesh.triangles.size());
  double worst = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])];
      worst = std::max(worst, (back->vertices[static_cast<std::size_t>(back->triangles[t][k])] - p).norm());
    }
  }
  EXPECT_LT(worst, 0.03 * 6e-8);  // half a float32 step
  EXPECT_EQ(check_mesh(*back).boundary_edges, 0u);
}

TEST(MeshReader, FilesOfPiecesAreOneMesh) {
  TemporaryFolder folder;
  const std::string first = folder.write("first.stl", "solid a\n" + kFirst + "endsolid a\n");
  const std::string second = folder.write("second.stl", "solid b\n" + kSecond + "endsolid b\n");
  PieceFiles both;
  both.paths = {first, second};
  Diagnostics out;
  MeshFileFacts facts;
  const auto mesh = read_mesh(both, 1e-3, out, &facts);
  ASSERT_TRUE(mesh && out.items().empty());
  EXPECT_EQ(mesh->vertices.size(), 4u);
  EXPECT_EQ(mesh->triangles.size(), 2u);
  EXPECT_EQ(mesh->vertices[2], Vec3(1e-3, 1e-3, 0));
  EXPECT_EQ(facts.ends, (std::vector<std::size_t>{1, 2}));
  ASSERT_EQ(facts.borders.size(), 1u);
  EXPECT_EQ(facts.borders[0].vertices, 2u);
  EXPECT_EQ(facts.triangles, 2u);

  both.paths = {first, folder.write("third.stl", "solid b\n" + kSecond + kFirst + "endsolid b\n")};
  ASSERT_TRUE(read_mesh(both, 1e-3, out));
  ASSERT_EQ(out.items().size(), 1u);
  EXPECT_EQ(out.items()[0].file, both.text());
  EXPECT_EQ(out.items()[0].rule, "dropped 1 triangles that two of these files share");
}

TEST(MeshReader, EachUnreadablePieceIsNamed) {
  TemporaryFolder folder;
  PieceFiles files;
  files.paths = {folder.write("a.stl", "solid a\n" + kFirst + "endsolid a\n"), folder.write("b.stl", "solid cut short"),
                 folder / "none.stl"};
  Diagnostics out;
  EXPECT_FALSE(read_mesh(files, 1, out));
  ASSERT_EQ(out.items().size(), 2u);
  EXPECT_EQ(out.items()[0].file, files.paths[1]);
  EXPECT_EQ(out.items()[1].file, files.paths[2]);
}

TEST(MeshReader, TheUnitOfPiecesIsThatOfAllTogether) {
  TemporaryFolder folder;
  const auto sheet = [](double x) {
    return ascii_facet(fmt::format("vertex {0} 0 0\nvertex {1} 0 0\nvertex {1} 0.01 0\n", x, x + 0.002));
  };
  PieceFiles files;
  files.paths = {folder.write("a.stl", "solid a\n" + sheet(0) + "endsolid a\n"),
                 folder.write("b.stl", "solid b\n" + sheet(0.08) + "endsolid b\n")};
  Diagnostics out;
  double unit = 0;
  ASSERT_TRUE(read_mesh_of_some_unit(files, unit, out));
  EXPECT_EQ(unit, 1);
}

TEST(MeshReader, AllFormatsGiveTheSameSheet) {
  TemporaryFolder folder;
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
  // Texture coordinates and normals that differ must not tear the sheet.
  const std::string obj =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\nvn 0 1 0\n"
      "f 1/1/1 2/1/1 3/1/1\nf 1/2/2 3/2/2 4/2/2\n";
  for (const std::string& path : {folder.write("a.stl", "solid a\n" + kFirst + kSecond + "endsolid a\n"),
                                  folder.write("a.ply", ply), folder.write("a.obj", obj)}) {
    Diagnostics out;
    const auto mesh = read_mesh(path, 0.5, out);
    ASSERT_TRUE(mesh) << path;
    EXPECT_TRUE(out.items().empty()) << path;
    EXPECT_EQ(mesh->vertices.size(), 4u) << path;
    EXPECT_EQ(mesh->triangles.size(), 2u) << path;
    EXPECT_NEAR(bounding_box(*mesh).diagonal(), std::sqrt(0.5), 1e-15) << path;
  }
}

TEST(MeshReader, CoordinatesThatSinglePrecisionRoundsAreToldOf) {
  TemporaryFolder folder;
  Mesh mesh = geodesic_mesh({0.03, 0.02, 0.01}, 0.004);
  const auto warnings = [&](const Vec3& by, double unit) {
    Mesh moved = mesh;
    for (Vec3& v : moved.vertices) v += by;
    for (Vec3& v : moved.vertices)  // as binary STL has them; it is not written where it rounds so much
      for (int k = 0; k < 3; ++k) v[k] = unit * static_cast<double>(static_cast<float>(v[k] / unit));
    EXPECT_EQ(write_stl(moved, folder / "far.stl", unit, "far"), "");
    Diagnostics out;
    MeshFileFacts facts;
    EXPECT_TRUE(read_mesh(folder / "far.stl", unit, out, &facts));
    EXPECT_GT(facts.rounding, 0);
    return out.items().empty() ? std::string() : out.items().back().rule;
  };
  EXPECT_EQ(warnings(Vec3::Zero(), 1e-3), "");
  EXPECT_EQ(warnings({2, 0, 0}, 1e-3), "") << "2 m: rounded to 0.1 um";
  EXPECT_NE(warnings({1000, 0, 0}, 1e-3).find("rounded to 0.06"), std::string::npos);
  EXPECT_NE(warnings({100, 0, 0}, 1).find("rounded to 0.007"), std::string::npos);
}

TEST(MeshReader, TheUnitIsGuessedBeforeLengthsAreTold) {
  TemporaryFolder folder;
  Mesh mesh = geodesic_mesh({0.03, 0.02, 0.01}, 0.004);
  for (Vec3& v : mesh.vertices) v.x() += 0.1;
  for (const double unit : {1e-3, 1.0}) {
    ASSERT_EQ(write_stl(mesh, folder / "a.stl", unit, "knee"), "");
    Diagnostics out;
    double found = 0;
    const auto back = read_mesh_of_some_unit(folder / "a.stl", found, out);
    ASSERT_TRUE(back);
    EXPECT_EQ(found, unit);
    EXPECT_TRUE(out.items().empty()) << to_string(out.items()[0]);
    EXPECT_NEAR(back->vertices[0].x(), mesh.vertices[0].x(), 1e-8);
  }
}

TEST(MeshReader, DamagedCoordinatesAreNamed) {
  TemporaryFolder folder;
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  const std::string start = "solid a\n" + kFirst, end = "endsolid a\n";
  const auto with = [&](const std::string& x) {
    return start + ascii_facet("vertex " + x + " 0 0\nvertex 1 1 0\nvertex 0 1 0\n") + end;
  };
  for (const char* x : {"1e30", "1e155", "1e300", "-1e10", "nan", "inf"})
    says(error(folder.write("far.stl", with(x))), std::string("has \"") + x + "\" in line 11 where a coordinate");
  says(error(folder.write("off.stl", with("9e8"))), "of its vertex 4 at [9e+08, 0, 0]");
  ASSERT_EQ(write_stl(geodesic_mesh({1, 1, 1}, 0.6), folder / "whole.stl", 1, "sphere"), "");
  std::string far = test::read_file(folder / "whole.stl");
  const float huge = 1e30f;
  std::memcpy(far.data() + 84 + 50 + 12, &huge, sizeof huge);
  says(error(folder.write("binary.stl", far)), "beyond 1e9 of its units (triangle 2, [1e+30,");
}

std::string utf16(const std::string& text, bool big, bool mark) {
  std::string out = !mark ? "" : big ? "\xfe\xff" : "\xff\xfe";
  for (const char c : text) out += big ? std::string{'\0', c} : std::string{c, '\0'};
  return out;
}

const std::string kOff = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string kVtp =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\">"
    "<Points><DataArray format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray></Points><Polys>"
    "<DataArray Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>"
    "<DataArray Name=\"offsets\" format=\"ascii\">3</DataArray></Polys></Piece></PolyData></VTKFile>\n";

/// One triangle in each format of text.
const std::pair<std::string, std::string> kTexts[] = {
    {"a.stl", "solid\n" + ascii_facet("vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n") + "endsolid\n"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
    {"a.off", kOff},
    {"a.ply", kPly},
    {"a.vtp", kVtp}};

TEST(MeshReader, EveryTextFormatKnowsItsEncoding) {
  TemporaryFolder folder;
  for (const auto& [name, text] : kTexts) {
    Diagnostics out;
    const auto mesh = read_mesh(folder.write(name, "\xef\xbb\xbf" + text), 1, out);
    ASSERT_TRUE(mesh) << name << to_string(out.items()[0]);
    EXPECT_TRUE(out.items().empty()) << name;
    EXPECT_EQ(mesh->vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})) << name;
    for (const bool big : {false, true})
      for (const bool mark : {false, true})
        EXPECT_NE(error(folder.write(name, utf16(text, big, mark))).find("is text in UTF-16"), std::string::npos)
            << name;
  }
}

TEST(MeshReader, ABinaryStlMayBeginLikeUtf16) {
  TemporaryFolder folder;
  ASSERT_EQ(write_stl(geodesic_mesh({1, 1, 1}, 0.6), folder / "whole.stl", 1, "sphere"), "");
  std::string bytes = test::read_file(folder / "whole.stl");
  bytes.replace(0, 4,
                std::string("\xff\xfe"
                            "s\0",
                            4));
  Diagnostics out;
  EXPECT_TRUE(read_mesh(folder.write("mark.stl", bytes), 1, out));
  EXPECT_NE(error(folder.write("a.dae", utf16("<?xml", false, true))).find("is text in UTF-16"), std::string::npos);
}

TEST(MeshReader, EveryTextFormatTakesDecimalCommasButNotBesidePoints) {
  TemporaryFolder folder;
  for (const auto& [name, text] : kTexts) {
    const auto with = [&, name = name, text = text](const std::string& x, const std::string& y) {
      std::string out = text;
      const std::size_t at = out.find("1 0 0");
      out.replace(at, 5, x + " " + y + " 0");
      return folder.write(name, out);
    };
    Diagnostics out;
    const auto mesh = read_mesh(with("1,25", "-3,5e-1"), 1, out);
    ASSERT_TRUE(mesh) << name << to_string(out.items()[0]);
    EXPECT_EQ(mesh->vertices[1], Vec3(1.25, -0.35, 0)) << name;
    ASSERT_EQ(out.items().size(), 1u) << name;
    EXPECT_EQ(out.items()[0].severity, Diagnostic::Severity::warning);
    EXPECT_NE(out.items()[0].rule.find("decimal commas in line "), std::string::npos) << name;
    const std::string both = error(with("1,250", "0.5"));
    EXPECT_NE(both.find("\"1,250\" in line"), std::string::npos) << both;
    EXPECT_NE(both.find("decimal points elsewhere"), std::string::npos) << both;
    for (const char* x : {"1,2,3", "1.000,5", "1,", ",", "1,x"}) error(with(x, "0"));
  }
}

TEST(MeshReader, VerticesThatNothingUsesChangeNothing) {
  TemporaryFolder folder;
  Diagnostics out;
  const auto mesh =
      read_mesh(folder.write("a.obj", "v 1e8 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 7 7 7\nf 2 3 4\n"), 1, out);
  ASSERT_TRUE(mesh) << "a far one decides how near vertices are welded";
  EXPECT_EQ(mesh->vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_TRUE(out.items().empty());
}

TEST(MeshReader, ATwoSidedExportIsToldOfAndFacesOutward) {
  TemporaryFolder folder;
  Mesh ball = geodesic_mesh({0.03, 0.02, 0.01}, 0.004), turned = ball;
  for (auto& t : turned.triangles) std::swap(t[1], t[2]);
  turned.triangles.insert(turned.triangles.end(), ball.triangles.begin(), ball.triangles.end());
  ASSERT_EQ(write_stl(turned, folder / "two.stl", 1e-3, "two"), "");
  Diagnostics out;
  const auto mesh = read_mesh(folder / "two.stl", 1e-3, out);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->triangles.size(), ball.triangles.size());
  EXPECT_NEAR(solid_inertia(*mesh).volume, solid_inertia(ball).volume, 1e-10);
  ASSERT_EQ(out.items().size(), 1u);
  EXPECT_NE(out.items()[0].rule.find("stood there both ways round"), std::string::npos);
}

TEST(MeshReader, OffAndVtpAreRead) {
  TemporaryFolder folder;
  Diagnostics out;
  const auto off = read_mesh(folder.write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), 1, out);
  const auto vtp =
      read_mesh(folder.write("a.vtp",
                             "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\">"
                             "<Points><DataArray format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray></Points><Polys>"
                             "<DataArray Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>"
                             "<DataArray Name=\"offsets\" format=\"ascii\">3</DataArray></Polys></Piece></PolyData>"
                             "</VTKFile>"),
                1, out);
  ASSERT_TRUE(off && vtp);
  EXPECT_EQ(off->vertices, vtp->vertices);
  EXPECT_EQ(off->triangles, vtp->triangles);
}

TEST(MeshReader, TornCornersWithinRoundingAreWeldedAndRepeatsDropped) {
  TemporaryFolder folder;
  const std::string torn = ascii_facet("vertex 0 0 0\nvertex 1.0000005 1 0\nvertex 0 1 0\n");
  const std::string flat = ascii_facet("vertex 0 0 0\nvertex 1 0 0\nvertex 1.0000002 0 0\n");
  const std::string turned = ascii_facet("vertex 1 0 0\nvertex 0 0 0\nvertex 1 1 0\n");
  Diagnostics out;
  const auto mesh = read_mesh(folder.write("a.stl", "solid\n" + kFirst + torn + flat + turned + "endsolid\n"), 1, out);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->vertices.size(), 4u);
  EXPECT_EQ(mesh->triangles.size(), 2u);
  ASSERT_EQ(out.items().size(), 1u);
  EXPECT_FALSE(out.has_errors());
  EXPECT_NE(out.items()[0].rule.find("1 triangles without extent and 1 repeated"), std::string::npos);
}

TEST(MeshReader, NamesWhatIsWrongWithAFile) {
  TemporaryFolder folder;
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  says(error(folder / "nothing.stl"), "no such mesh file");
  says(error(folder / "nothing.stl"), folder / "nothing.stl");
  std::filesystem::create_directory(folder / "folder.stl");
  says(error(folder / "folder.stl"), "is a folder");
  says(error(folder.write("empty.stl", "")), "is empty");
  says(error(folder.write("a.step", "ISO-10303-21;")), ".step");
  says(error("/dev/null"), "not a regular file");
  says(error(folder.write("junk.stl", std::string(1000, '\7'))), "binary STL of");
  says(error(folder.write("short.stl", "x")), "too short");
  says(error(folder.write("cut.stl", "solid a\n" + kFirst)), "truncated");
  says(error(folder.write("none.stl", "solid a\nendsolid a\n")), "");
  says(error(folder.write("nan.stl",
                          "solid a\n" + ascii_facet("vertex nan 0 0\nvertex 1 0 0\nvertex 1 1 0\n") + "endsolid a\n")),
       "");
  says(error(folder.write("no.ply", "solid a\n")), "does not start with \"ply\"");
  says(error(folder.write("cut.ply", "ply\nformat ascii 1.0\nelement vertex 4\n")), "end_header");
  says(error(folder.write("points.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\n")), "");
  says(error(folder.write("index.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n")), "");
  says(error(folder.write("point.stl",
                          "solid a\n" + ascii_facet("vertex 1 1 1\nvertex 1 1 1\nvertex 1 1 1\n") + "endsolid a\n")),
       "without extent");
}

TEST(MeshReader, EveryTruncationOfABinaryFileIsRefused) {
  TemporaryFolder folder;
  ASSERT_EQ(write_stl(geodesic_mesh({1, 1, 1}, 0.6), folder / "whole.stl", 1, "sphere"), "");
  const std::string bytes = test::read_file(folder / "whole.stl");
  for (std::size_t size = 1; size < bytes.size(); size += 37) error(folder.write("cut.stl", bytes.substr(0, size)));
  error(folder.write("long.stl", bytes + bytes + bytes + "more"));
  std::string infinite = bytes;
  infinite.replace(84 + 12, 4, std::string("\0\0\x80\x7f", 4));
  EXPECT_NE(error(folder.write("inf.stl", infinite)).find("not a finite number"), std::string::npos);
}

TEST(MeshReader, EveryTruncationOfAnAsciiPlyIsRefused) {
  TemporaryFolder folder;
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  for (std::size_t size = 1; size + 1 < ply.size(); ++size) error(folder.write("cut.ply", ply.substr(0, size)));
  Diagnostics out;
  EXPECT_TRUE(read_mesh(folder.write("whole.ply", ply), 1, out));
  EXPECT_TRUE(out.items().empty());
  EXPECT_TRUE(read_mesh(folder.write("cut.ply", ply.substr(0, ply.size() - 1)), 1, out));
  ASSERT_EQ(out.items().size(), 1u) << "all numbers are there, and the last one may be cut";
  EXPECT_NE(out.items()[0].rule.find("no line end"), std::string::npos);
}

TEST(MeshReader, EveryTruncationOfABinaryPlyIsRefused) {
  TemporaryFolder folder;
  std::string ply =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int corners[3] = {0, 1, 2};
  ply.append(reinterpret_cast<const char*>(positions), sizeof positions);
  ply.push_back(3);
  ply.append(reinterpret_cast<const char*>(corners), sizeof corners);
  for (std::size_t size = 1; size < ply.size(); ++size) error(folder.write("cut.ply", ply.substr(0, size)));
  Diagnostics out;
  EXPECT_TRUE(read_mesh(folder.write("whole.ply", ply), 1, out));
}

struct Expected {
  const char* file;
  double unit;
  std::size_t vertices, triangles;
  int components;
};

class KneeMesh : public ::testing::TestWithParam<Expected> {};

TEST_P(KneeMesh, HasTheKnownNumbers) {
  GENU_NEEDS_DATA(GetParam().file);
  Diagnostics out;
  const auto mesh = read_mesh(test::data_path(GetParam().file), GetParam().unit, out);
  ASSERT_TRUE(mesh);
  const MeshReport report = check_mesh(*mesh);
  EXPECT_EQ(report.vertices, GetParam().vertices);
  EXPECT_EQ(report.triangles, GetParam().triangles);
  EXPECT_EQ(report.components, GetParam().components);
  EXPECT_EQ(report.non_manifold_edges, 0u);
  EXPECT_GT(report.box.diagonal(), 0.03);
  EXPECT_LT(report.box.diagonal(), 0.2);
}

INSTANTIATE_TEST_SUITE_P(Files, KneeMesh,
                         ::testing::Values(Expected{"lenhart2015/ACLC01-R-femur-cart.stl", 1, 15179, 29782, 1},
                                           Expected{"lenhart2015/ACLC01-R-tibia-cart.stl", 1, 4453, 8602, 2},
                                           Expected{"lenhart2015/ACLC01-R-femur-cart-medium.stl", 1, 5438, 10507, 1},
                                           Expected{"ssm/mean_Femur_Cartilage.ply", 1e-3, 10931, 21214, 1}));

TEST(MeshReader, AFileThatBreaksItsReaderDownIsRefused) {
  TemporaryFolder folder;
  const std::string itself = folder.write(
      "itself.dae",
      "<?xml version=\"1.0\"?><COLLADA version=\"1.4.1\"><library_visual_scenes><visual_scene id=\"a\"><node id=\"n\">"
      "<instance_node url=\"#n\"/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene "
      "url=\"#a\"/></scene></COLLADA>");
  EXPECT_NE(error(itself).find("breaks down over it"), std::string::npos);
  EXPECT_NE(error(folder.write("deep.gltf", std::string(1'000'000, '['))).find("cannot be read as a mesh"),
            std::string::npos);
}

TEST(MeshReader, ContentIsToldByTheBytesOfAllFiles) {
  const test::TemporaryFolder folder;
  const std::string a = folder.write("a.ply", "one"), b = folder.write("b.ply", "two"),
                    c = folder.write("c.ply", "one");
  MeshLibrary meshes;
  PieceFiles both(a), turned(b);
  both.paths.push_back(b);
  turned.paths.push_back(a);
  EXPECT_NE(meshes.content_of(a), "");
  EXPECT_EQ(meshes.content_of(a), meshes.content_of(c));
  EXPECT_NE(meshes.content_of(a), meshes.content_of(b));
  EXPECT_NE(meshes.content_of(a), meshes.content_of(both));
  EXPECT_NE(meshes.content_of(turned), meshes.content_of(both));
  both.paths.push_back(folder / "none.ply");
  EXPECT_EQ(meshes.content_of(both), "");
  EXPECT_EQ(meshes.content_of(folder.write("knee.gltf", "{}")), "") << "its buffers are files of their own";
  EXPECT_EQ(meshes.content_of(folder.write("knee.mkv", "film")), "");
  meshes.put(a, Mesh{});
  EXPECT_EQ(meshes.content_of(a), "");
}

}  // namespace
}  // namespace genu
