#include "genu/new_scene/knee_frames.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/new_scene/tolerances.h"

namespace genu {
namespace {

bool along_an_axis(const Vec3& direction) { return direction.cwiseAbs().maxCoeff() > 1 - 1e-12; }

/// Seven digits: laxity takes the joint's axes for the clinical ones where they agree to 1e-6.
std::string numbers_of(const Vec3& d, const char* between) {
  const auto rounded = [](double x) { return std::round(1e7 * x) / 1e7 + 0.0; };  // no minus before 0
  return fmt::format("{:.7f}{}{:.7f}{}{:.7f}", rounded(d.x()), between, rounded(d.y()), between, rounded(d.z()));
}

std::string axis_of(const Vec3& direction) {
  return along_an_axis(direction) ? axis_word(direction) : numbers_of(direction, " ");
}

Mat3 frame(const Vec3& proximal, const Vec3& anterior) {
  Mat3 axes;
  axes << anterior, proximal, anterior.cross(proximal);
  return axes;
}

}  // namespace

KneeFrames frames_of_files(const KneeLayout& knee) {
  return {knee.proximal, knee.anterior, knee.proximal, knee.anterior};
}

KneeFrames frames_of_bones(const FittedKnee& fitted) {
  return {fitted.femur.turn.col(1), fitted.femur.turn.col(0), fitted.tibia.turn.col(1), fitted.tibia.turn.col(0)};
}

double angle_between(const KneeFrames& a, const KneeFrames& b) {
  const Mat3 femur = frame(a.femur_proximal, a.femur_anterior).transpose() * frame(b.femur_proximal, b.femur_anterior);
  const Mat3 tibia = frame(a.tibia_proximal, a.tibia_anterior).transpose() * frame(b.tibia_proximal, b.tibia_anterior);
  return std::max(std::abs(Eigen::AngleAxisd(femur).angle()), std::abs(Eigen::AngleAxisd(tibia).angle()));
}

bool believed(const KneeFrames& frames) {
  const Mat3 turn = frame(frames.femur_proximal, frames.femur_anterior).transpose() *
                    frame(frames.tibia_proximal, frames.tibia_anterior);
  return to::kDegree * std::abs(Eigen::AngleAxisd(turn).angle()) <= kBonesTurned;
}

std::string direction_word(const Vec3& direction) {
  return along_an_axis(direction) ? '"' + axis_word(direction) + '"' : "[" + numbers_of(direction, ", ") + "]";
}

std::map<std::string, std::string> frame_words(const KneeFrames& frames, bool left) {
  const Vec3 right = frames.femur_anterior.cross(frames.femur_proximal).normalized();
  const Vec3 floating = frames.tibia_proximal.cross(right).normalized();
  return {{"femur_proximal", direction_word(frames.femur_proximal)},
          {"femur_anterior", direction_word(frames.femur_anterior)},
          {"tibia_proximal", direction_word(frames.tibia_proximal)},
          {"tibia_anterior", direction_word(frames.tibia_anterior)},
          {"flexion_axis", axis_of(-right)},
          {"adduction_axis", axis_of(left ? Vec3(-floating) : floating)},
          {"rotation_axis", axis_of(left ? Vec3(-frames.tibia_proximal) : frames.tibia_proximal)}};
}

}  // namespace genu
