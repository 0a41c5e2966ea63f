// The settings that `genu accuracy` tries: how fine the meshes are, how they are fitted, how exactly and in how many
// increments the path is solved, and how layers are summed.
#pragma once

#include <string>
#include <vector>

#include "genu/assemble/prepare.h"

namespace genu {

/// A scene with something changed. What is 0 or empty is as the scene has it.
struct AccuracySetting {
  enum class Knob { own, mesh, radius, tolerance, increments, layer, model };
  Knob knob = Knob::own;
  double edge_factor = 0;      ///< meshes: edges so many times longer; closed forms: the edge over their own unit of it
  int degree = 0;              ///< of fits
  double radius_factor = 0;    ///< of the fit radius
  double tolerance = 0;        ///< of Newton's method
  double increments = 0;       ///< times as many
  double layer_tolerance = 0;  ///< of smooth layers
  double modulus = 0;          ///< Pa: of a layer summed over triangles, in the place of rigid contact
  bool operator==(const AccuracySetting&) const = default;
};
const char* to_string(AccuracySetting::Knob knob);

/// Closed forms are cut into triangles with edges from this (m) downward: a twentieth of the smallest bounded surface;
/// 0 without one.
double mesh_unit(const Prepared& prepared);

/// Whether the scene is made of closed forms, which meshes of them are compared with.
bool has_closed_forms_alone(const Prepared& prepared);

/// The scene as it is first, then all others. What is best is always the scene's own, or closest to it.
std::vector<AccuracySetting> accuracy_settings(const Prepared& prepared);

/// In words: "edge 0.90 mm, degree 3".
std::string describe(const Prepared& prepared, const AccuracySetting& setting);

/// The scene with a setting, its surfaces built anew where they change. Empty where one cannot be built.
std::optional<Prepared> with_setting(const Prepared& prepared, const AccuracySetting& setting);

/// Whether a setting gives a surface another mesh than it has.
bool changes_mesh(const Prepared& prepared, std::size_t surface, const AccuracySetting& setting);

/// The mesh of a surface under a setting, as it is fitted; the surface's own where nothing changes.
Mesh mesh_of(const Prepared& prepared, std::size_t surface, const AccuracySetting& setting);

}  // namespace genu
