#include "genu/osim/joint_kinds.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "genu/osim/tolerances.h"

namespace genu::osim {
namespace {

/// Slope 1 or -1 through 0; 0 for anything else.
int sign_of(const Function& f) {
  if (!f.is_line() || f.scale * f.coefficients[1] != 0) return 0;
  const double slope = f.scale * f.coefficients[0];
  if (std::abs(std::abs(slope) - 1) > kAxisRounding) return 0;
  return slope > 0 ? 1 : -1;
}

/// 1 for x, 2 for y, 3 for z, negative where it points the other way; 0 for another direction.
int axis_of(const Vec3& direction) {
  for (int i = 0; i < 3; ++i)
    if (std::abs(std::abs(direction[i]) - 1) <= kAxisRounding) return direction[i] > 0 ? i + 1 : -i - 1;
  return 0;
}

std::string what_moves(const Axis& axis, const char* kind, int number) {
  if (axis.coordinate.empty()) return fmt::format("{} {} has no coordinate", kind, number);
  if (sign_of(axis.function) == 0)
    return fmt::format("{} {} is not its coordinate {} or minus that", kind, number, axis.coordinate);
  if (axis_of(axis.direction) == 0) return fmt::format("the axis of {} {} is none of x, y, z", kind, number);
  return {};
}

std::string why_not_free(const Joint& joint, MovingJoint& moving) {
  std::set<std::string> coordinates;
  for (int i = 0; i < 3; ++i) {
    const Axis &turn = joint.rotations[at(i)], &shift = joint.translations[at(i)];
    for (const auto& problem : {what_moves(turn, "rotation", i + 1), what_moves(shift, "translation", i + 1)})
      if (!problem.empty()) return problem;
    const int axis = axis_of(turn.direction) * sign_of(turn.function);
    const int along = axis_of(shift.direction) * sign_of(shift.function);
    moving.rotations[at(i)] = {turn.coordinate, std::abs(axis) - 1, axis < 0};
    if (along < 0) return fmt::format("translation {} goes against its axis", i + 1);
    if (!moving.translations[at(along - 1)].empty()) return "two translations have one axis";
    moving.translations[at(along - 1)] = shift.coordinate;
    coordinates.insert({turn.coordinate, shift.coordinate});
  }
  if (moving.rotations[0].axis == moving.rotations[1].axis || moving.rotations[1].axis == moving.rotations[2].axis)
    return "two rotations one after the other have one axis";
  return coordinates.size() == 6 ? std::string() : "its axes share a coordinate";
}

bool moves(const Axis& axis) { return !axis.coordinate.empty() && axis.function.kind != Function::Kind::constant; }

std::string why_not_revolute(const Joint& joint, MovingJoint& moving) {
  const auto shifts = std::count_if(joint.translations.begin(), joint.translations.end(), moves);
  const auto turns = std::count_if(joint.rotations.begin(), joint.rotations.end(), moves);
  if (shifts > 0 || turns != 1) return fmt::format("{} rotations and {} translations move", turns, shifts);
  for (const Axis& axis : joint.rotations) {
    if (!moves(axis)) continue;
    const double slope = axis.function.is_line() ? axis.function.scale * axis.function.coefficients[0] : 0;
    if (std::abs(std::abs(slope) - 1) > kAxisRounding) return "its rotation is not its coordinate or minus that";
    moving.angle = axis.coordinate;
  }
  return {};
}

}  // namespace

bool MovingJoint::has(const std::string& coordinate) const {
  if (kind == Kind::revolute) return coordinate == angle;
  const auto turns = [&](const Rotation& r) { return r.coordinate == coordinate; };
  return std::any_of(rotations.begin(), rotations.end(), turns) ||
         std::find(translations.begin(), translations.end(), coordinate) != translations.end();
}

bool read_kind(const Joint& joint, MovingJoint& moving, std::string& why_not) {
  moving.kind = MovingJoint::Kind::free;
  const std::string no_free = why_not_free(joint, moving);
  if (no_free.empty()) return true;
  moving.kind = MovingJoint::Kind::revolute;
  const std::string no_revolute = why_not_revolute(joint, moving);
  why_not = fmt::format("can be no free joint ({}) and no revolute one ({})", no_free, no_revolute);
  return no_revolute.empty();
}

}  // namespace genu::osim
