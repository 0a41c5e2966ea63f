// Rays from one surface into another, cast at many successive poses. Rays without a hit are skipped until the bodies
// have moved by their clearance, so that the cost depends on the contact and not on the mesh.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "genu/core/pose.h"
#include "genu/mesh/sheet_atlas.h"

namespace genu {

struct Ray {
  Vec3 origin = Vec3::Zero();      ///< m, in the frame of the casting body
  Vec3 direction = Vec3::UnitZ();  ///< unit
};

class LayerRays {
 public:
  /// How rays without a hit are separated from the others: one by one, where each is expensive, or in groups of
  /// neighbours, where each only needs its hit.
  enum class Grouping { single, together };

  /// Rays of `length` (m) into the triangles of `target`. `radii` (m): each ray represents everything within its
  /// radius. `lead` (m): the first part of each ray, where it may enter the target.
  LayerRays(std::vector<Ray> rays, std::shared_ptr<const TriangleTree> target, double length, Grouping grouping,
            std::vector<double> radii = {}, double lead = 0);

  /// Results of earlier poses: they make the next cast faster and never change it. One for each thread.
  struct Memory {
    struct Group {
      double clear = -1;  ///< m: clearance when measured; 0: near, -1: never measured
      int near = -1;      ///< a triangle of the target that was near
      Pose measured;
    };
    /// Of a leaf: the path length of its rays, and the triangles they can meet up to a later path length.
    struct Block {
      Pose last;
      double path = -1;  ///< m: upper bound of the motion of any point of its rays since the first pose; -1: none yet
      double empty_until = 0;  ///< m: path length up to which no ray meets anything
      double near_until = 0;   ///< m: path length up to which the leaf counts as near something
      int near = -1;           ///< a triangle of the target that was near
      int piece = -1;          ///< piece whose sheet a ray crossed last,
      int facet = 0;           ///< and the facet there
      ClustersNear clusters;
      double until = -1;  ///< m: path length up to which the clusters are valid
    };
    struct AtRay {
      int piece = -1;  ///< piece of the target whose sheet the ray may cross
      int facet = 0;   ///< facet of that sheet where it did
      TrianglesAtRay triangles;
      double until = -1;                ///< m: path length of the block up to which the triangles are valid
      double unentered = 0;             ///< m: length within which the ray enters nothing
      double unentered_until = -1;      ///< m: path length up to which this is known,
      double unentered_next_time = -1;  ///< and, where it is not, up to which it is not tried again
    };
    /// A ray that met the target.
    struct Found {
      int ray;
      TriangleTree::Hit hit;
    };
    /// What a cast found, for the same pose again. Columns are asked of an accepted pose only after the events up to
    /// it, which have a few poses of their own: so many casts are kept.
    struct Cast {
      Pose at;
      std::vector<std::vector<Found>> found;  ///< of each part
      std::vector<char> done;                 ///< whether the part was cast
    };
    static constexpr std::size_t kCasts = 4;

    std::vector<Group> groups;
    std::vector<Block> blocks;  ///< of each leaf
    std::vector<AtRay> rays;
    std::vector<double> skip_until;      ///< m, by the order of the rays: path length up to which a ray meets nothing
    std::vector<std::vector<int>> open;  ///< of each part
    std::array<Cast, kCasts> casts;      ///< the last new ones, in turn
    std::size_t cast = 0, oldest = 0;    ///< the one that begin() chose; the one that a new one takes the place of
  };

  /// Parts of the rays that may be cast in parallel with one memory. Their number does not depend on the number of
  /// threads.
  static constexpr int kMostParts = 16;
  int parts() const { return static_cast<int>(parts_.size()); }

  /// Prepares a memory for casts of all parts at a pose of the casting body in the target's frame.
  void begin(const Pose& X_TC, Memory& memory) const;

  /// Calls visit(ray, hit, origin, direction), the ray in the target's frame, for every ray of a part that leaves the
  /// target through a triangle (TriangleTree::leaving) without having entered it before (after its lead), in an order
  /// that depends on the rays only. Call begin() with the same pose first.
  template <typename Visit>
  void cast_part(int part, const Pose& X_TC, Memory& memory, Visit visit) const {
    Memory::Cast& cast = memory.casts[memory.cast];
    std::vector<Memory::Found>& found = cast.found[static_cast<std::size_t>(part)];
    char& done = cast.done[static_cast<std::size_t>(part)];
    if (done != 0) {
      for (const auto& [ray, hit] : found) {
        const Ray& r = rays_[static_cast<std::size_t>(ray)];
        visit(ray, hit, X_TC * r.origin, X_TC.R * r.direction);
      }
      return;
    }
    found.clear();
    each_near_group(part, X_TC, memory, [&](const Group& group) {
      Memory::Block& block = advance(group, X_TC, memory);
      if (clear(group, X_TC, block)) return;
      block.empty_until = std::numeric_limits<double>::infinity();
      for (int k = group.first; k < group.last; ++k) {
        double& skip_until = memory.skip_until[static_cast<std::size_t>(k)];
        if (!(block.path < skip_until)) {
          const int index = order_[static_cast<std::size_t>(k)];
          const Ray& ray = rays_[static_cast<std::size_t>(index)];
          Memory::AtRay& known = memory.rays[static_cast<std::size_t>(index)];
          const Vec3 origin = X_TC * ray.origin, direction = X_TC.R * ray.direction;
          if (const TriangleTree::Hit hit = meet({origin, direction}, group, block, known)) {
            found.push_back({index, hit});
            visit(index, hit, origin, direction);
          }
          skip_until = known.triangles.count > 0 ? -1 : known.until;
        }
        block.empty_until = std::min(block.empty_until, skip_until);
      }
    });
    done = 1;
  }

  /// The same for all parts in turn.
  template <typename Visit>
  void cast(const Pose& X_TC, Memory& memory, Visit visit) const {
    begin(X_TC, memory);
    for (int part = 0; part < parts(); ++part) cast_part(part, X_TC, memory, visit);
  }

  /// Calls visit(ray) for every ray that may have a triangle within its radius, and for some that have none, in an
  /// order that depends on the rays only.
  template <typename Visit>
  void each_near(const Pose& X_TC, Memory& memory, Visit visit) const {
    prepare(memory);
    for (int part = 0; part < parts(); ++part)
      each_near_group(part, X_TC, memory, [&](const Group& group) {
        for (int k = group.first; k < group.last; ++k) visit(order_[static_cast<std::size_t>(k)]);
      });
  }

  /// m: upper bound of the motion of any point of any ray between two poses.
  double motion(const Pose& from, const Pose& to) const { return rays_.empty() ? 0 : motion(groups_[0], from, to); }

  const std::vector<Ray>& rays() const { return rays_; }
  const TriangleTree& target() const { return *target_; }
  double length() const { return length_; }

 private:
  /// Rays [first, last) of order_, all within `radius` of a central one over its whole length.
  struct Group {
    int first = 0, last = 0;
    int children = -1;  ///< index of the first of two, -1 for a leaf
    int leaf = -1;      ///< its index among the leaves
    Ray middle;
    double radius = 0;  ///< m
  };

  /// Calls visit(group) for every leaf of a part that may be near the target.
  template <typename Visit>
  void each_near_group(int part, const Pose& X_TC, Memory& memory, Visit visit) const {
    std::vector<int>& open = memory.open[static_cast<std::size_t>(part)];
    open.assign(1, parts_[static_cast<std::size_t>(part)]);
    while (!open.empty()) {
      const int index = open.back();
      open.pop_back();
      const Group& group = groups_[static_cast<std::size_t>(index)];
      const bool leaf_of_cast = group.children < 0 && leaf_ > 1;  // it tests this itself
      if (!leaf_of_cast && clear(group, X_TC, memory.groups[static_cast<std::size_t>(index)])) continue;
      if (group.children < 0) {
        visit(group);
        continue;
      }
      open.push_back(group.children + 1);
      open.push_back(group.children);
    }
  }

  Memory::Block& advance(const Group& group, const Pose& X_TC, Memory& memory) const;
  /// The hit of a ray given in the target's frame.
  TriangleTree::Hit meet(const Ray& ray, const Group& group, Memory::Block& block, Memory::AtRay& known) const;
  bool enters_before(const Ray& ray, const TriangleTree::Hit& hit, const Memory::Block& block,
                     Memory::AtRay& known) const;
  bool meet_sheet(const Ray& ray, Memory::Block& block, Memory::AtRay& known, TriangleTree::Hit& hit) const;
  TriangleTree::Hit meet_listed(const Ray& ray, Memory::Block& block, Memory::AtRay& known) const;
  void gather(const Group& group, Memory::Block& block) const;
  bool clear(const Group& group, const Pose& X_TC, Memory::Group& known) const;
  bool clear(const Group& group, const Pose& X_TC, Memory::Block& block) const;
  double measure(const Group& group, const Pose& X_TC, int& near) const;
  double motion(const Group& group, const Pose& from, const Pose& to) const;
  void prepare(Memory& memory) const;
  void enclose(Group& group) const;
  void split(int group);
  void find_parts();

  std::vector<Ray> rays_;
  std::vector<double> radii_;
  std::shared_ptr<const TriangleTree> target_;
  double length_, lead_;
  double step_ = 0;            // m: unit of clearances, about an edge length of the target
  std::size_t levels_ = 0;     // number of distinct clearances
  int leaf_ = 1, leaves_ = 0;  // most rays in a leaf; number of leaves
  std::vector<int> order_;
  std::vector<Group> groups_;                // the root first
  std::vector<int> parts_;                   // groups that contain each ray once, in order
  std::shared_ptr<const SheetAtlas> atlas_;  // of the target, for casting
};

}  // namespace genu
