// The fibula of a new knee: a bone of the tibia's body that touches nothing.
#pragma once

#include <optional>
#include <string>

#include "genu/core/diagnostics.h"
#include "genu/new_scene/new_bones.h"
#include "genu/study/knee_layout.h"

namespace genu {

/// Whether its head lies to the left of the tibia, and the knee is a left one. Empty where it lies amid the tibia.
std::optional<bool> left_by_fibula(const Mesh& fibula, const KneeLayout& knee);

/// False, with the reason in `out`, where it is not beside and below the plateau.
bool check_fibula(const NewScene& asked, const NewBones& bones, const KneeLayout& knee, Diagnostics& out);

/// Its table of a scene; empty where there is none.
std::string fibula_text(const NewScene& asked, const NewBones& bones);

/// Warns where it lies on the medial side of the knee that `left` says, or that the bones look like.
void doubt_fibula(const NewScene& asked, const NewBones& bones, const KneeLayout& knee, bool left, Diagnostics& out);

/// How far from it the reference knee's ligaments inserted (put_on_fibula(), m), for the terminal; a warning where that
/// is too far.
std::string fibula_choice(const NewScene& asked, double farthest, Diagnostics& out);

}  // namespace genu
