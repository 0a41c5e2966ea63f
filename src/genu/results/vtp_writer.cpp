#include "genu/results/vtp_writer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>

#include <fmt/format.h>
#include <zlib.h>

#include "genu/results/svg_text.h"

namespace genu {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say that they are little-endian");

constexpr std::size_t kBlock = 1 << 16;  // bytes before compression
constexpr int kQuick = 1;                // zlib's level: coordinates hardly shrink, however long one tries

void append_count(std::string& out, std::uint64_t count) {
  out.append(reinterpret_cast<const char*>(&count), sizeof count);
}

/// As VTK has it: number of blocks, bytes of a whole one, of the last one (0: it is whole), of each when compressed.
template <typename Number>
std::string compressed(const std::vector<Number>& values) {
  const auto* bytes = reinterpret_cast<const Bytef*>(values.data());
  const std::size_t size = values.size() * sizeof(Number), blocks = (size + kBlock - 1) / kBlock;
  std::string head, body;
  for (const std::uint64_t count : {blocks, kBlock, size % kBlock}) append_count(head, count);
  for (std::size_t k = 0; k < blocks; ++k) {
    const std::size_t from = k * kBlock, count = std::min(kBlock, size - from);
    uLongf length = compressBound(static_cast<uLong>(count));
    const std::size_t before = body.size();
    body.resize(before + length);
    if (compress2(reinterpret_cast<Bytef*>(body.data() + before), &length, bytes + from, static_cast<uLong>(count),
                  kQuick) != Z_OK)
      throw std::bad_alloc();  // the only thing that can go wrong with a bounded buffer
    body.resize(before + length);
    append_count(head, length);
  }
  return head + body;
}

std::vector<std::int32_t> offsets_of(std::size_t count, std::size_t each) {
  std::vector<std::int32_t> offsets;
  for (std::size_t k = 1; k <= count; ++k) offsets.push_back(static_cast<std::int32_t>(k * each));
  return offsets;
}

class VtpText {
 public:
  std::string write(const VtkPolyData& data) {
    xml_ =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<PolyData>\n";
    add_data("FieldData", data.field_data, true);
    xml_ += fmt::format(
        "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
        "NumberOfPolys=\"{}\">\n",
        data.points.size(), data.vertices.count, data.lines.count, data.triangles.count);
    add_data("PointData", data.point_data, false);
    add_data("CellData", data.cell_data, false);
    add_points(data.points);
    add_cells("Verts", data.vertices);
    add_cells("Lines", data.lines);
    add_cells("Polys", data.triangles);
    xml_ += "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
    return xml_ + appended_ + "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  void add_array(const char* type, const std::string& name, int components, std::size_t tuples, bool field,
                 const std::string& bytes) {
    xml_ += fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"", type, svg_escaped(name),
                        components);
    if (field) xml_ += fmt::format(" NumberOfTuples=\"{}\"", tuples);
    xml_ += fmt::format(" format=\"appended\" offset=\"{}\"/>\n", appended_.size());
    appended_ += bytes;
  }

  void add_numbers(const VtkArray& array, bool field) {
    std::vector<double> values = array.values;
    for (double& v : values)
      if (!std::isfinite(v)) v = std::numeric_limits<double>::quiet_NaN();
    add_array("Float64", array.name, array.components, values.size() / static_cast<std::size_t>(array.components),
              field, compressed(values));
  }

  /// Letters as numbers, a 0 after each word.
  void add_words(const VtkWords& words) {
    xml_ += fmt::format("<Array type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">\n",
                        svg_escaped(words.name), words.values.size());
    for (const std::string& word : words.values) {
      for (const char c : word) xml_ += fmt::format("{} ", static_cast<int>(static_cast<unsigned char>(c)));
      xml_ += "0\n";
    }
    xml_ += "</Array>\n";
  }

  void add_data(const char* tag, const VtkData& data, bool field) {
    if (data.numbers.empty() && data.words.empty()) return;
    xml_ += fmt::format("<{}>\n", tag);
    for (const VtkArray& array : data.numbers) add_numbers(array, field);
    for (const VtkWords& words : data.words) add_words(words);
    xml_ += fmt::format("</{}>\n", tag);
  }

  void add_points(const std::vector<Vec3>& points) {
    std::vector<double> values;
    values.reserve(3 * points.size());
    for (const Vec3& p : points) values.insert(values.end(), p.data(), p.data() + 3);
    xml_ += "<Points>\n";
    add_array("Float64", "Points", 3, points.size(), false, compressed(values));
    xml_ += "</Points>\n";
  }

  void add_cells(const char* tag, const VtkCells& cells) {
    if (cells.count == 0) return;
    xml_ += fmt::format("<{}>\n", tag);
    add_array("Int32", "connectivity", 1, 0, false, cells.connectivity);
    add_array("Int32", "offsets", 1, 0, false, cells.offsets);
    xml_ += fmt::format("</{}>\n", tag);
  }

  std::string xml_, appended_;
};

}  // namespace

VtkCells vtk_cells(const std::vector<std::array<int, 3>>& triangles) {
  std::vector<std::int32_t> corners;
  corners.reserve(3 * triangles.size());
  for (const auto& t : triangles) corners.insert(corners.end(), t.begin(), t.end());
  return {triangles.size(), compressed(corners), compressed(offsets_of(triangles.size(), 3))};
}

VtkCells vtk_cells(const std::vector<std::vector<int>>& paths) {
  std::vector<std::int32_t> corners, offsets;
  for (const auto& path : paths) {
    corners.insert(corners.end(), path.begin(), path.end());
    offsets.push_back(static_cast<std::int32_t>(corners.size()));
  }
  return {paths.size(), compressed(corners), compressed(offsets)};
}

std::string vtp_text(const VtkPolyData& data) { return VtpText().write(data); }

std::string pvd_text(const std::vector<PvdEntry>& entries) {
  std::string out =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (const PvdEntry& e : entries)
    out += fmt::format("<DataSet timestep=\"{}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n", e.time, e.part,
                       svg_escaped(e.name), svg_escaped(e.file));
  return out + "</Collection>\n</VTKFile>\n";
}

}  // namespace genu
