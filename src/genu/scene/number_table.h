// Tables of the numbers of a scene's objects: one row for each number that a kind of load, surface, joint or body has.
// The reader fills an object from its table, a parameter names a row, and a change is made through it. Each table
// stands below the struct that it fills: load_def.h, surface_def.h, joint_def.h, body_def.h.
#pragma once

#include <span>

#include "genu/core/number_row.h"

namespace genu {

/// Stands for the object itself in `frame`.
inline constexpr int kItself = -2;

template <class Def>
struct NumberOf {
  NumberRow row;
  /// Its row.size doubles beside one another, SI; null where the object lacks what has them.
  double* (*values)(Def&) = nullptr;
  /// Of a point that is fixed to a body: that body, as an index into Scene::bodies, or kItself.
  int (*frame)(const Def&) = nullptr;
  /// Whether a change of it changes forces; null: always, unless it is a share of 0.
  bool (*has_effect)(const Def&) = nullptr;
  /// What is wrong with it beside the numbers before it; null if nothing is.
  const char* (*fault)(const Def&) = nullptr;

  const double* values_of(const Def& def) const { return values(const_cast<Def&>(def)); }  // read only here
};

/// The numbers of a kind of object, in the order in which parameters list them.
template <class Def>
struct KindOf {
  const char* word;  ///< in a scene; empty where other keys decide
  const char* what;  ///< in messages: "a torus"
  std::span<const NumberOf<Def>> numbers;
};

}  // namespace genu
