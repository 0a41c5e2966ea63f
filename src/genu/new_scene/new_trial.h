// A new scene, tried out: its first poses say where it is in balance, all of them how far it bends.
#pragma once

#include <optional>
#include <string>

#include "genu/core/diagnostics.h"
#include "genu/new_scene/asked_scene.h"
#include "genu/new_scene/new_words.h"
#include "genu/study/run_scene.h"

namespace genu {

/// Solves the scene of a file. Errors name it as it will be called in its folder, `name`. The `first` time what is done
/// to the meshes goes to `out` too. Nothing where it is interrupted or cannot be read.
std::optional<Solution> try_out(const std::string& file, const std::string& name, const NewScene& asked, bool first,
                                Diagnostics& out);

/// That the user has stopped it.
void say_stopped(Diagnostics& out);

/// The reference pose becomes the first one that the trial found.
void refer_to_balance(Words& words, const Solution& found);

}  // namespace genu
