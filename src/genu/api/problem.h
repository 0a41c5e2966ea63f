// What is wrong with a scene, a mesh or a request: everything at once, as data and as an exception.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace genu::api {

struct Problem {
  bool warning = false;          ///< else an error
  std::string code;              ///< what kind of mistake, one of a fixed list: "no-such-file", "out-of-range"
  std::string file;              ///< may be empty
  int line = 0, column = 0;      ///< from 1; 0 where there is none
  std::string key, found, rule;  ///< "ligament.AAC.stiffness", "-2", "must be > 0 N"; the first two may be empty
  std::string text;              ///< all of it in one line: file:line:column: key = found: rule
};

/// Thrown for whatever a user can get wrong. Its text has every error, a line each.
class SceneError : public std::runtime_error {
 public:
  /// `problems`: at least one error.
  explicit SceneError(std::vector<Problem> problems);
  /// Errors and warnings, in the order of the file.
  const std::vector<Problem>& problems() const { return problems_; }
  /// The first error.
  const Problem& first() const;

 private:
  std::vector<Problem> problems_;
};

}  // namespace genu::api
