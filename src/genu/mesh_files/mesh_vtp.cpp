#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>

#include "genu/mesh_files/mesh_formats.h"
#include "genu/mesh_files/text_words.h"
#include "genu/mesh_files/tolerances.h"
#include "genu/mesh_files/vtp_arrays.h"

namespace genu {
namespace {

using Attributes = std::map<std::string, std::string>;

struct Tag {
  std::string name;  ///< "/Piece" where it closes
  Attributes attributes;
  std::size_t after = 0;  ///< of the text
  bool empty = false;     ///< <.../>
};

/// The next tag from `at`; empty where there is none, or none that ends.
std::optional<Tag> next_tag(std::string_view text, std::size_t at) {
  Tag tag;
  do {
    at = text.find('<', at);
    if (at == std::string_view::npos) return std::nullopt;
    const std::size_t name = ++at;
    while (at < text.size() && text[at] != '>' && text[at] != ' ' && text[at] != '\n' && text[at] != '\t' &&
           text[at] != '\r' && (text[at] != '/' || at == name))
      ++at;
    tag.name = text.substr(name, at - name);
  } while (tag.name.starts_with("?") || tag.name.starts_with("!"));
  while (at < text.size() && text[at] != '>') {
    if (text[at] == '/') tag.empty = true;
    const std::size_t equals = text.find_first_of("=>/", at);
    if (equals == std::string_view::npos) return std::nullopt;
    if (text[equals] != '=') {
      at = std::max(equals, at + (text[at] == '/' ? 1 : 0));
      continue;
    }
    std::string_view key = text.substr(at, equals - at);
    key = key.substr(std::min(key.find_first_not_of(" \t\r\n"), key.size()));
    key = key.substr(0, key.find_last_not_of(" \t\r\n") + 1);
    const std::size_t open = text.find_first_of("\"'", equals);
    const std::size_t close = open == std::string_view::npos ? open : text.find(text[open], open + 1);
    if (close == std::string_view::npos) return std::nullopt;
    tag.attributes[std::string(key)] = text.substr(open + 1, close - open - 1);
    at = close + 1;
  }
  if (at >= text.size()) return std::nullopt;
  tag.after = at + 1;
  return tag;
}

std::string value(const Attributes& attributes, const std::string& key, const std::string& otherwise = {}) {
  const auto it = attributes.find(key);
  return it == attributes.end() ? otherwise : it->second;
}

/// The cells of one kind of a piece.
struct Cells {
  std::vector<double> connectivity, offsets;
};

class VtpFile {
 public:
  VtpFile(std::string_view text, Mesh& mesh) : text_(text), mesh_(mesh) {}

  std::string read() {
    if (!read_head()) return problem_;
    std::size_t at = body_;
    while (problem_.empty()) {
      const auto tag = next_tag(text_, at);
      if (!tag) return "is XML that breaks off: it is truncated; copy or export it again";
      at = tag->after;
      if (tag->name == "AppendedData" || tag->name == "/VTKFile") return problem_;
      if (tag->name == "DataArray" && !tag->empty)
        at = read_array(*tag);
      else if (tag->name == "DataArray")
        read_array(*tag);
      else if (tag->name == "Piece")
        piece_ = tag->attributes;
      else if (tag->name == "/Piece")
        add_piece();
      else if (tag->name == "Points" || tag->name == "Polys" || tag->name == "Strips")
        section_ = tag->empty ? "" : tag->name;
      else if (tag->name == "/" + section_)
        section_.clear();
    }
    return problem_;
  }

 private:
  bool fail(const std::string& why) {
    if (problem_.empty()) problem_ = why;
    return false;
  }

  bool read_head() {
    std::optional<Tag> tag = next_tag(text_, 0);
    if (!tag || tag->name != "VTKFile") return fail("does not start as a VTK XML file: export it again");
    if (value(tag->attributes, "type") != "PolyData")
      return fail("is a VTK file of type " + in_quotes(value(tag->attributes, "type")) +
                  ", not PolyData: export a surface");
    const bool little = value(tag->attributes, "byte_order", "LittleEndian") == "LittleEndian";
    encoding_.swap = little != (std::endian::native == std::endian::little);
    encoding_.wide_header = value(tag->attributes, "header_type", "UInt32") == "UInt64";
    const std::string compressor = value(tag->attributes, "compressor");
    encoding_.compressed = !compressor.empty();
    if (encoding_.compressed && compressor != "vtkZLibDataCompressor")
      return fail("is compressed by " + in_quotes(compressor) + "; genu reads zlib and what is not compressed");
    body_ = tag->after;
    if (text_.find("</VTKFile", text_.size() < 200 ? 0 : text_.size() - 200) == std::string_view::npos)
      return fail("has no \"</VTKFile>\" at its end: it is truncated; copy or export it again");
    const std::size_t appended = text_.find("<AppendedData");
    if (appended == std::string_view::npos) return true;
    tag = next_tag(text_, appended);
    const std::size_t begin = tag ? text_.find('_', tag->after) : std::string_view::npos;
    if (begin == std::string_view::npos)
      return fail("has appended data without its \"_\": it is damaged; export it again");
    const std::size_t end = text_.rfind("</AppendedData");
    if (end == std::string_view::npos || end < begin) return fail("has appended data without an end: it is truncated");
    encoding_.appended_base64 = value(tag->attributes, "encoding", "base64") != "raw";
    encoding_.appended = text_.substr(begin + 1, end - begin - 1);
    return true;
  }

  /// Returns where to go on.
  std::size_t read_array(const Tag& tag) {
    VtpArray array;
    array.type = value(tag.attributes, "type");
    array.format = value(tag.attributes, "format", "ascii");
    const std::string offset = value(tag.attributes, "offset", "0");
    if (!TextWords::number(std::string_view(offset), array.offset))
      fail("has an array with the offset " + in_quotes(offset));
    std::size_t end = tag.after;
    if (!tag.empty) {
      end = text_.find("</DataArray", tag.after);
      if (end == std::string_view::npos) fail("has an array without an end: it is truncated; copy or export it again");
      end = std::min(end, text_.size());
      array.text = text_.substr(tag.after, end - tag.after);
    }
    const std::string name = value(tag.attributes, "Name");
    std::vector<double>* out = nullptr;
    Cells& cells = section_ == "Polys" ? polygons_ : strips_;
    if (section_ == "Points")
      out = &points_;
    else if (!section_.empty() && name == "connectivity")
      out = &cells.connectivity;
    else if (!section_.empty() && name == "offsets")
      out = &cells.offsets;
    if (out == nullptr || !problem_.empty() || !of_components(tag, out == &points_ ? "3" : "1")) return end;
    if (std::string problem = read_vtp_array(array, encoding_, *out); !problem.empty()) fail(problem + where(tag));
    return end;
  }

  /// " (line 12)", where a tag ends.
  std::string where(const Tag& tag) const {
    return " (line " + std::to_string(1 + std::count(text_.begin(), text_.begin() + tag.after, '\n')) + ")";
  }

  bool of_components(const Tag& tag, const char* wanted) {
    const std::string found = value(tag.attributes, "NumberOfComponents", wanted);
    return found == wanted ||
           fail("has an array " + in_quotes(value(tag.attributes, "Name")) + " of " + in_quotes(found) +
                " components, not " + wanted + where(tag) + ": it is damaged; export it again");
  }

  /// Does the piece have as many numbers as it says?
  bool promised(const char* what, std::size_t numbers, std::size_t each) {
    const std::string count = value(piece_, what, "0");
    if (numbers % each == 0 && count == std::to_string(numbers / each)) return true;
    return fail("promises " + std::string(what) + " = " + in_quotes(count) + " but holds " +
                std::to_string(numbers / each) + ": it is damaged; export it again");
  }

  void add_piece() {
    if (!promised("NumberOfPoints", points_.size(), 3)) return;
    if (!promised("NumberOfPolys", polygons_.offsets.size(), 1)) return;
    if (!promised("NumberOfStrips", strips_.offsets.size(), 1)) return;
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
      for (std::size_t k = first; k + 2 < last; ++k) {
        const std::size_t a = strips ? k : first;
        const bool turned = strips && (k - first) % 2 == 1;  // every other triangle of a strip runs the other way
        add_triangle(cells.connectivity, a, turned ? k + 2 : k + 1, turned ? k + 1 : k + 2);
      }
      begin = end;
    }
  }

  void add_triangle(const std::vector<double>& corners, std::size_t a, std::size_t b, std::size_t c) {
    std::array<int, 3> t{};
    for (std::size_t k = 0; const std::size_t i : {a, b, c}) {
      const double v = corners[i];
      if (!(v >= 0 && v < static_cast<double>(mesh_.vertices.size() - base_) && v == std::floor(v))) {
        fail("has a face that names a vertex it does not have: export it again");
        return;
      }
      t[k++] = static_cast<int>(base_ + static_cast<std::size_t>(v));
    }
    mesh_.triangles.push_back(t);
  }

  std::string_view text_;
  Mesh& mesh_;
  VtpEncoding encoding_;
  std::size_t body_ = 0, base_ = 0;
  std::string section_, problem_;
  Attributes piece_;
  std::vector<double> points_;
  Cells polygons_, strips_;
};

}  // namespace

std::string read_vtp(const std::string& path, Mesh& mesh) {
  const auto text = bytes_of(path);
  return text ? VtpFile(*text, mesh).read() : kCannotOpen;
}

}  // namespace genu
