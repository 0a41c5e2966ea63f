// `genu new --edit`: a scene that is written again keeps what its user has changed. What genu wrote the last time lies
// beside the scene: what differs from it is the user's.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "genu/core/diagnostics.h"
#include "genu/new_scene/asked_scene.h"
#include "genu/new_scene/scene_merge.h"

namespace genu {

/// The files of a new scene in `folder`.
struct NewSceneFiles {
  std::filesystem::path folder;
  std::string name;

  std::string scene() const { return (folder / (name + ".toml")).string(); }
  std::string written() const { return (folder / (name + ".written.toml")).string(); }  ///< as genu wrote it
  std::string before() const { return (folder / (name + ".before.toml")).string(); }    ///< before the last --edit
  std::string trial() const { return (folder / (name + ".trial.toml")).string(); }      ///< while it is tried out
};

/// What goes into written(): the text of a scene under a line that says what this is.
std::string written_copy(const std::string& text);

struct EarlierScene {
  std::string written, mine;
};

/// Empty, with all reasons in `out`, where there is no scene, no copy of what genu wrote, or the scene has mistakes; or
/// a patella or a fibula, and `asked` has none.
[[nodiscard]] std::optional<EarlierScene> read_earlier(const NewSceneFiles& files, const NewScene& asked,
                                                       Diagnostics& out);

/// With a warning for each change of the user that the new scene does not agree with.
MergedScene with_changes(const EarlierScene& earlier, const std::string& fresh, const std::string& file,
                         Diagnostics& out);

/// The scene as it was, the new one, and what genu wrote. An error in words; empty: none.
[[nodiscard]] std::string write_edited(const NewSceneFiles& files, const EarlierScene& earlier,
                                       const std::string& merged, const std::string& fresh);

}  // namespace genu
