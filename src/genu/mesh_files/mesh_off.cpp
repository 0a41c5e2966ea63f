#include <algorithm>
#include <vector>

#include "genu/mesh_files/mesh_formats.h"
#include "genu/mesh_files/text_words.h"
#include "genu/mesh_files/tolerances.h"

namespace genu {
namespace {

class OffFile {
 public:
  OffFile(std::string_view text, Mesh& mesh, MeshNotes& notes) : words_(text, '#'), mesh_(mesh), notes_(notes) {}

  std::string read() {
    std::size_t vertices = 0, faces = 0, edges = 0;
    if (!read_head(vertices, faces, edges)) return problem_;
    in_lines_ = has_lines(vertices + faces);
    for (std::size_t v = 0; v < vertices && problem_.empty(); ++v) read_vertex();
    for (std::size_t f = 0; f < faces && problem_.empty(); ++f) read_face(static_cast<int>(vertices));
    if (!problem_.empty()) return problem_;
    cut_polygons(mesh_, fans_, notes_);
    words_.note_end(notes_);
    return {};
  }

 private:
  void found(std::string_view word, const std::string& wanted) {
    if (!problem_.empty()) return;
    problem_ = word.empty() ? "ends where " + wanted + " should stand: it is truncated; copy or export it again"
                            : "has " + in_quotes(word) + " in line " + std::to_string(words_.line()) + " where " +
                                  wanted + " should stand: it is damaged or no ASCII OFF; export it again";
  }

  template <class T>
  bool read(T& value) {
    const std::string_view word = words_.next();
    if (!TextWords::number(word, value)) found(word, "a number");
    return problem_.empty();
  }

  double read_coordinate() {
    double value = 0;
    const std::string_view word = words_.next();
    if (!words_.decimal(word, value, notes_))
      found(word, "a number");
    else if (!is_coordinate(value))
      found(word, kCoordinate);
    return value;
  }

  /// [ST][C][N][4]OFF: texture coordinates (2 numbers), a colour (4), a normal (3), and a fourth coordinate by which
  /// the others are divided.
  bool read_keyword() {
    const std::string_view word = words_.next();
    std::string_view prefix = word.substr(0, word.size() - std::min<std::size_t>(word.size(), 3));
    if (word.size() < 3 || word.substr(prefix.size()) != "OFF") return found(word, "\"OFF\""), false;
    const auto take = [&](std::string_view letter, std::size_t numbers) {
      if (!prefix.starts_with(letter)) return false;
      prefix.remove_prefix(letter.size());
      beside_ += numbers;
      return true;
    };
    while (take("ST", 2) || take("C", 4) || take("N", 3)) {
    }
    divided_ = take("4", 0);
    if (!prefix.empty()) found(word, "\"OFF\" with no other prefixes than ST, C, N and 4");
    return problem_.empty();
  }

  bool read_head(std::size_t& vertices, std::size_t& faces, std::size_t& edges) {
    if (!read_keyword()) return false;
    if (words_.peek() == "BINARY") found(words_.next(), "the count of vertices (binary OFF is not read)");
    for (std::size_t* count : {&vertices, &faces, &edges}) {
      const std::string_view word = words_.next();
      if (!TextWords::number(word, *count) || *count > kMaxMeshCount)
        found(word, "a count from 0 to " + std::to_string(kMaxMeshCount));
    }
    return problem_.empty();
  }

  /// Whether each vertex and face has a line of its own: then its end tells where a colour ends. A file may also be one
  /// long line.
  bool has_lines(std::size_t wanted) const {
    TextWords ahead = words_;
    ahead.skip_line();
    for (std::size_t lines = 0; lines < wanted; ++lines, ahead.skip_line())
      if (ahead.next().empty()) return false;
    return true;
  }

  void read_vertex() {
    Vec3 p;
    for (int k = 0; k < 3 && problem_.empty(); ++k) p[k] = read_coordinate();
    if (divided_ && problem_.empty()) p = divided(p);
    mesh_.vertices.push_back(p);
    pass_beside();
  }

  /// To the next vertex.
  void pass_beside() {
    if (in_lines_ && !words_.next_in_line().empty()) {
      if (beside_ == 0)
        notes_.add("more than three numbers for a vertex under the keyword OFF (colours are COFF, normals NOFF)",
                   "what follows the third is left out", words_.line());
      words_.skip_line();
    } else {
      for (std::size_t k = 0; k < beside_; ++k) words_.next();
    }
  }

  Vec3 divided(const Vec3& p) {
    const double weight = read_coordinate();
    const Vec3 x = p / weight;
    if (problem_.empty() && !(is_coordinate(x.x()) && is_coordinate(x.y()) && is_coordinate(x.z())))
      found(std::to_string(weight), "a number by which the other three can be divided");
    return x;
  }

  void read_face(int vertices) {
    int corners = 0;
    if (!read(corners)) return;
    corners_.clear();
    for (int k = 0, v = 0; k < corners; ++k) {
      if (!read(v)) return;
      if (v < 0 || v >= vertices) {
        problem_ = "has a face in line " + std::to_string(words_.line()) +
                   " that names a vertex it does not have: export it again";
        return;
      }
      corners_.push_back(v);
    }
    if (corners < 3)
      notes_.add("a face of fewer than three corners", "such faces are left out", words_.line());
    else
      add_polygon(corners_, mesh_, fans_);
    if (in_lines_) words_.skip_line();  // a colour may follow
  }

  TextWords words_;
  Mesh& mesh_;
  MeshNotes& notes_;
  std::vector<int> corners_;  ///< of a face
  std::vector<Fan> fans_;
  std::size_t beside_ = 0;  ///< numbers of a vertex besides its coordinates
  bool divided_ = false, in_lines_ = false;
  std::string problem_;
};

}  // namespace

std::string read_off(std::string_view bytes, Mesh& mesh, MeshNotes& notes) {
  return OffFile(bytes, mesh, notes).read();
}

}  // namespace genu
