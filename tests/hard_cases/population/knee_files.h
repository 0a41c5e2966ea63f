// A random knee as genu reads it.
#pragma once

#include <string>

#include "hard_cases/population/knee_spec.h"

namespace genu::population {

/// How a knee stands in its file: as it is, or as its mirror image in a laboratory whose axes have other names, a left
/// knee instead of a right one. What it does is the same.
struct View {
  bool mirrored = false;
  /// A place, or a force, of the knee as the file has it; and a turn, or a moment.
  Vec3 place(const Vec3& v) const { return mirrored ? Vec3(v.z(), -v.x(), v.y()) : v; }
  Vec3 turn(const Vec3& v) const { return mirrored ? Vec3(-v.z(), v.x(), -v.y()) : v; }
  Vec3 place_back(const Vec3& v) const { return mirrored ? Vec3(-v.y(), v.z(), v.x()) : v; }
  Vec3 turn_back(const Vec3& v) const { return mirrored ? Vec3(v.y(), -v.z(), -v.x()) : v; }
};

/// Writes scene.toml and its meshes (binary STL, mm) into `folder`, which exists; returns the scene's path. Vertices of
/// noisy meshes are moved by numbers drawn from `noise_seed`. A knee that is a text is written as it is.
std::string write_knee(const Knee& knee, const std::string& folder, std::uint64_t noise_seed, const View& view = {});

}  // namespace genu::population
