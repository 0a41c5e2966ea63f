#include <algorithm>
#include <array>
#include <vector>

#include "genu/mesh_files/mesh_formats.h"
#include "genu/mesh_files/text_words.h"
#include "genu/mesh_files/tolerances.h"

namespace genu {
namespace {

/// What a line may begin with that says nothing of the surface.
constexpr std::array<std::string_view, 15> kPassedOver{
    "vt", "vn", "vp", "p", "l", "g", "o", "s", "usemtl", "mtllib", "mg", "lod", "bevel", "shadow_obj", "trace_obj"};

class ObjFile {
 public:
  ObjFile(std::string_view text, Mesh& mesh, MeshNotes& notes) : words_(text, '#'), mesh_(mesh), notes_(notes) {}

  std::string read() {
    for (std::string_view word = words_.next(); !word.empty() && problem_.empty(); word = words_.next()) {
      if (word == "v")
        read_vertex();
      else if (word == "f")
        read_face();
      else if (std::find(kPassedOver.begin(), kPassedOver.end(), word) == kPassedOver.end())
        note_unknown(word);
      words_.skip_line();
    }
    // A face may name vertices that come after it: only now is known whether they do.
    if (problem_.empty() && highest_ >= static_cast<int>(mesh_.vertices.size()))
      fail(highest_line_,
           "names vertex " + std::to_string(highest_ + 1) + " of " + std::to_string(mesh_.vertices.size()));
    if (!problem_.empty()) return problem_;
    cut_polygons(mesh_, fans_, notes_);
    words_.note_end(notes_);
    return {};
  }

 private:
  void fail(std::size_t line, const std::string& why) {
    if (problem_.empty()) problem_ = "in line " + std::to_string(line) + " " + why + ": it is damaged; export it again";
  }
  void fail(const std::string& why) { fail(words_.line(), why); }

  void note_unknown(std::string_view word) {
    if (unknown_.empty()) unknown_ = in_quotes(word);
    notes_.add("a line that begins with " + unknown_, "lines that OBJ does not know are left out", words_.line());
  }

  /// x y z, then a weight of 1 or a colour of three numbers.
  void read_vertex() {
    Vec3 p;
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = words_.next_in_line();
      if (word.empty()) return fail("has fewer than three numbers");
      if (!words_.decimal(word, p[k], notes_)) return fail("has " + in_quotes(word) + " where a number should stand");
      if (!is_coordinate(p[k])) return fail("has " + in_quotes(word) + " where " + kCoordinate + " should stand");
    }
    const std::string_view fourth = words_.next_in_line();
    double weight = 1;
    if (!fourth.empty() && words_.next_in_line().empty() && !(words_.decimal(fourth, weight, notes_) && weight == 1))
      return fail("has a vertex with a weight other than 1");
    if (mesh_.vertices.size() >= kMaxMeshCount) return fail("has more vertices than can be counted");
    mesh_.vertices.push_back(p);
  }

  /// The vertex that a corner such as "7", "7/1/2" or "-1" names, counted from 0; negative where there is none.
  int corner(std::string_view word) {
    int number = 0;
    if (!TextWords::number(word.substr(0, word.find('/')), number)) {
      fail("has " + in_quotes(word) + " where the number of a vertex should stand");
      return -1;
    }
    const auto count = static_cast<int>(mesh_.vertices.size());
    const int index = number > 0 ? number - 1 : count + number;
    if (number == 0 || index < 0) {
      fail("names vertex " + std::to_string(number) + ": they count from 1, or back from -1 to -" +
           std::to_string(count));
      return -1;
    }
    if (index > highest_) highest_ = index, highest_line_ = words_.line();
    return index;
  }

  void read_face() {
    corners_.clear();
    for (std::string_view word = words_.next_in_line(); !word.empty(); word = words_.next_in_line()) {
      corners_.push_back(corner(word));
      if (corners_.back() < 0) return;
    }
    if (corners_.size() < 3) return fail("has a face of fewer than three corners");
    add_polygon(corners_, mesh_, fans_);
  }

  TextWords words_;
  Mesh& mesh_;
  MeshNotes& notes_;
  std::string unknown_;       ///< the first word that begins a line and is none of OBJ's
  std::vector<int> corners_;  ///< of a face
  std::vector<Fan> fans_;
  int highest_ = -1;  ///< vertex that a face names
  std::size_t highest_line_ = 0;
  std::string problem_;
};

}  // namespace

std::string read_obj(std::string_view bytes, Mesh& mesh, MeshNotes& notes) {
  return ObjFile(bytes, mesh, notes).read();
}

}  // namespace genu
