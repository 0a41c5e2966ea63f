// Errors as data. What a user can cause is never an exception: it is collected here, all at once, and printed as
//   scene.toml:41:13: ligament.AAC.stiffness = -2: must be > 0 N
#pragma once

#include <string>
#include <vector>

namespace genu {

struct Diagnostic {
  enum class Severity { error, warning };
  Severity severity = Severity::error;
  std::string file;
  int line = 0;       ///< 1-based; 0 where there is none
  int column = 0;     ///< 1-based; 0 where there is none
  std::string key;    ///< key path, e.g. "ligament.AAC.stiffness"; may be empty
  std::string found;  ///< the value as found, e.g. "-2"; may be empty
  std::string rule;   ///< what is allowed, or what is wrong, in words
};

/// `text` with its control characters written as \x1b: what comes from a file cannot drive a terminal.
std::string printable(const std::string& text);

/// One line: file:line:column: key = found: rule
std::string to_string(const Diagnostic& d);

class Diagnostics {
 public:
  void add(Diagnostic d) { items_.push_back(std::move(d)); }
  void error(std::string file, std::string rule);
  bool has_errors() const;
  std::size_t count(Diagnostic::Severity severity) const;
  const std::vector<Diagnostic>& items() const { return items_; }
  /// By file, line and column, so that the order never depends on how a file was walked.
  void sort();

 private:
  std::vector<Diagnostic> items_;
};

}  // namespace genu
