#include "genu/mesh_files/mesh_notes.h"

#include <algorithm>

namespace genu {

void MeshNotes::add(std::string_view found, std::string_view done, std::size_t line, std::size_t times) {
  const auto same = std::find_if(notes_.begin(), notes_.end(), [&](const Note& n) { return n.found == found; });
  if (same != notes_.end())
    same->times += times;
  else
    notes_.push_back({std::string(found), std::string(done), line, times});
}

void MeshNotes::comma(std::string_view word, std::size_t line) {
  if (comma_.empty()) comma_ = word, comma_line_ = line;
  add("decimal commas", "read as decimal points", line);
}

std::string MeshNotes::problem() const {
  if (comma_.empty() || !point_) return {};
  return "has " + in_quotes(comma_) + " in line " + std::to_string(comma_line_) +
         " and decimal points elsewhere: a comma may part decimals or thousands; export it again without commas";
}

std::vector<std::string> MeshNotes::texts() const {
  std::vector<std::string> out;
  for (const Note& n : notes_) {
    const std::string others = n.times > 1 ? " and " + std::to_string(n.times - 1) + " others" : std::string();
    const std::string place = n.line > 0 ? " in line " + std::to_string(n.line) + others : std::string();
    out.push_back("has " + n.found + place + ": " + n.done);
  }
  return out;
}

void cut_polygons(Mesh& mesh, const std::vector<Fan>& fans, MeshNotes& notes) {
  if (const std::size_t left = cut_concave(mesh, fans); left > 0)
    notes.add(std::to_string(left) + " polygons that cross themselves or have too many corners",
              "cut from their first corner");
}

}  // namespace genu
