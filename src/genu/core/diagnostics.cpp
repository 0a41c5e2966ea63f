#include "genu/core/diagnostics.h"

#include <algorithm>
#include <tuple>

namespace genu {

Diagnostic error_at(FilePlace where, Code code, std::string key, std::string found, std::string rule) {
  return {Diagnostic::Severity::error, code, std::move(where), std::move(key), std::move(found), std::move(rule)};
}

Diagnostic warning_at(FilePlace where, Code code, std::string key, std::string found, std::string rule) {
  return {Diagnostic::Severity::warning, code, std::move(where), std::move(key), std::move(found), std::move(rule)};
}

std::string printable(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x20 && code != 0x7f) {
      out += c;
    } else {
      constexpr char kDigits[] = "0123456789abcdef";
      out += std::string("\\x") + kDigits[code / 16] + kDigits[code % 16];
    }
  }
  return out;
}

std::string to_string(const Diagnostic& d) {
  std::string s = d.file;
  if (d.line > 0) s += ":" + std::to_string(d.line);
  if (d.line > 0 && d.column > 0) s += ":" + std::to_string(d.column);
  if (!s.empty()) s += ": ";
  if (d.severity == Diagnostic::Severity::warning) s += "warning: ";
  if (!d.key.empty()) {
    s += d.key;
    if (!d.found.empty()) s += " = " + d.found;
    s += ": ";
  }
  return printable(s + d.rule);
}

void Diagnostics::error(Code code, std::string file, std::string rule) {
  add(error_at({std::move(file)}, code, {}, {}, std::move(rule)));
}

void Diagnostics::warning(Code code, std::string file, std::string rule) {
  add(warning_at({std::move(file)}, code, {}, {}, std::move(rule)));
}

bool Diagnostics::has_errors() const { return count(Diagnostic::Severity::error) > 0; }

std::size_t Diagnostics::count(Diagnostic::Severity severity) const {
  return static_cast<std::size_t>(
      std::count_if(items_.begin(), items_.end(), [&](const Diagnostic& d) { return d.severity == severity; }));
}

void Diagnostics::sort() {
  std::stable_sort(items_.begin(), items_.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::tie(a.file, a.line, a.column) < std::tie(b.file, b.line, b.column);
  });
}

}  // namespace genu
