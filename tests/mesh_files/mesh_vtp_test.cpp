// VTP files as VTK writes them: every encoding of one mesh reads as the same mesh.
#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_formats.h"
#include "support/vtp_text.h"

namespace genu {
namespace {

using test::VtpBytes;

const std::vector<double> kPoints = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0.5};
const std::vector<double> kCorners = {0, 1, 2, 0, 2, 3}, kOffsets = {3, 6};

std::string numbers(const std::vector<double>& values) {
  std::string text;
  for (const double v : values) text += std::to_string(v) + " ";
  return text;
}

std::string whole(const std::vector<double>& values) {
  std::string text;
  for (const double v : values) text += std::to_string(static_cast<int>(v)) + " ";
  return text;
}

struct Arrays {
  std::string points, corners, offsets;  ///< <DataArray> elements
};

std::string file(const std::string& attributes, const Arrays& arrays, const std::string& tail = {},
                 const std::string& counts = "NumberOfPoints=\"4\" NumberOfPolys=\"2\"") {
  return "<?xml version=\"1.0\"?>\n<!-- by hand -->\n<VTKFile type=\"PolyData\" version=\"0.1\" " + attributes +
         ">\n<PolyData>\n<Piece " + counts +
         " NumberOfVerts=\"0\">\n<PointData Normals=\"n\">\n<DataArray "
         "type=\"Float32\" Name=\"connectivity\" format=\"ascii\">9 9</DataArray></PointData>\n<Points>" +
         arrays.points + "</Points>\n<Verts><DataArray Name=\"connectivity\" format=\"ascii\"/></Verts>\n<Polys>" +
         arrays.corners + arrays.offsets + "</Polys>\n</Piece>\n</PolyData>\n" + tail + "</VTKFile>\n";
}

std::string element(const std::string& type, const std::string& name, const std::string& format,
                    const std::string& content, const std::string& more = {}) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"" + format + "\" " + more + ">" + content +
         "</DataArray>";
}

Arrays ascii() {
  return {element("Float32", "Points", "ascii", numbers(kPoints)),
          element("Int64", "connectivity", "ascii", whole(kCorners)),
          element("Int64", "offsets", "ascii", whole(kOffsets))};
}

std::string read_vtp_text(const std::string& text, Mesh& mesh) {
  MeshNotes notes;
  return read_vtp(text, mesh, notes);
}

void expect_square(const std::string& text, const std::string& what) {
  Mesh mesh;
  ASSERT_EQ(read_vtp_text(text, mesh), "") << what;
  ASSERT_EQ(mesh.vertices.size(), 4u) << what;
  EXPECT_EQ(mesh.vertices[3], Vec3(0, 1, 0.5)) << what;
  ASSERT_EQ(mesh.triangles.size(), 2u) << what;
  EXPECT_EQ(mesh.triangles[1], (std::array{0, 2, 3})) << what;
}

TEST(MeshVtp, EveryEncodingIsTheSameMesh) {
  expect_square(file("byte_order=\"LittleEndian\"", ascii()), "ascii");
  for (const bool swap : {false, true})
    for (const bool wide : {false, true})
      for (const bool compressed : {false, true}) {
        const VtpBytes f{"Float64", wide, swap, compressed}, i{"Int32", wide, swap, compressed};
        const std::string attributes = std::string("byte_order=\"") + (swap ? "BigEndian" : "LittleEndian") +
                                       "\" header_type=\"" + (wide ? "UInt64" : "UInt32") + "\"" +
                                       (compressed ? " compressor='vtkZLibDataCompressor'" : "");
        expect_square(file(attributes, {element("Float64", "Points", "binary", f.base64(kPoints, false)),
                                        element("Int32", "connectivity", "binary", i.base64(kCorners, true)),
                                        element("Int32", "offsets", "binary", i.base64(kOffsets, false))}),
                      "inline " + attributes);
        const auto appended = [&](const std::string& encoding, const std::vector<std::string>& parts) {
          std::string data, offsets[3];
          for (std::size_t k = 0; k < 3; ++k) {
            offsets[k] = "offset=\"" + std::to_string(data.size()) + "\"";
            data += parts[k];
          }
          return file(attributes,
                      {element("Float64", "Points", "appended", "", offsets[0]),
                       element("Int32", "connectivity", "appended", "", offsets[1]),
                       element("Int32", "offsets", "appended", "", offsets[2])},
                      "<AppendedData encoding=\"" + encoding + "\">\n_" + data + "\n</AppendedData>\n");
        };
        expect_square(appended("raw", {f.raw(kPoints), i.raw(kCorners), i.raw(kOffsets)}), "raw " + attributes);
        expect_square(
            appended("base64", {f.base64(kPoints, false), i.base64(kCorners, false), i.base64(kOffsets, false)}),
            "base64 " + attributes);
      }
}

TEST(MeshVtp, StripsAndPolygonsAndPieces) {
  std::string text =
      file("",
           {element("Float32", "Points", "ascii", numbers(kPoints)),
            element("Int64", "connectivity", "ascii", "0 1 2 3"), element("Int64", "offsets", "ascii", "4")},
           {}, "NumberOfPoints=\"4\" NumberOfPolys=\"1\"");
  Mesh polygon;
  ASSERT_EQ(read_vtp_text(text, polygon), "");
  EXPECT_EQ(polygon.triangles.size(), 2u);
  std::string strip =
      file("",
           {element("Float32", "Points", "ascii", numbers(kPoints)),
            element("Int64", "connectivity", "ascii", "0 1 3 2"), element("Int64", "offsets", "ascii", "4")},
           {}, "NumberOfPoints=\"4\" NumberOfStrips=\"1\"");
  for (std::size_t at = strip.find("Polys>"); at != std::string::npos; at = strip.find("Polys>", at + 1))
    strip.replace(at, 6, "Strips>");
  Mesh strips;
  ASSERT_EQ(read_vtp_text(strip, strips), "");
  ASSERT_EQ(strips.triangles.size(), 2u);
  EXPECT_EQ(strips.triangles[0], (std::array{0, 1, 3}));
  EXPECT_EQ(strips.triangles[1], (std::array{1, 2, 3}));  // turned, so that both are wound alike
}

TEST(MeshVtp, SaysWhatItCannotRead) {
  const auto says = [](const std::string& text, const std::string& part) {
    Mesh mesh;
    const std::string problem = read_vtp_text(text, mesh);
    EXPECT_NE(problem.find(part), std::string::npos) << problem;
  };
  says("", "does not start");
  says("<html></html>", "does not start");
  says("<VTKFile type=\"UnstructuredGrid\"></VTKFile>", "\"UnstructuredGrid\"");
  says(file("compressor=\"vtkLZ4DataCompressor\"", ascii()), "vtkLZ4DataCompressor");
  says(file("", ascii(), {}, "NumberOfPoints=\"5\" NumberOfPolys=\"2\""), "NumberOfPoints");
  says(file("", ascii(), {}, "NumberOfPoints=\"4\" NumberOfPolys=\"3\""), "NumberOfPolys");
  Arrays wrong = ascii();
  wrong.corners = element("Int64", "connectivity", "ascii", "0 1 2 0 2 4");
  says(file("", wrong), "names a vertex");
  wrong.corners = element("Int64", "connectivity", "ascii", "0 1 2 0 2");
  says(file("", wrong), "more corners");
}

TEST(MeshVtp, EveryTruncationIsRefused) {
  const std::string text = file("", ascii());
  const std::size_t end = text.find("</VTKFile");
  for (std::size_t size = 1; size < end; size += 3) {
    Mesh mesh;
    EXPECT_NE(read_vtp_text(text.substr(0, size), mesh), "") << size;
  }
}

TEST(MeshVtp, NamesTheLineAndColumnWhereTheXmlBreaks) {
  const auto says = [](std::string text, const std::string& what, const std::string& with, const std::string& part) {
    const std::size_t place = text.find(what);
    ASSERT_NE(place, std::string::npos) << what;
    Mesh mesh;
    const std::string problem = read_vtp_text(text.replace(place, what.size(), with), mesh);
    EXPECT_NE(problem.find("is no whole XML"), std::string::npos) << problem;
    EXPECT_NE(problem.find(part), std::string::npos) << problem;
  };
  const std::string text = file("", ascii());
  says(text, "</Polys>", "</Pols>", "(line 10, column");
  says(text, "<Piece Num", "<Piece =Num", "(line 5, column 8)");
  // Bytes that are no XML count too: the broken tag is in the third line after them.
  const std::string appended = "<AppendedData encoding=\"raw\">\n_<\n&\n\n</AppendedData>\n<Odd></Even>\n";
  says(file("", ascii(), appended), "<Odd>", "<Odd>", "(line 18, column");
}

/// VTK writes the range of an array into its element, after the numbers.
TEST(MeshVtp, ElementsInsideAnArrayArePassedOver) {
  Arrays arrays = ascii();
  arrays.points = element("Float32", "Points", "ascii",
                          numbers(kPoints) +
                              "\n<InformationKey name=\"L2_NORM_RANGE\" length=\"2\">\n<Value "
                              "index=\"0\">\n0\n</Value></InformationKey>\n");
  expect_square(file("", arrays), "InformationKey");
  arrays = ascii();
  arrays.corners = element("Int64", "connectivity", "ascii", "<!-- two triangles -->" + whole(kCorners));
  expect_square(file("", arrays), "comment");
}

TEST(MeshVtp, ArraysOfOtherShapeOrTypeAreNamed) {
  const auto says = [](const Arrays& arrays, const std::string& part) {
    Mesh mesh;
    const std::string problem = read_vtp_text(file("", arrays), mesh);
    EXPECT_NE(problem.find(part), std::string::npos) << problem;
  };
  Arrays good = ascii();
  good.points = element("Float32", "Points", "ascii", numbers(kPoints), "NumberOfComponents=\"3\"");
  Mesh mesh;
  EXPECT_EQ(read_vtp_text(file("", good), mesh), "");
  for (const char* count : {"2", "0", "-3", "x"}) {
    Arrays bad = ascii();
    bad.points =
        element("Float32", "Points", "ascii", numbers(kPoints), std::string("NumberOfComponents=\"") + count + "\"");
    says(bad, std::string("of \"") + count + "\" components, not 3 (line 8)");
  }
  Arrays bad = ascii();
  bad.points = element("Complex", "Points", "ascii", numbers(kPoints));
  says(bad, "type \"Complex\"");
}

TEST(MeshVtp, ConcavePolygonsAreCutFromTheReflexCorner) {
  Arrays arrays = ascii();
  arrays.points = element("Float64", "Points", "ascii", "0 0 0  2 -1 0  0.5 0 0  2 1 0");
  arrays.corners = element("Int64", "connectivity", "ascii", "1 2 3 0");
  arrays.offsets = element("Int64", "offsets", "ascii", "4");
  Mesh mesh;
  const std::string text = file("", arrays, {}, "NumberOfPoints=\"4\" NumberOfPolys=\"1\"");
  ASSERT_EQ(read_vtp_text(text, mesh), "");
  ASSERT_EQ(mesh.triangles.size(), 2u);
  for (const auto& t : mesh.triangles) EXPECT_TRUE(t[0] == 2 || t[1] == 2 || t[2] == 2);
}

TEST(MeshVtp, MayEndWithALongComment) {
  Mesh mesh;
  EXPECT_EQ(read_vtp_text(file("", ascii()) + "<!--" + std::string(500, 'x') + "-->", mesh), "");
  EXPECT_EQ(mesh.triangles.size(), 2u);
}

}  // namespace
}  // namespace genu
