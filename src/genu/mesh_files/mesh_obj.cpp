#include <vector>

#include "genu/mesh_files/mesh_formats.h"
#include "genu/mesh_files/text_words.h"
#include "genu/mesh_files/tolerances.h"

namespace genu {
namespace {

class ObjFile {
 public:
  ObjFile(std::string_view text, Mesh& mesh) : words_(text, '#'), mesh_(mesh) {}

  std::string read() {
    for (std::string_view word = words_.next(); !word.empty() && problem_.empty(); word = words_.next()) {
      if (word == "v") read_vertex();
      if (word == "f") read_face();
      words_.skip_line();
    }
    // A face may name vertices that come after it: only now is known whether they do.
    if (problem_.empty() && highest_ >= static_cast<int>(mesh_.vertices.size()))
      fail(highest_line_,
           "names vertex " + std::to_string(highest_ + 1) + " of " + std::to_string(mesh_.vertices.size()));
    return problem_;
  }

 private:
  void fail(std::size_t line, const std::string& why) {
    if (problem_.empty()) problem_ = "in line " + std::to_string(line) + " " + why + ": it is damaged; export it again";
  }
  void fail(const std::string& why) { fail(words_.line(), why); }

  /// x y z, then a weight of 1 or a colour of three numbers.
  void read_vertex() {
    std::vector<double> values;
    for (std::string_view word = words_.next_in_line(); !word.empty(); word = words_.next_in_line()) {
      double x = 0;
      if (!TextWords::number(word, x)) return fail("has " + in_quotes(word) + " where a number should stand");
      if (values.size() < 3 && !is_coordinate(x))
        return fail("has " + in_quotes(word) + " where " + kCoordinate + " should stand");
      values.push_back(x);
    }
    if (values.size() < 3) return fail("has fewer than three numbers");
    if (values.size() == 4 && values[3] != 1) return fail("has a vertex with a weight other than 1");
    if (mesh_.vertices.size() >= kMaxMeshCount) return fail("has more vertices than can be counted");
    mesh_.vertices.emplace_back(values[0], values[1], values[2]);
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
    std::array<int, 3> t{};
    int corners = 0;
    for (std::string_view word = words_.next_in_line(); !word.empty(); word = words_.next_in_line(), ++corners) {
      const int v = corner(word);
      if (v < 0) return;
      if (corners == 0) t[0] = v;
      t[1] = t[2];
      t[2] = v;
      if (corners >= 2) mesh_.triangles.push_back(t);
    }
    if (corners < 3) fail("has a face of fewer than three corners");
  }

  TextWords words_;
  Mesh& mesh_;
  int highest_ = -1;  ///< vertex that a face names
  std::size_t highest_line_ = 0;
  std::string problem_;
};

}  // namespace

std::string read_obj(std::string_view bytes, Mesh& mesh) { return ObjFile(bytes, mesh).read(); }

}  // namespace genu
