// What is changed in a scene without touching its file: the options --without and --set (assemble/changed_scene.h).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/core/source_location.h"

namespace genu {

/// As the user asks for it.
struct SceneChanges {
  /// Names or patterns of ligaments, bundles, contacts and loads that are left out: "ACL*", "ligament.ACL*".
  std::vector<std::string> without;
  /// "NAME=VALUE" of parameters (model/parameters.h) and of numbers of contacts ("tibiofemoral.modulus"). VALUE is a
  /// number in the file's units, x0.5 (times), or +2 (added).
  std::vector<std::string> set;

  bool empty() const { return without.empty() && set.empty(); }
  bool operator==(const SceneChanges&) const = default;
};

/// A scene file, and what is changed in it.
struct SceneSource {
  SceneSource(std::string file) : path(std::move(file)) {}
  SceneSource(const char* file) : path(file) {}
  SceneSource(std::string file, SceneChanges asked) : path(std::move(file)), changes(std::move(asked)) {}

  std::string path;
  SceneChanges changes;
};

/// One place of the file that a change replaces.
struct SceneEdit {
  SourceLocation where;  ///< of the value, or of a table's header
  std::string key;       ///< "ligament.AAC.stiffness", "ligament.AAC.enabled"
  std::string text;      ///< the new value, in the file's units
  bool below = false;    ///< it is a new line below the header
};

/// What has been changed in a scene that was read.
struct AppliedChanges {
  SceneChanges asked;
  std::vector<SceneEdit> edits;    ///< in the order of the options
  std::vector<std::string> words;  ///< one sentence an option: "without ACL*: 12 ligaments"
};

/// A table with `enabled = false`: read and checked, then left out.
struct DisabledTable {
  std::string group, name;  ///< "ligament", "ACLam1"
  SourceLocation where;
};

}  // namespace genu
