// What is refused of a question to `genu new` before a mesh is opened.
#pragma once

#include "genu/core/diagnostics.h"
#include "genu/new_scene/asked_scene.h"

namespace genu {

/// Whether what is asked contradicts itself or cannot be written; the reasons are in `out`.
bool refuse_words(const NewScene& asked, Diagnostics& out);

/// All that is wrong with the file of landmarks, where other errors end the work before it is used.
void refuse_landmarks(const NewScene& asked, Diagnostics& out);

}  // namespace genu
