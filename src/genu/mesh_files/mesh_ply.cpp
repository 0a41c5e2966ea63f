#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "genu/mesh_files/mesh_formats.h"
#include "genu/mesh_files/ply_header.h"
#include "genu/mesh_files/text_words.h"
#include "genu/mesh_files/tolerances.h"

namespace genu {
namespace {

constexpr const char* kShort = "holds less than its header promises: it is truncated; copy or export it again";
const std::string kNoVertex = "has a face that names a vertex it does not have";

/// The numbers behind the header, one after the other.
class Body {
 public:
  Body(std::string_view text, const PlyHeader& header, MeshNotes& notes)
      : words_(text, 0, header.lines + 1),
        bytes_(text),
        ascii_(header.ascii),
        swap_(header.big_endian != (std::endian::native == std::endian::big)),
        notes_(notes) {}

  /// False at a wrong one; problem() then says why.
  bool next(PlyType type, double& value) { return ascii_ ? next_word(value) : next_bytes(type, value); }

  /// Before and after the numbers of one vertex or face, which have a line of their own in ASCII.
  void begin() { fresh_ = true; }
  void end() {
    if (!ascii_ || words_.next_in_line().empty()) return;
    notes_.add("more numbers than its header declares", "what follows those is left out", line());
    words_.skip_line();
  }

  /// After all that the header promises.
  void finish() {
    if (ascii_)
      words_.note_end(notes_);
    else if (at_ < bytes_.size())
      notes_.add(std::to_string(bytes_.size() - at_) + " bytes after all that its header promises",
                 "they are left out");
  }

  /// Of the file, where that is text.
  std::size_t line() const { return words_.line(); }
  const std::string& problem() const { return problem_; }

 private:
  bool fail(const std::string& why) {
    problem_ = why;
    return false;
  }

  std::string place() const { return " in line " + std::to_string(line()); }

  bool next_word(double& value) {
    const std::string_view word = fresh_ ? words_.next() : words_.next_in_line();
    if (word.empty() && fresh_) return fail(kShort);
    fresh_ = false;
    if (word.empty())
      return fail(words_.rest().empty() ? kShort
                                        : "has too few numbers" + place() + ": it is damaged; export it again");
    if (words_.decimal(word, value, notes_)) return true;
    return fail("has " + in_quotes(word) + place() + " where a number should stand: it is damaged; export it again");
  }

  template <class T>
  double number() {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes_.data() + at_, sizeof(T));
    if (swap_) std::reverse(raw.begin(), raw.end());
    at_ += sizeof(T);
    return static_cast<double>(std::bit_cast<T>(raw));
  }

  bool next_bytes(PlyType type, double& value) {
    if (bytes_.size() - at_ < size_of(type)) return fail(kShort);
    switch (type) {
      case PlyType::int8:
        return value = number<std::int8_t>(), true;
      case PlyType::uint8:
        return value = number<std::uint8_t>(), true;
      case PlyType::int16:
        return value = number<std::int16_t>(), true;
      case PlyType::uint16:
        return value = number<std::uint16_t>(), true;
      case PlyType::int32:
        return value = number<std::int32_t>(), true;
      case PlyType::uint32:
        return value = number<std::uint32_t>(), true;
      case PlyType::float32:
        return value = number<float>(), true;
      case PlyType::float64:
        return value = number<double>(), true;
    }
    return false;
  }

  TextWords words_;
  std::string_view bytes_;
  bool ascii_, swap_, fresh_ = true;
  MeshNotes& notes_;
  std::size_t at_ = 0;
  std::string problem_;
};

class PlyFile {
 public:
  PlyFile(std::string_view text, const PlyHeader& header, Mesh& mesh, MeshNotes& notes)
      : header_(header), body_(text.substr(header.size), header, notes), mesh_(mesh), notes_(notes) {}

  std::string read() {
    for (const PlyElement& element : header_.elements) {
      const bool vertex = element.name == "vertex", face = element.name == "face", strip = element.name == "tristrips";
      corners_ = -1;
      if (!(vertex ? find_coordinates(element) : !(face || strip) || find_corners(element))) return problem_;
      for (std::size_t k = 0; k < element.count && problem_.empty(); ++k) {
        number_ = k + 1;
        if (!read_entry(element)) return problem_.empty() ? body_.problem() : problem_;
        if (vertex) add_vertex(element);
        if (face) add_face();
        if (strip) add_strips();
      }
    }
    if (problem_.empty()) check_corners();
    if (!problem_.empty()) return problem_;
    cut_polygons(mesh_, fans_, notes_);
    body_.finish();
    return {};
  }

 private:
  bool fail(const std::string& why) {
    if (problem_.empty()) problem_ = why;
    return false;
  }

  bool find_coordinates(const PlyElement& element) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string name(1, "xyz"[k]);
      coordinate_[k] = element.index(name);
      if (coordinate_[k] < 0 || element.properties[static_cast<std::size_t>(coordinate_[k])].list)
        return fail("has vertices without the property \"" + name + "\" in its header: export it again");
    }
    return true;
  }

  bool find_corners(const PlyElement& element) {
    corners_ = std::max(element.index("vertex_indices"), element.index("vertex_index"));
    if (corners_ >= 0 && element.properties[static_cast<std::size_t>(corners_)].list) return true;
    return fail("has an element " + in_quotes(element.name) + " without a list \"vertex_indices\": export it again");
  }

  /// The numbers of one vertex or face: scalars into values_, a face's corners into list_.
  bool read_entry(const PlyElement& element) {
    values_.assign(element.properties.size(), 0.0);
    list_.clear();
    body_.begin();
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& p = element.properties[k];
      if (!p.list) {
        if (!body_.next(p.type, values_[k])) return false;
        continue;
      }
      double count = 0;
      if (!body_.next(p.count_type, count)) return false;
      if (!(count >= 0)) return fail("has a list of fewer than no entries" + place(element.name));
      for (double i = 0; i < count; ++i) {
        double value = 0;
        if (!body_.next(p.type, value)) return false;
        if (static_cast<int>(k) == corners_) list_.push_back(value);
      }
    }
    body_.end();
    return true;
  }

  std::string place(const std::string& what, std::size_t line, std::size_t number) const {
    return (header_.ascii ? " in line " + std::to_string(line) : " (" + what + " " + std::to_string(number) + ")") +
           ": it is damaged; export it again";
  }
  std::string place(const std::string& what) const { return place(what, body_.line(), number_); }

  void add_vertex(const PlyElement& element) {
    Vec3 p;
    for (int k = 0; k < 3; ++k) {
      p[k] = values_[static_cast<std::size_t>(coordinate_[static_cast<std::size_t>(k)])];
      if (!is_coordinate(p[k])) fail("has a vertex without " + std::string(kCoordinate) + place(element.name));
    }
    mesh_.vertices.push_back(p);
  }

  /// The vertex that a number names; the vertices may come after the faces.
  int corner(double value) {
    if (value >= 0 && value < static_cast<double>(kMaxMeshCount) && value == std::floor(value)) {
      if (value > highest_) highest_ = value, highest_line_ = body_.line(), highest_number_ = number_;
      return static_cast<int>(value);
    }
    fail(kNoVertex + place("face"));
    return 0;
  }

  void check_corners() {
    if (highest_ >= static_cast<double>(mesh_.vertices.size()))
      fail(kNoVertex + place("face", highest_line_, highest_number_));
  }

  void add_face() {
    if (list_.size() < 3) fail("has a face of fewer than three corners" + place("face"));
    polygon_.clear();
    for (const double number : list_) polygon_.push_back(corner(number));
    if (problem_.empty()) add_polygon(polygon_, mesh_, fans_);
  }

  /// Strips end with -1; every other triangle of one runs the other way.
  void add_strips() {
    std::size_t first = 0;
    for (std::size_t k = 0; k < list_.size() && problem_.empty(); ++k) {
      if (list_[k] == -1) {
        first = k + 1;
      } else if (k >= first + 2) {
        const bool turned = (k - first) % 2 == 1;
        const int a = corner(list_[k - 2]), b = corner(list_[k - 1]), c = corner(list_[k]);
        mesh_.triangles.push_back({a, turned ? c : b, turned ? b : c});
      }
    }
  }

  const PlyHeader& header_;
  Body body_;
  Mesh& mesh_;
  MeshNotes& notes_;
  std::vector<int> polygon_;  ///< corners of a face
  std::vector<Fan> fans_;
  std::array<int, 3> coordinate_{};
  int corners_ = -1;
  std::vector<double> values_, list_;
  std::size_t number_ = 0;
  double highest_ = -1;  ///< corner, and where that stands
  std::size_t highest_line_ = 0, highest_number_ = 0;
  std::string problem_;
};

}  // namespace

std::string read_ply(std::string_view bytes, Mesh& mesh, MeshNotes& notes) {
  PlyHeader header;
  if (std::string problem = read_ply_header(bytes, header); !problem.empty()) return problem;
  return PlyFile(bytes, header, mesh, notes).read();
}

}  // namespace genu
