// A scene as its file says, with what --without and --set change: between reading the file and building the joint, for
// all commands. The file is not touched.
#pragma once

#include <optional>
#include <string>

#include "genu/assemble/text_places.h"
#include "genu/core/diagnostics.h"
#include "genu/core/input_files.h"
#include "genu/scene/scene.h"

namespace genu {

/// "without ACL*; MCL*.stiffness=x0.5"
std::string words_of(const SceneChanges& changes);

/// Reads the scene file, changes the document as asked for, and reads the scene from that, so that a changed number
/// obeys the rules of a written one. A table left out is as if it had `enabled = false`. Errors in `out`: those of the
/// file, names that are none, values that are none, and numbers that the file does not give.
[[nodiscard]] std::optional<Scene> read_changed_scene(const SceneSource& source, InputFiles& files, Diagnostics& out);
[[nodiscard]] std::optional<Scene> read_changed_scene(const SceneSource& source, Diagnostics& out);

/// Writes the changes of a scene into the text of its file. A table without a header of its own is an error in `out`.
void write_changes(const SceneTables& scene, TextPlaces& places, Diagnostics& out);
std::string with_changes(const std::string& text, const SceneTables& scene, Diagnostics& out);

}  // namespace genu
