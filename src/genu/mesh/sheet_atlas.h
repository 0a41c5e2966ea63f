// Sheets all over a mesh, each spread when a ray first comes by, and then there for all poses and all threads.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "genu/mesh/triangle_sheet.h"

namespace genu {

class SheetAtlas {
 public:
  /// For rays of `length` (m).
  SheetAtlas(std::shared_ptr<const TriangleTree> tree, double length);

  /// The piece of the mesh that a triangle belongs to, by its place in the tree.
  int piece_of(int place) const { return piece_of_[at(place)]; }
  int pieces() const { return static_cast<int>(first_.size()) - 1; }

  /// The sheet round a piece. May be called from many threads.
  const TriangleSheet& sheet(int piece) const {
    const TriangleSheet* known = sheets_[at(piece)].load(std::memory_order_acquire);
    return known != nullptr ? *known : spread(piece);
  }

 private:
  const TriangleSheet& spread(int piece) const;

  std::shared_ptr<const TriangleTree> tree_;
  double length_;
  std::vector<int> first_, piece_of_;  // the first place of each piece; of each place
  mutable std::vector<std::atomic<const TriangleSheet*>> sheets_;
  mutable std::mutex spreading_;
  mutable std::vector<std::unique_ptr<TriangleSheet>> kept_;
  mutable TriangleSheet::Marks marks_;
};

}  // namespace genu
