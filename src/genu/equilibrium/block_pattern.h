// In which order the bodies of a joint are eliminated, and which blocks of the matrix are then not zero.
#pragma once

#include <vector>

#include "genu/core/types.h"

namespace genu {

/// Which of the groups of rows of a matrix couple: each body's six rows are a group, and each further row is one.
class Coupling {
 public:
  Coupling() = default;
  Coupling(int bodies, int others);

  /// Finds which blocks of a matrix have entries. Returns whether that differs from before.
  bool look_at(const MatX& matrix);

  int bodies() const { return bodies_; }
  int groups() const { return groups_; }
  bool operator()(int a, int b) const { return coupled_[at(a * groups_ + b)] != 0; }

 private:
  int first(int group) const { return group < bodies_ ? 6 * group : 5 * bodies_ + group; }
  int count(int group) const { return group < bodies_ ? 6 : 1; }
  bool any(const MatX& matrix, int a, int b) const;

  int bodies_ = 0, groups_ = 0;
  std::vector<char> coupled_;  ///< symmetric
};

/// A node is a body's rows, and those further rows that are eliminated with it.
struct BlockPattern {
  std::vector<std::vector<int>> rows;   ///< of each node, in the order of elimination
  std::vector<std::vector<int>> later;  ///< the nodes after it that it couples to, with what elimination adds; rising
};

/// The body of least degree comes first. A further row comes with the first of its bodies that has not six of them yet;
/// one that concerns many bodies with the last body.
BlockPattern block_pattern(const Coupling& coupled);

}  // namespace genu
