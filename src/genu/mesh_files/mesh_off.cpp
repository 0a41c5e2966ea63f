#include "genu/mesh_files/mesh_formats.h"
#include "genu/mesh_files/text_words.h"
#include "genu/mesh_files/tolerances.h"

namespace genu {
namespace {

class OffFile {
 public:
  OffFile(std::string_view text, Mesh& mesh) : words_(text, '#'), mesh_(mesh) {}

  std::string read() {
    std::size_t vertices = 0, faces = 0, edges = 0;
    if (!read_head(vertices, faces, edges)) return problem_;
    for (std::size_t v = 0; v < vertices && problem_.empty(); ++v) {
      Vec3 p;
      for (int k = 0; k < 3; ++k) read_coordinate(p[k]);
      double more = 0;  // a normal, a colour or a texture coordinate
      for (std::size_t k = 0; k < beside_; ++k) read(more);
      mesh_.vertices.push_back(p);
    }
    for (std::size_t f = 0; f < faces && problem_.empty(); ++f) read_face(static_cast<int>(vertices));
    if (problem_.empty() && !words_.peek().empty()) found(words_.next(), "the end");
    return problem_;
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
    if (!problem_.empty()) return false;
    const std::string_view word = words_.next();
    if (!TextWords::number(word, value)) found(word, "a number");
    return problem_.empty();
  }

  void read_coordinate(double& value) {
    if (!problem_.empty()) return;
    const std::string_view word = words_.next();
    if (!TextWords::number(word, value))
      found(word, "a number");
    else if (!is_coordinate(value))
      found(word, kCoordinate);
  }

  bool read_head(std::size_t& vertices, std::size_t& faces, std::size_t& edges) {
    std::string_view word = words_.next();
    if (word.size() < 3 || word.substr(word.size() - 3) != "OFF") {
      found(word, "\"OFF\"");
      return false;
    }
    for (const char c : word.substr(0, word.size() - 3)) {
      if (c == 'N') beside_ += 3;
      if (c == 'C') beside_ += 4;
      if (c != 'N' && c != 'C') found(word, "\"OFF\", \"NOFF\" or \"COFF\"");
    }
    if (words_.peek() == "BINARY") found(words_.next(), "the count of vertices (binary OFF is not read)");
    for (std::size_t* count : {&vertices, &faces, &edges}) {
      word = words_.next();
      if (!TextWords::number(word, *count) || *count > kMaxMeshCount)
        found(word, "a count from 0 to " + std::to_string(kMaxMeshCount));
    }
    return problem_.empty();
  }

  void read_face(int vertices) {
    int corners = 0;
    if (!read(corners)) return;
    std::array<int, 3> t{};
    for (int k = 0; k < corners && problem_.empty(); ++k) {
      int v = 0;
      if (!read(v)) return;
      if (v < 0 || v >= vertices) {
        problem_ = "has a face in line " + std::to_string(words_.line()) +
                   " that names a vertex it does not have: export it again";
        return;
      }
      if (k == 0) t[0] = v;
      t[1] = t[2];
      t[2] = v;
      if (k >= 2) mesh_.triangles.push_back(t);
    }
    // A colour may follow: the rest of the line.
    words_.skip_line();
  }

  TextWords words_;
  Mesh& mesh_;
  std::size_t beside_ = 0;
  std::string problem_;
};

}  // namespace

std::string read_off(std::string_view bytes, Mesh& mesh) { return OffFile(bytes, mesh).read(); }

}  // namespace genu
