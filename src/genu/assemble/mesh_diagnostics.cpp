#include "genu/assemble/mesh_diagnostics.h"

#include <algorithm>

namespace genu {

void add_at_key(const SceneTables& scene, const std::string& key, const PieceFiles& files, const Diagnostics& found,
                Diagnostics& out) {
  for (Diagnostic d : found.items()) {
    const bool one = std::find(files.paths.begin(), files.paths.end(), d.file) != files.paths.end();
    const bool all = d.file.empty() || d.file == files.text();
    d.rule = one || all ? d.rule : d.file + ": " + d.rule;
    const SourceLocation where = files.where_of(d.file);
    d.found = '"' + (one ? d.file : files.text()) + '"';
    d.file = scene.file;
    d.line = where.line;
    d.column = where.column;
    d.key = key;
    out.add(std::move(d));
  }
}

}  // namespace genu
