// Which ways are proximal and anterior on the two bones of a knee, for its clinical description and its rotations.
#pragma once

#include <map>
#include <string>

#include "genu/atlas/fitted_knee.h"
#include "genu/study/knee_layout.h"

namespace genu {

/// Unit vectors in the frame of the files; those of a bone are perpendicular.
struct KneeFrames {
  Vec3 femur_proximal, femur_anterior, tibia_proximal, tibia_anterior;
};

/// Along the axes of the files.
KneeFrames frames_of_files(const KneeLayout& knee);

/// As the bones of the reference knee have them, laid on these.
KneeFrames frames_of_bones(const FittedKnee& fitted);

/// rad: between the two frames of a bone, of the bone that differs more.
double angle_between(const KneeFrames& a, const KneeFrames& b);

/// Whether the bones lie to each other as those of a knee: else their axes are not told by their shape.
bool believed(const KneeFrames& frames);

/// "x" with quotes for a direction along an axis, else three numbers between brackets.
std::string direction_word(const Vec3& direction);

/// As a scene writes them: proximal and anterior under femur_proximal, ..., and under flexion_axis, adduction_axis,
/// rotation_axis the axes of a joint whose angles are those of Grood and Suntay (with these signs: bending, varus,
/// internal rotation).
std::map<std::string, std::string> frame_words(const KneeFrames& frames, bool left);

}  // namespace genu
