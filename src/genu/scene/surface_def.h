// A surface of a scene, and the tables of its numbers.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "genu/core/piece_files.h"
#include "genu/core/pose.h"
#include "genu/core/source_location.h"
#include "genu/core/types.h"
#include "genu/scene/number_table.h"

namespace genu {

struct SurfaceDef {
  enum class Shape { plane, sphere, ellipsoid, cylinder, torus, polynomial, cylindrical_polynomial, mesh };
  struct Term {
    int i = 0, j = 0;  ///< z = sum c x^i y^j, or r = sum c theta^i z^j
    double c = 0;      ///< SI
  };
  /// Where contact is meant, in the surface's own frame: what is left empty is not limited.
  struct Patch {
    using Range = std::optional<std::pair<double, double>>;  ///< first < second
    std::array<Range, 3> box;                                ///< x, y, z, m
    Range theta;                                             ///< about z from x toward y, rad
    SourceLocation where;
  };
  /// Of the cartilage on the surface: a number, or what lies between it and the mesh of a bone.
  struct Thickness {
    bool measured = false;
    double constant = 0;    ///< m, where it is not measured
    PieceFiles bone;        ///< mesh: paths as opened
    double bone_unit = 1;   ///< m per unit of these files
    double least = 0.5e-3;  ///< m: what is thinner counts as this thick
    double most = 10e-3;    ///< m: how far the bone is looked for
    SourceLocation where;
  };
  std::string name;
  int body = -1;
  Shape shape = Shape::plane;
  Pose placement;                    ///< X_body_surface
  bool inside = false;               ///< the outward side turned round (a socket)
  double radius = 0;                 ///< sphere, cylinder: m
  Vec3 radii = Vec3::Zero();         ///< ellipsoid: m
  double major_radius = 0;           ///< torus: m
  double minor_radius = 0;           ///< torus: m
  std::vector<Term> terms;           ///< polynomial
  PieceFiles file;                   ///< mesh: paths as opened (already relative to the scene's folder)
  double file_unit = 1;              ///< mesh: m per unit of the files
  std::optional<double> fit_radius;  ///< mesh: m
  std::optional<int> degree;         ///< mesh: 2 to 4
  std::optional<Patch> patch;
  std::optional<Thickness> thickness;  ///< where the surface has one of its own
  SourceLocation where;
  SourceLocation fit_radius_where;  ///< where one is given
};

/// The size of a shape: varied by 1 mm, not by a share.
constexpr NumberRow size_row(const char* key, int size = 1) {
  return {.key = key, .unit = Unit::length, .change = NumberRow::Change::absolute, .size = size};
}

inline constexpr NumberOf<SurfaceDef> kOrigin{.row = {.key = "origin",
                                                      .unit = Unit::length,
                                                      .range = NumberRow::Range::any,
                                                      .change = NumberRow::Change::absolute,
                                                      .presence = NumberRow::Presence::optional,
                                                      .size = 3},
                                              .values = [](SurfaceDef& s) { return s.placement.p.data(); },
                                              .frame = [](const SurfaceDef& s) { return s.body; }};

inline constexpr NumberOf<SurfaceDef> kPlacedNumbers[] = {kOrigin};
inline constexpr NumberOf<SurfaceDef> kRoundNumbers[] = {
    {.row = size_row("radius"), .values = [](SurfaceDef& s) { return &s.radius; }}, kOrigin};
inline constexpr NumberOf<SurfaceDef> kEllipsoidNumbers[] = {
    {.row = size_row("radii", 3), .values = [](SurfaceDef& s) { return s.radii.data(); }}, kOrigin};
inline constexpr NumberOf<SurfaceDef> kTorusNumbers[] = {
    {.row = size_row("major_radius"), .values = [](SurfaceDef& s) { return &s.major_radius; }},
    {.row = size_row("minor_radius"),
     .values = [](SurfaceDef& s) { return &s.minor_radius; },
     .fault = [](const SurfaceDef& s) -> const char* {
       return s.minor_radius < s.major_radius ? nullptr
                                              : "must be < major_radius: a tube that meets itself is no surface";
     }},
    kOrigin};

/// In the order of SurfaceDef::Shape. `chart` chooses between the two polynomials.
inline constexpr KindOf<SurfaceDef> kSurfaceKinds[] = {{"plane", "a plane", kPlacedNumbers},
                                                       {"sphere", "a sphere", kRoundNumbers},
                                                       {"ellipsoid", "an ellipsoid", kEllipsoidNumbers},
                                                       {"cylinder", "a cylinder", kRoundNumbers},
                                                       {"torus", "a torus", kTorusNumbers},
                                                       {"polynomial", "a polynomial surface", kPlacedNumbers},
                                                       {"polynomial", "a polynomial surface", kPlacedNumbers},
                                                       {"mesh", "a mesh surface", kPlacedNumbers}};

inline const KindOf<SurfaceDef>& kind_of(const SurfaceDef& s) { return kSurfaceKinds[static_cast<int>(s.shape)]; }

}  // namespace genu
