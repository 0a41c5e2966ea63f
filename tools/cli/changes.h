// --without and --set, the same on every command that reads a scene (scene/scene_changes.h).
#pragma once

#include <CLI/App.hpp>

#include "genu/scene/scene_changes.h"

namespace genu::cli {

inline void add_changes(CLI::App& command, SceneChanges& changes) {
  command
      .add_option("--without", changes.without,
                  "leave out ligaments, bundles, contacts or loads of the scene: ACLam1, \"ACL*\", contact.tf; may be "
                  "repeated")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      .add_option(
          "--set", changes.set,
          "NAME=VALUE: another number than the file's, by the names of genu sensitivity: AAC.stiffness=1000 (in "
          "the file's units), \"MCL*.stiffness=x0.5\", push.force.z=+2; may be repeated")
      ->allow_extra_args(false);
}

}  // namespace genu::cli
