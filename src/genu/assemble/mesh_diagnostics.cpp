#include "genu/assemble/mesh_diagnostics.h"

namespace genu {

void add_at_key(const SceneTables& scene, const SourceLocation& where, const std::string& key,
                const std::string& mesh_file, const Diagnostics& found, Diagnostics& out) {
  for (Diagnostic d : found.items()) {
    d.rule = d.file.empty() || d.file == mesh_file ? d.rule : d.file + ": " + d.rule;
    d.file = scene.file;
    d.line = where.line;
    d.column = where.column;
    d.key = key;
    d.found = '"' + mesh_file + '"';
    out.add(std::move(d));
  }
}

}  // namespace genu
