// Errors as data. What a user can cause is never an exception: it is collected here, all at once, and printed as
//   scene.toml:41:13: ligament.AAC.stiffness = -2: must be > 0 N
// How to report one:
//   out.error(Code::no_such_file, file, "is not there");                       about a file as a whole
//   out.add(error_at({file, where}, Code::out_of_range, key, found, rule));    about a place in it, or an option: {}
// and the same with warning.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/core/diagnostic_code.h"
#include "genu/core/source_location.h"

namespace genu {

/// Why something cannot be done, before it is known where that has to be reported.
struct Fault {
  Code code;
  std::string text;
};

struct Diagnostic {
  enum class Severity { error, warning };
  Diagnostic(Severity how_bad, Code what, FilePlace where, std::string of_key, std::string as_found, std::string broken)
      : severity(how_bad),
        code(what),
        file(std::move(where.file)),
        line(where.at.line),
        column(where.at.column),
        key(std::move(of_key)),
        found(std::move(as_found)),
        rule(std::move(broken)) {}

  Severity severity;
  Code code;  ///< what kind of mistake: decides the advice
  std::string file;
  int line;           ///< 1-based; 0 where there is none
  int column;         ///< 1-based; 0 where there is none
  std::string key;    ///< key path, e.g. "ligament.AAC.stiffness"; may be empty
  std::string found;  ///< the value as found, e.g. "-2"; may be empty
  std::string rule;   ///< what is allowed, or what is wrong, in words for people alone
};

Diagnostic error_at(FilePlace where, Code code, std::string key, std::string found, std::string rule);
Diagnostic warning_at(FilePlace where, Code code, std::string key, std::string found, std::string rule);

/// `text` with its control characters written as \x1b: what comes from a file cannot drive a terminal.
std::string printable(const std::string& text);

/// One line: file:line:column: key = found: rule
std::string to_string(const Diagnostic& d);

class Diagnostics {
 public:
  void add(Diagnostic d) { items_.push_back(std::move(d)); }
  void error(Code code, std::string file, std::string rule);
  void warning(Code code, std::string file, std::string rule);
  [[nodiscard]] bool has_errors() const;
  [[nodiscard]] std::size_t count(Diagnostic::Severity severity) const;
  const std::vector<Diagnostic>& items() const { return items_; }
  /// By file, line and column, so that the order never depends on how a file was walked.
  void sort();

 private:
  std::vector<Diagnostic> items_;
};

}  // namespace genu
