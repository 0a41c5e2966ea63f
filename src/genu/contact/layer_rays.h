// Rays that a surface sends into another one, cast at pose after pose: what cannot meet anything is skipped until the
// bodies have moved by as much as it was clear, so that the cost follows the contact and not the mesh.
#pragma once

#include <memory>
#include <vector>

#include "genu/core/pose.h"
#include "genu/geometry/triangle_tree.h"

namespace genu {

struct Ray {
  Vec3 origin = Vec3::Zero();      ///< m, in the frame of the casting body
  Vec3 direction = Vec3::UnitZ();  ///< unit
};

class LayerRays {
 public:
  /// How rays are told apart from those that meet nothing: one by one and closely where much depends on each, or a few
  /// neighbours together where each is asked for no more than what it meets.
  enum class Grouping { single, together };

  /// Rays of `length` (m) into the triangles of `target`. `radii` (m): each stands for what is within that of it.
  LayerRays(std::vector<Ray> rays, std::shared_ptr<const TriangleTree> target, double length, Grouping grouping,
            std::vector<double> radii = {});

  /// What is known from earlier poses: makes the next cast faster and never other. One for each thread.
  struct Memory {
    struct Group {
      double clear = -1;  ///< m: so far from everything when it was measured; 0: near, -1: never measured
      int near = -1;      ///< a triangle of the target that was near
      Pose measured;
    };
    /// Of a leaf: the triangles that its rays can meet until they have moved on.
    struct Block {
      ClustersNear clusters;
      Pose last;
      double path = 0;    ///< m: how far any point of its rays has moved since the first pose, at most
      double until = -1;  ///< m: of the path that the triangles are good for
    };
    struct AtRay {
      TrianglesAtRay triangles;
      double until = -1;  ///< m: of the block's path
    };
    std::vector<Group> groups;
    std::vector<Block> blocks;  ///< of each leaf
    std::vector<AtRay> rays;
    std::vector<int> open;
  };

  /// Calls visit(ray, hit, origin, direction) with the ray in the target's frame for every ray that leaves the target
  /// through a triangle (TriangleTree::leaving), in an order that depends on the rays alone. X_TC: casting body in the
  /// target's frame.
  template <typename Visit>
  void cast(const Pose& X_TC, Memory& memory, Visit visit) const {
    memory.blocks.resize(static_cast<std::size_t>(leaves_));
    memory.rays.resize(rays_.size());
    each_near_group(X_TC, memory, [&](const Group& group) {
      Memory::Block& block = advance(group, X_TC, memory);
      if (block.clusters.count == 0) return;
      for (int k = group.first; k < group.last; ++k) {
        const int index = order_[static_cast<std::size_t>(k)];
        const Ray& ray = rays_[static_cast<std::size_t>(index)];
        Memory::AtRay& known = memory.rays[static_cast<std::size_t>(index)];
        if (known.triangles.count == 0 && block.path < known.until) continue;
        const Vec3 origin = X_TC * ray.origin, direction = X_TC.R * ray.direction;
        if (const TriangleTree::Hit hit = meet(origin, direction, block, known)) visit(index, hit, origin, direction);
      }
    });
  }

  /// Calls visit(ray) for every ray that may have a triangle within its radius, and for some that have none, in an
  /// order that depends on the rays alone.
  template <typename Visit>
  void each_near(const Pose& X_TC, Memory& memory, Visit visit) const {
    each_near_group(X_TC, memory, [&](const Group& group) {
      for (int k = group.first; k < group.last; ++k) visit(order_[static_cast<std::size_t>(k)]);
    });
  }

  const std::vector<Ray>& rays() const { return rays_; }
  const TriangleTree& target() const { return *target_; }
  double length() const { return length_; }

 private:
  /// Rays [first, last) of order_, all within `radius` of a middle one over its whole length.
  struct Group {
    int first = 0, last = 0;
    int children = -1;  ///< index of the first of two, -1 for a leaf
    int leaf = -1;      ///< its number among the leaves
    Ray middle;
    double radius = 0;  ///< m
  };

  /// Calls visit(group) for every leaf that is not clear of the target.
  template <typename Visit>
  void each_near_group(const Pose& X_TC, Memory& memory, Visit visit) const {
    begin(memory);
    while (!memory.open.empty()) {
      const int index = memory.open.back();
      memory.open.pop_back();
      const Group& group = groups_[static_cast<std::size_t>(index)];
      if (clear(group, X_TC, memory.groups[static_cast<std::size_t>(index)])) continue;
      if (group.children < 0) {
        visit(group);
        continue;
      }
      memory.open.push_back(group.children + 1);
      memory.open.push_back(group.children);
    }
  }

  void begin(Memory& memory) const;
  Memory::Block& advance(const Group& group, const Pose& X_TC, Memory& memory) const;
  TriangleTree::Hit meet(const Vec3& origin, const Vec3& direction, const Memory::Block& block,
                         Memory::AtRay& known) const;
  bool clear(const Group& group, const Pose& X_TC, Memory::Group& known) const;
  void measure(const Group& group, const Pose& X_TC, Memory::Group& known) const;
  double motion(const Group& group, const Pose& from, const Pose& to) const;
  void enclose(Group& group) const;
  void split(int group);

  std::vector<Ray> rays_;
  std::vector<double> radii_;
  std::shared_ptr<const TriangleTree> target_;
  double length_;
  double step_ = 0;            // m: the unit of clearances, about an edge of the target
  std::size_t levels_ = 0;     // of clearances that are told apart
  int leaf_ = 1, leaves_ = 0;  // rays in a leaf at most; how many leaves there are
  std::vector<int> order_;
  std::vector<Group> groups_;  // the root first
};

}  // namespace genu
