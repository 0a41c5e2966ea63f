// Reads a scene file (TOML; docs/scene-reference.md) into a Scene, or says everything that is wrong with it at once.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/core/input_files.h"
#include "genu/scene/scene.h"
#include "genu/scene/toml_document.h"

namespace genu {

/// Reads the file at `path`. Returns nothing if anything is wrong; then `out` has every error found, in the order of
/// the file. Never throws for a missing, unreadable, oversized or malformed file.
[[nodiscard]] std::optional<Scene> read_scene(const std::string& path, Diagnostics& out);

/// Mesh files, as a scene names them or as they would be opened, that need not exist: their triangles are at hand.
using MeshesAtHand = std::vector<std::string>;

/// The same through `files`, which others may read too.
[[nodiscard]] std::optional<Scene> read_scene(const std::string& path, InputFiles& files, Diagnostics& out,
                                              const MeshesAtHand& at_hand = {});

/// The same for a text in memory; `path` names it in messages, and mesh files are looked for in its folder.
[[nodiscard]] std::optional<Scene> parse_scene(const std::string& text, const std::string& path, Diagnostics& out,
                                               const MeshesAtHand& at_hand = {});

/// The two halves of read_scene(): what the file at `path` says as TOML, and the scene of such a document.
[[nodiscard]] std::optional<TomlNode> read_document(const std::string& path, InputFiles& files, Diagnostics& out);
[[nodiscard]] std::optional<Scene> scene_of(const TomlNode& document, const std::string& path, Diagnostics& out,
                                            const MeshesAtHand& at_hand = {});

/// The surfaces of a scene, or of a file that holds nothing but `format`, `title`, `units` and [surface.NAME] tables
/// (as `genu fit` writes it) and [solid.NAME] tables: its bodies are those that the surfaces name.
[[nodiscard]] std::optional<Scene> read_surface_file(const std::string& path, Diagnostics& out);

}  // namespace genu
