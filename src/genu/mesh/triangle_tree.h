// The triangles of a mesh in a tree of boxes, for rays: what a layer's depth is measured with.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "genu/mesh/mesh.h"

namespace genu {

struct RayLine;

/// The triangles of a tree that a ray can come out of while it moves by less than `margin` (m) anywhere.
struct TrianglesAtRay {
  static constexpr int kMost = 6;
  std::array<int, kMost> places;  ///< in the tree
  int count = 0;                  ///< more than kMost: too many to be listed
  int nearest = -1;               ///< the cluster that is: where to begin the next time
  double margin = 0;
};

/// Clusters of a tree's triangles round a place, and balls that hold them side by side.
struct ClustersNear {
  struct Balls {
    static constexpr int kSize = 8;
    using Floats = Eigen::Array<float, kSize, 1>;
    Floats x, y, z, reach;           ///< m: middle, about `centre`; radius
    std::array<int, kSize> cluster;  ///< -1: a slot without one
  };
  Vec3 centre = Vec3::Zero();  ///< m
  double reach = 0;            ///< m: the farthest middle from it
  std::vector<Balls> balls;
  int count = 0;
};

class TriangleTree {
 public:
  /// A triangle met by a ray.
  struct Hit {
    int triangle = -1;    ///< index into the mesh, -1: none
    double distance = 0;  ///< m along the ray
    explicit operator bool() const { return triangle >= 0; }
  };

  TriangleTree() = default;
  explicit TriangleTree(const Mesh& mesh);

  /// The nearest triangle at 0 < distance <= length whose outward side the ray comes out of (normal . direction > 0);
  /// of several at one distance the first of the mesh. Exact at edges: no ray passes between two triangles that share
  /// one. `hint`: a triangle that is likely to be met, which makes the answer faster and never another one.
  /// `direction` is a unit vector.
  Hit leaving(const Vec3& origin, const Vec3& direction, double length, int hint = -1) const;

  /// The same for triangles whose outward side the ray enters (normal . direction < 0).
  Hit entering(const Vec3& origin, const Vec3& direction, double length) const;

  /// Fills `out` with every cluster of triangles (neighbours, by the tree) of which one is within `margin` (m) of the
  /// segment, and with some others.
  void clusters_near(const Vec3& origin, const Vec3& direction, double length, double margin, ClustersNear& out) const;

  /// What a ray can come out of while it moves by less than a margin (m) anywhere: the largest margin up to `most` that
  /// is sure to leave nothing, or else `least`. Nothing outside of `clusters` matters to it then.
  void at_ray(const ClustersNear& clusters, const Vec3& origin, const Vec3& direction, double length, double least,
              double most, TrianglesAtRay& out) const;

  /// What leaving() finds, for a ray to which no triangle matters but these places in the tree, or but some clusters.
  Hit leaving(std::span<const int> places, const Vec3& origin, const Vec3& direction, double length) const;
  Hit leaving(const ClustersNear& among, const Vec3& origin, const Vec3& direction, double length) const;

  enum class Way { out, in };  ///< of a ray through a triangle: out of its outward side, or into it

  /// The first of `margins` (m, falling) such that no triangle that a ray along the segment can pass this way lies
  /// within it of the segment, surely, even when both ends of the ray are moved by less than the margin; their number
  /// where there is none. `met` becomes a triangle that is near, and given again makes the answer faster.
  std::size_t clear_by(const Vec3& origin, const Vec3& direction, double length, std::span<const double> margins,
                       Way way, int& met) const;

  /// The triangles in pieces of at most `size` (m) across, each of neighbours by the tree: for each the first of its
  /// places in the tree, and at the end the number of places.
  std::vector<int> pieces(double size) const;

  /// Where a triangle is in the tree, and the first place of a cluster.
  int place_of(int triangle) const { return place_[static_cast<std::size_t>(triangle)]; }
  int first_place(int cluster) const { return clusters_[static_cast<std::size_t>(cluster)].first; }

  /// Corners of a triangle (m) and its area vector: outward, as long as the area is large (m^2).
  const std::array<Vec3, 3>& corners(int triangle) const { return corners_[place(triangle)]; }
  const Vec3& area_vector(int triangle) const { return areas_[place(triangle)]; }

  int size() const { return static_cast<int>(corners_.size()); }

 private:
  friend class TriangleSheet;

  static constexpr int kMostDepth = 64;  // of the tree: halves of at most 2^31 triangles

  struct Node {
    Vec3 low, high;
    int first = 0, last = 0;  ///< triangles, in the tree's order
    int children = -1;        ///< index of the first of two; -1 for a leaf
    int cluster = -1;         ///< its number, where the triangles are one
  };
  /// The balls that hold some triangles, and their outward unit normals, side by side: a ray is asked of all at once.
  struct Cluster {
    static constexpr int kSize = 16;
    using Floats = Eigen::Array<float, kSize, 1>;
    Vec3 centre = Vec3::Zero();          ///< m: the balls' middles are about it
    double reach = 0;                    ///< m: a ball about it holds the triangles
    Vec3 low, high;                      ///< m: a box that holds them
    Floats x, y, z, radius, nx, ny, nz;  ///< m; unit
    int first = 0, count = 0;            ///< triangles, in the tree's order
  };

  std::size_t place(int triangle) const { return static_cast<std::size_t>(place_[static_cast<std::size_t>(triangle)]); }
  template <typename Visit>
  void each_place(const ClustersNear& among, Visit visit) const {
    for (int i = 0; i < among.count; ++i) {
      const auto& balls = among.balls[static_cast<std::size_t>(i / ClustersNear::Balls::kSize)];
      const int index = balls.cluster[static_cast<std::size_t>(i % ClustersNear::Balls::kSize)];
      const Cluster& c = clusters_[static_cast<std::size_t>(index)];
      for (int k = c.first; k < c.first + c.count; ++k) visit(k);
    }
  }
  struct Asked;
  void ask(int cluster, const Asked& ray, double& free, TrianglesAtRay& out) const;
  static Cluster::Floats room(const Cluster& cluster, const Vec3& from, const Vec3& direction, double length);
  void gather_clusters();
  void find_neighbours(const Mesh& mesh);
  void build();
  void split(int node);
  bool misses(std::size_t k, const RayLine& line, double turn, double aside) const;
  void meet(std::size_t k, const RayLine& line, double side, Hit& best) const;
  void search(const RayLine& line, double side, Hit& best) const;

  std::vector<std::array<Vec3, 3>> corners_;  // in the tree's order
  std::vector<Vec3> areas_;
  std::vector<double> sizes_;                 // m^2
  std::vector<std::array<int, 3>> vertices_;  // of the mesh
  std::vector<std::array<int, 3>> beside_;    // across the edge from corner i to the next; -1: none, or several
  int vertex_count_ = 0;
  std::vector<int> triangle_;  // of the mesh, in the tree's order
  std::vector<int> place_;     // the other way round
  std::vector<Node> nodes_;    // the root first
  std::vector<Cluster> clusters_;
};

}  // namespace genu
