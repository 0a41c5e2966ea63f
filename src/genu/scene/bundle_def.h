// Fibres of a ligament under one name, [bundle.NAME]: their sums are results, their names one name in patterns.
#pragma once

#include <string>
#include <vector>

#include "genu/core/source_location.h"

namespace genu {

struct SceneTables;

struct BundleDef {
  std::string name;
  std::vector<std::string> fibres;  ///< of ligaments of the file, also disabled ones, in the file's order
  std::vector<int> members;         ///< those that are in the scene: indices into SceneTables::ligaments
  SourceLocation where;
};

/// `pattern` ("ACL", "ACL.stiffness"), and for each bundle that its part before the dot names, the same of each of its
/// fibres ("ACLam1.stiffness", ...).
std::vector<std::string> with_fibres(const SceneTables& scene, const std::string& pattern);

/// Whether any of with_fibres(pattern) means `word` (words.h).
bool matches(const SceneTables& scene, const std::string& pattern, const std::string& word);

}  // namespace genu
