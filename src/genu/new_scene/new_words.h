// What is filled into the text of a scene of two meshes.
#pragma once

#include <map>
#include <string>

#include "genu/new_scene/asked_scene.h"
#include "genu/new_scene/new_bones.h"
#include "genu/new_scene/new_landmarks.h"
#include "genu/study/knee_layout.h"

namespace genu {

/// By the word that stands for it (new_scene_text.h).
using Words = std::map<std::string, std::string>;

/// What stands between the quotes of a string of TOML.
std::string toml_string_of(const std::string& text);

/// One name, or a list of the files of the pieces, as a scene in `folder` names them.
std::string names_seen_from(const PieceFiles& files, const std::string& folder);

/// The line for the thickness of cartilage over a bone; empty where there is none.
std::string thickness_text(const PieceFiles& files, const std::string& folder, const std::optional<NewBone>& bone);

/// All but the ligaments and the motion.
Words words_of_knee(const NewScene& asked, const KneeLayout& knee, const KneeFrames& frames, bool left,
                    const NewBones& bones, const KneeLandmarks& landmarks);

/// The motion: from 0 to `degrees`, a pose each. `tried_further`: the trial found no pose beyond.
void ask_for_flexion(Words& words, int degrees, bool tried_further);

}  // namespace genu
