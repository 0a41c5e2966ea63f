// What the contact equations ask of a surface, analytic or meshed.
//
// The equations of contact (Dortmans 1984: 5 for each contact point) need, at a point of the surface, its position,
// outward unit normal, an orthonormal tangent basis T and the shape operator S, with
//     dp = T ds,   dn = -T S ds                                   (S = -1/R on a sphere with its outward normal)
// Unknown increments are lengths ds in the tangent plane; no global (u, v) map is needed.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "genu/core/pose.h"
#include "genu/core/types.h"
#include "genu/mesh/mesh.h"
#include "genu/surface/samples.h"

namespace genu {

/// A point of a surface, in the frame of the body that carries it.
struct SurfacePoint {
  Vec3 p = Vec3::Zero();    ///< position, m
  Vec3 n = Vec3::UnitZ();   ///< outward unit normal
  Mat32 T = Mat32::Zero();  ///< orthonormal tangent basis, T.col(0) x T.col(1) = n
  Mat2 S = Mat2::Zero();    ///< shape operator in that basis, 1/m, symmetric: dn = -T S ds
};

/// How a surface bends under a geodesic: x'' = normal_curvature n, and neighbours part by y'' = -gauss y.
struct Bending {
  Vec3 n = Vec3::UnitZ();       ///< outward unit normal
  double normal_curvature = 0;  ///< t . S t, 1/m: negative where the surface bulges outward along t
  double gauss = 0;             ///< Gaussian curvature det S, 1/m^2
};

/// A sphere, or a circular cylinder without ends: their geodesics are closed forms.
struct RoundShape {
  Vec3 centre = Vec3::Zero();  ///< m: a point of the axis, of a cylinder
  Vec3 axis = Vec3::Zero();    ///< unit; 0: a sphere
  double radius = 0;           ///< m
  bool inside = false;         ///< the hollow side is the outward one
};

/// A place where what the surface was made from is wrong or missing: contact there is not to be trusted.
struct DoubtfulPlace {
  std::string what;          ///< for the user: what is wrong, and where in the file
  std::vector<Vec3> points;  ///< m, in the body's frame: they stand for the place
  double reach = 0;          ///< m: a contact nearer than this to one of them leans on it
  bool missing = false;      ///< part of the surface is missing there: what comes near may touch what is not there
};

class Surface {
 public:
  virtual ~Surface() = default;

  /// Puts x (m) onto the surface, near x. Returns false where the surface has no point near enough to be sure of
  /// (outside the band of a meshed surface, at the centre of a sphere, ...); `out` is then unspecified.
  [[nodiscard]] virtual bool project(const Vec3& x, SurfacePoint& out) const = 0;

  /// The point reached from `from` by the tangent step ds (m): second order in ds, always on the surface. The default
  /// is third order: it errs from the end of the geodesic that begins as ds, |ds| long, by the fourth power of ds.
  [[nodiscard]] virtual bool retract(const SurfacePoint& from, const Vec2& ds, SurfacePoint& out) const;

  /// The same for less, to see where a search leads: place, normal and curvature may err by third order in ds. Repeated
  /// with shorter and shorter steps it comes to the surface.
  [[nodiscard]] virtual bool retract_roughly(const SurfacePoint& from, const Vec2& ds, SurfacePoint& out) const;

  /// Signed distance of x to the surface (m), positive on the outward side; first-order accurate near the surface
  /// (exact where the shape has a closed form). Empty where it is not known.
  [[nodiscard]] virtual std::optional<double> gap(const Vec3& x) const = 0;

  /// gap(x), and in `foot` what project(x) gives, where that was found on the way; it may be there without a gap (past
  /// the edge of a patch), and is empty where it was not asked for.
  [[nodiscard]] virtual std::optional<double> gap_and_foot(const Vec3& x, std::optional<SurfacePoint>& foot) const;

  /// Follows a line to the surface by Newton's method: `t` (m along the unit `direction`) is where to begin and becomes
  /// the place, `normal` the outward unit normal there. False, with both unspecified, where it does not arrive.
  [[nodiscard]] virtual bool meet(const Vec3& origin, const Vec3& direction, double& t, Vec3& normal) const;

  /// How the surface bends under a geodesic that passes x, within rounding of the surface, along the unit tangent t.
  /// May answer for the parallel or level surface through x. False where there is no surface near.
  [[nodiscard]] virtual bool bending(const Vec3& x, const Vec3& t, Bending& out) const;

  /// The sphere or cylinder it is; empty for all others.
  virtual std::optional<RoundShape> round() const { return std::nullopt; }

  /// m: the length of a geodesic beyond which bending() is smooth piece by piece only; infinite for closed forms.
  virtual double smooth_length() const;

  /// Distance (m) along the surface from p, a point on it, to the nearest edge of the patch, or the straight one, which
  /// is no longer: positive inside, negative past the edge, +infinity for a surface without edges.
  virtual double edge_distance(const Vec3& p) const;

  /// Triangles that follow the surface, for finding candidates: the surface's own mesh, or a tessellation whose edges
  /// are about `edge` (m) long. `reach` (m) bounds unbounded shapes: what lies farther from `centre` may be left out.
  virtual Mesh triangles(double edge, const Vec3& centre, double reach) const = 0;

  /// Samples about `spacing` (m) apart: the vertices of triangles() unless a surface knows better ones.
  virtual SampleSet samples(double spacing, const Vec3& centre, double reach) const;

  /// Where not to trust it: empty for all but flawed meshes.
  virtual std::span<const DoubtfulPlace> doubtful() const { return {}; }

  /// True for a surface whose project() and gap() hold everywhere (a closed form), not in a band alone.
  virtual bool is_global() const { return true; }

  /// True where gap() is the distance to the whole surface, however far x is: a sphere that large about x is clear of
  /// it.
  virtual bool knows_distance() const { return is_global(); }

  /// True for a shape without an extent of its own (a plane, a cylinder, a polynomial).
  virtual bool is_unbounded() const { return false; }

  /// m: a ball about x that is smaller neither meets this surface nor reaches behind it. A bound that costs a few
  /// operations, for surfaces whose distance does not; 0 where none is known.
  virtual double clear_in_front(const Vec3& x) const;
};

/// Diagonal (m) of the box round a bounded surface, seen with triangles of about `edge` (m).
double box_diagonal(const Surface& surface, double edge);

/// Where the geodesic from `from` that begins as ds (m) ends after |ds|, to fourth order (m).
Vec3 along_geodesic(const SurfacePoint& from, const Vec2& ds);

/// An orthonormal tangent basis for the unit normal n: the same for the same n, T.col(0) x T.col(1) = n.
Mat32 tangent_basis(const Vec3& n);

}  // namespace genu
