// What is written as .vtp is read again by genu's own reader; VTK's own reads it in tests/vtk.
#include "genu/results/vtp_writer.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_reader.h"
#include "support/layers.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

using test::contains;

TEST(VtpWriter, AMeshOfManyBlocksReadsBackAsItWas) {
  const Mesh mesh = test::sheet(0.04, 90);  // 8281 points: 199 kB, several blocks of each array
  VtkPolyData data;
  for (const Vec3& v : mesh.vertices) data.points.push_back(1e3 * v + Vec3(1.0 / 3, 0, 0));
  data.triangles = vtk_cells(mesh.triangles);
  data.field_data = {{{"TimeValue", {0.1}}}, {{"body", {"a & \"b\" <c>"}}}};
  data.cell_data.numbers.push_back({"pressure_MPa", std::vector<double>(mesh.triangles.size(), 0.25)});
  const test::TemporaryFolder folder;
  Diagnostics out;
  const auto read = read_mesh(folder.write("sheet.vtp", vtp_text(data)), 1, out);
  ASSERT_TRUE(read.has_value()) << (out.items().empty() ? "" : to_string(out.items()[0]));
  ASSERT_EQ(read->vertices.size(), mesh.vertices.size());
  EXPECT_EQ(read->triangles, mesh.triangles);
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k) EXPECT_EQ(read->vertices[k], data.points[k]);
}

TEST(VtpWriter, CountsAndNamesStandInTheHeader) {
  VtkPolyData data;
  data.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)};
  data.lines = vtk_cells(std::vector<std::vector<int>>{{0, 1, 2}, {2, 0}});
  data.vertices = vtk_cells(std::vector<std::vector<int>>{{1}});
  data.cell_data.words.push_back({"name", {"dot", "A", "<&>"}});
  data.point_data.numbers.push_back({"force_N", std::vector<double>(9, std::nan("")), 3});
  const std::string text = vtp_text(data);
  EXPECT_TRUE(contains(text,
                       "NumberOfPoints=\"3\" NumberOfVerts=\"1\" NumberOfLines=\"2\" NumberOfStrips=\"0\" "
                       "NumberOfPolys=\"0\""));
  EXPECT_TRUE(contains(text, "Name=\"force_N\" NumberOfComponents=\"3\""));
  EXPECT_TRUE(contains(text, "100 111 116 0\n65 0\n60 38 62 0\n")) << "letters as numbers";
  EXPECT_FALSE(contains(text, "<Polys>")) << "what has no cells says none";
}

TEST(VtpWriter, AListNamesEachFileWithItsTimeAndPart) {
  const std::string text = pvd_text({{0, 0, "femur", "vtp/femur.1.vtp"}, {0.1, 1, "a<b", "vtp/x.vtp"}});
  EXPECT_TRUE(
      contains(text, "<DataSet timestep=\"0\" group=\"\" part=\"0\" name=\"femur\" file=\"vtp/femur.1.vtp\"/>"));
  EXPECT_TRUE(contains(text, "timestep=\"0.1\" group=\"\" part=\"1\" name=\"a&lt;b\""));
}

}  // namespace
}  // namespace genu
