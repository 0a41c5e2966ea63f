// The files of one mesh: one, or several that hold its pieces.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/core/source_location.h"

namespace genu {

struct PieceFiles {
  std::vector<std::string> paths;     ///< as opened, in the order in which they are joined
  std::vector<SourceLocation> where;  ///< of each name in the scene; empty where no scene has it

  PieceFiles() = default;
  PieceFiles(std::string path) {  // NOLINT(google-explicit-constructor): most meshes are one file
    if (!path.empty()) paths.push_back(std::move(path));
  }
  PieceFiles(const char* path) : PieceFiles(std::string(path)) {}  // NOLINT(google-explicit-constructor): the same

  bool empty() const { return paths.empty(); }
  bool several() const { return paths.size() > 1; }

  /// For messages: "femur.stl", "medial.stl, lateral.stl".
  std::string text() const {
    std::string out;
    for (const std::string& path : paths) out += (out.empty() ? "" : ", ") + path;
    return out;
  }

  /// Where the scene names this file; the first of its files where it is none of them.
  SourceLocation where_of(const std::string& path) const {
    for (std::size_t k = 0; k < paths.size() && k < where.size(); ++k)
      if (paths[k] == path) return where[k];
    return where.empty() ? SourceLocation{} : where.front();
  }

  /// The same meshes, wherever they are named.
  bool operator==(const PieceFiles& other) const { return paths == other.paths; }
  bool operator<(const PieceFiles& other) const { return paths < other.paths; }
};

}  // namespace genu
