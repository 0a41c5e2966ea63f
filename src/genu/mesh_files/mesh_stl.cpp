#include <algorithm>

#include "genu/mesh_files/mesh_formats.h"
#include "genu/mesh_files/stl_binary.h"
#include "genu/mesh_files/text_words.h"
#include "genu/mesh_files/tolerances.h"

namespace genu {
namespace {

/// Of an ASCII letter. std::tolower asks for the locale each time: a fifth of reading.
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c; }

bool same(std::string_view word, std::string_view wanted) {
  return std::equal(word.begin(), word.end(), wanted.begin(), wanted.end(),
                    [](char a, char b) { return lower(a) == b; });
}

/// `wanted` in small letters.
bool has(std::string_view text, std::string_view wanted) {
  return std::search(text.begin(), text.end(), wanted.begin(), wanted.end(),
                     [](char a, char b) { return lower(a) == b; }) != text.end();
}

/// Surely no word of the format: a number has digits, signs and exponents only.
bool is_numeric(std::string_view word) {
  return std::all_of(word.begin(), word.end(), [](char c) {
    return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e' || c == 'E';
  });
}

/// Whether hardly any byte is one that text does not have. Of binary triangles, at least one byte in 25 is 0.
bool is_text(std::string_view bytes) {
  const auto control = std::count_if(bytes.begin(), bytes.end(), [](char c) {
    return static_cast<unsigned char>(c) < ' ' && !(c >= '\t' && c <= '\r');
  });
  return static_cast<double>(control) <= kMaxControlShare * static_cast<double>(bytes.size());
}

// ASCII STL starts with "solid", but so do some binary ones: the body decides. Titles may be long.
bool is_ascii_stl(std::string_view bytes) {
  constexpr std::size_t kTitleBytes = 80;
  const std::string_view text = without_mark(bytes.substr(0, kBytesSearched));
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || !same(text.substr(first, 5), "solid")) return false;
  return is_text(text.substr(std::min(kTitleBytes, text.size()))) &&
         (has(text, "vertex") || has(text, "facet") || has(text, "endsolid") || has(text, "end solid"));
}

/// Reads an ASCII STL word by word, so that whatever is not one is named with its line.
class AsciiStl {
 public:
  AsciiStl(std::string_view text, Mesh& mesh, MeshNotes& notes) : words_(text), mesh_(mesh), notes_(notes) {}

  std::string read() {
    if (!expect("solid")) return problem_;
    words_.skip_line();  // the name may be anything
    for (std::string_view word = words_.next(); problem_.empty(); word = words_.next()) {
      if (same(word, "facet")) {
        read_facet();
      } else if (same(word, "solid")) {
        words_.skip_line();  // several solids are one surface, and one may be announced twice
      } else if (is_end(word, "solid")) {
        words_.skip_line();
        if (is_last()) return {};
      } else {
        found(word, "\"facet\" or \"endsolid\"");
      }
    }
    return problem_;
  }

 private:
  /// After an "endsolid": whether no solid follows.
  bool is_last() {
    TextWords after = words_;
    const std::string_view word = after.next();
    for (const char* more : {"solid", "endsolid", "end"})
      if (same(word, more)) return false;
    if (has(words_.rest(), "facet")) return false;
    if (!word.empty()) notes_.add(in_quotes(word) + " after its last \"endsolid\"", "it is left out", after.line());
    return true;
  }

  void found(std::string_view word, const std::string& wanted) {
    if (!problem_.empty()) return;
    const std::string truncated = " where " + wanted + " should stand: it is truncated; copy or export it again";
    if (word.empty())
      problem_ = "ends" + truncated;
    else if (words_.rest().empty())
      problem_ = "ends with " + in_quotes(word) + truncated;
    else
      problem_ = "has " + in_quotes(word) + " in line " + std::to_string(words_.line()) + " where " + wanted +
                 " should stand: it is damaged or no STL; export it again";
  }

  bool expect(std::string_view wanted) {
    const std::string_view word = words_.next();
    if (!same(word, wanted)) found(word, "\"" + std::string(wanted) + "\"");
    return problem_.empty();
  }

  /// "endloop", which some write in two words.
  bool is_end(std::string_view word, const std::string& what) {
    if (same(word, "end" + what)) return true;
    if (!same(word, "end") || !same(words_.peek(), what)) return false;
    words_.next();
    return true;
  }

  bool expect_end(const std::string& what) {
    const std::string_view word = words_.next();
    if (!is_end(word, what)) found(word, "\"end" + what + "\"");
    return problem_.empty();
  }

  /// To the corners. The normal is not read: their order says it, and exporters write nonsense, "-1.#IND" too.
  bool pass_normal() {
    std::string_view word = words_.next();
    const auto is_other = [&] {
      if (is_numeric(word)) return word.empty();
      return has(word, "vertex") || has(word, "facet") || has(word, "loop") || has(word, "solid");
    };
    while (!same(word, "outer") && !is_other()) word = words_.next();
    if (!same(word, "outer")) found(word, "\"outer\"");
    return problem_.empty() && expect("loop");
  }

  bool read_corner(Vec3& out) {
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = words_.next();
      if (!words_.decimal(word, out[k], notes_))
        found(word, "a number");
      else if (!is_coordinate(out[k]))
        found(word, kCoordinate);
    }
    return problem_.empty();
  }

  void read_facet() {
    if (!pass_normal()) return;
    const int first = static_cast<int>(mesh_.vertices.size());
    for (int k = 0; k < 3; ++k) {
      Vec3 p;
      if (!expect("vertex") || !read_corner(p)) return;
      mesh_.vertices.push_back(p);
    }
    mesh_.triangles.push_back({first, first + 1, first + 2});
    if (expect_end("loop")) expect_end("facet");
  }

  TextWords words_;
  Mesh& mesh_;
  MeshNotes& notes_;
  std::string problem_;
};

}  // namespace

std::string read_stl(std::string_view bytes, Mesh& mesh, MeshNotes& notes) {
  const bool ascii = !fits_binary_stl(bytes) && is_ascii_stl(bytes);
  return ascii ? AsciiStl(bytes, mesh, notes).read() : read_binary_stl(bytes, mesh, notes);
}

}  // namespace genu
