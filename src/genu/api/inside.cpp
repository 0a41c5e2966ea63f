#include "genu/api/inside.h"

namespace genu::api {

std::vector<Problem> problems_of(Diagnostics diagnostics) {
  diagnostics.sort();
  std::vector<Problem> out;
  for (Diagnostic d : diagnostics.items()) {
    if (d.key.starts_with("--")) d.key.erase(0, 2);
    out.push_back({d.severity == Diagnostic::Severity::warning, to_string(d.code), d.file, d.line, d.column, d.key,
                   d.found, d.rule, to_string(d)});
  }
  return out;
}

void check(const Diagnostics& diagnostics) {
  if (diagnostics.has_errors()) throw SceneError(problems_of(diagnostics));
}

void refuse(Code code, const std::string& key, const std::string& found, const std::string& rule) {
  Diagnostics out;
  out.add(error_at({}, code, key, found, rule));
  throw SceneError(problems_of(out));
}

}  // namespace genu::api
