// The XML is parsed by pugixml. Appended data follows the "_" in <AppendedData>, raw bytes among them: it is cut out
// first, because it is no XML.
#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include <pugixml.hpp>

#include "genu/mesh_files/mesh_formats.h"
#include "genu/mesh_files/text_words.h"
#include "genu/mesh_files/tolerances.h"
#include "genu/mesh_files/vtp_arrays.h"

namespace genu {
namespace {

/// The cells of one kind of a piece.
struct Cells {
  std::vector<double> connectivity, offsets;
};

class VtpFile {
 public:
  VtpFile(std::string_view text, Mesh& mesh, MeshNotes& notes) : text_(text), mesh_(mesh), notes_(notes) {}

  std::string read() {
    if (!looks_like_vtk() || !has_end() || !cut_out_appended() || !parse() || !read_head()) return problem_;
    for (const pugi::xml_node data : root().children("PolyData"))
      for (const pugi::xml_node piece : data.children("Piece")) {
        if (!read_section(piece, "Points") || !read_section(piece, "Polys") || !read_section(piece, "Strips"))
          return problem_;
        add_piece(piece);
        if (!problem_.empty()) return problem_;
      }
    cut_polygons(mesh_, fans_, notes_);
    return problem_;
  }

 private:
  bool fail(const std::string& why) {
    if (problem_.empty()) problem_ = why;
    return false;
  }

  pugi::xml_node root() const { return document_.child("VTKFile"); }

  /// Before its XML is parsed: a file of another kind gets no message about XML.
  bool looks_like_vtk() {
    return text_.find("<VTKFile") != std::string_view::npos ||
           fail("does not start as a VTK XML file: export it again");
  }

  bool has_end() {
    return text_.rfind("</VTKFile") != std::string_view::npos ||
           fail("has no \"</VTKFile>\" at its end: it is truncated; copy or export it again");
  }

  bool cut_out_appended() {
    xml_ = text_;
    const std::size_t tag = text_.find("<AppendedData");
    if (tag == std::string_view::npos) return true;
    const std::size_t after = text_.find('>', tag);
    const std::size_t begin = after == std::string_view::npos ? after : text_.find('_', after);
    if (begin == std::string_view::npos)
      return fail("has appended data without its \"_\": it is damaged; export it again");
    const std::size_t end = text_.rfind("</AppendedData");
    if (end == std::string_view::npos || end < begin) return fail("has appended data without an end: it is truncated");
    encoding_.appended = text_.substr(begin + 1, end - begin - 1);
    xml_.erase(begin, end - begin);
    appended_ = {begin, end - begin};
    return true;
  }

  bool parse() {
    // UTF-8 or ASCII: converted text would have other offsets.
    const pugi::xml_parse_result result =
        document_.load_buffer_inplace(xml_.data(), xml_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (result) return root() || fail("does not start as a VTK XML file: export it again");
    const std::size_t at = place_of(result.offset);
    const std::size_t line_begin = at == 0 ? 0 : text_.rfind('\n', at - 1) + 1;  // npos + 1 is 0
    return fail("is no whole XML: " + std::string(result.description()) + " (line " + std::to_string(line_of(at)) +
                ", column " + std::to_string(at - line_begin + 1) + "): it is damaged; copy or export it again");
  }

  /// Into the file, of a place in the XML without the appended data.
  std::size_t place_of(std::ptrdiff_t offset) const {
    auto at = static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0));
    if (appended_.size > 0 && at >= appended_.begin) at += appended_.size;
    return std::min(at, text_.size());
  }

  std::ptrdiff_t line_of(std::size_t at) const {
    return 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  }

  bool read_head() {
    const std::string type = root().attribute("type").as_string();
    if (type != "PolyData")
      return fail("is a VTK file of type " + in_quotes(type) + ", not PolyData: export a surface");
    const bool little = root().attribute("byte_order").as_string("LittleEndian") == std::string_view("LittleEndian");
    encoding_.swap = little != (std::endian::native == std::endian::little);
    encoding_.wide_header = root().attribute("header_type").as_string() == std::string_view("UInt64");
    const std::string compressor = root().attribute("compressor").as_string();
    encoding_.compressed = !compressor.empty();
    if (encoding_.compressed && compressor != "vtkZLibDataCompressor")
      return fail("is compressed by " + in_quotes(compressor) + "; genu reads zlib and what is not compressed");
    const pugi::xml_attribute appended = root().child("AppendedData").attribute("encoding");
    encoding_.appended_base64 = appended.as_string("base64") != std::string_view("raw");
    return true;
  }

  /// The arrays of <Points>, <Polys> or <Strips>.
  bool read_section(const pugi::xml_node& piece, const std::string& section) {
    for (const pugi::xml_node element : piece.children(section.c_str()))
      for (const pugi::xml_node array : element.children("DataArray"))
        if (std::vector<double>* out = target(section, array); out != nullptr && !read_array(array, *out)) return false;
    return true;
  }

  /// Where the numbers of an array go; null for one that means nothing here.
  std::vector<double>* target(const std::string& section, const pugi::xml_node& array) {
    if (section == "Points") return &points_;
    Cells& cells = section == "Polys" ? polygons_ : strips_;
    const std::string_view name = array.attribute("Name").as_string();
    return name == "connectivity" ? &cells.connectivity : name == "offsets" ? &cells.offsets : nullptr;
  }

  bool read_array(const pugi::xml_node& element, std::vector<double>& out) {
    VtpArray array;
    array.type = element.attribute("type").as_string();
    array.format = element.attribute("format").as_string("ascii");
    array.text = element.child_value();
    array.line = static_cast<std::size_t>(line_of(place_of(element.offset_debug())));
    const std::string offset = element.attribute("offset").as_string("0");
    if (!TextWords::number(std::string_view(offset), array.offset))
      return fail("has an array with the offset " + in_quotes(offset) + where(element));
    if (!of_components(element, &out == &points_ ? "3" : "1")) return false;
    const std::string problem = read_vtp_array(array, encoding_, out, notes_);
    return problem.empty() || fail(problem + where(element));
  }

  /// " (line 12)".
  std::string where(const pugi::xml_node& element) const {
    return " (line " + std::to_string(line_of(place_of(element.offset_debug()))) + ")";
  }

  bool of_components(const pugi::xml_node& element, const char* wanted) {
    const std::string found = element.attribute("NumberOfComponents").as_string(wanted);
    return found == wanted ||
           fail("has an array " + in_quotes(element.attribute("Name").as_string()) + " of " + in_quotes(found) +
                " components, not " + wanted + where(element) + ": it is damaged; export it again");
  }

  /// Does the piece have as many numbers as it says?
  bool promised(const pugi::xml_node& piece, const char* what, std::size_t numbers, std::size_t each) {
    const std::string count = piece.attribute(what).as_string("0");
    if (numbers % each == 0 && count == std::to_string(numbers / each)) return true;
    return fail("promises " + std::string(what) + " = " + in_quotes(count) + " but holds " +
                std::to_string(numbers / each) + ": it is damaged; export it again");
  }

  void add_piece(const pugi::xml_node& piece) {
    if (!promised(piece, "NumberOfPoints", points_.size(), 3)) return;
    if (!promised(piece, "NumberOfPolys", polygons_.offsets.size(), 1)) return;
    if (!promised(piece, "NumberOfStrips", strips_.offsets.size(), 1)) return;
    if (mesh_.vertices.size() + points_.size() / 3 > kMaxMeshCount)
      fail("has more points than can be counted: reduce the mesh");
    base_ = mesh_.vertices.size();
    for (std::size_t k = 0; problem_.empty() && k + 2 < points_.size(); k += 3)
      mesh_.vertices.emplace_back(points_[k], points_[k + 1], points_[k + 2]);
    add_cells(polygons_, false);
    add_cells(strips_, true);
    points_.clear();
    polygons_ = strips_ = {};
  }

  void add_cells(const Cells& cells, bool strips) {
    double begin = 0;
    for (const double end : cells.offsets) {
      if (!problem_.empty()) return;
      if (!(end >= begin && end <= static_cast<double>(cells.connectivity.size()))) {
        fail("has cells that name more corners than there are: it is damaged; export it again");
        return;
      }
      const auto first = static_cast<std::size_t>(begin), last = static_cast<std::size_t>(end);
      if (last < first + 3) notes_.add("cells of fewer than three corners", "they are left out");
      if (last >= first + 3) add_cell(cells.connectivity, first, last, strips);
      begin = end;
    }
  }

  void add_cell(const std::vector<double>& connectivity, std::size_t first, std::size_t last, bool strip) {
    corners_.clear();
    for (std::size_t k = first; k < last; ++k) corners_.push_back(corner(connectivity[k]));
    if (!problem_.empty()) return;
    if (!strip) return add_polygon(corners_, mesh_, fans_);
    for (std::size_t k = 0; k + 2 < corners_.size(); ++k) {
      const bool turned = k % 2 == 1;  // every other triangle of a strip runs the other way
      mesh_.triangles.push_back({corners_[k], corners_[turned ? k + 2 : k + 1], corners_[turned ? k + 1 : k + 2]});
    }
  }

  int corner(double v) {
    if (v >= 0 && v < static_cast<double>(mesh_.vertices.size() - base_) && v == std::floor(v))
      return static_cast<int>(base_ + static_cast<std::size_t>(v));
    fail("has a face that names a vertex it does not have: export it again");
    return 0;
  }

  /// What was cut out of text_ for xml_.
  struct Gap {
    std::size_t begin = 0, size = 0;
  };

  std::string_view text_;
  Mesh& mesh_;
  MeshNotes& notes_;
  std::vector<int> corners_;  ///< of a cell
  std::vector<Fan> fans_;
  std::string xml_;  ///< the document points into it
  Gap appended_;
  pugi::xml_document document_;
  VtpEncoding encoding_;
  std::size_t base_ = 0;
  std::string problem_;
  std::vector<double> points_;
  Cells polygons_, strips_;
};

}  // namespace

std::string read_vtp(std::string_view bytes, Mesh& mesh, MeshNotes& notes) {
  return VtpFile(bytes, mesh, notes).read();
}

}  // namespace genu
