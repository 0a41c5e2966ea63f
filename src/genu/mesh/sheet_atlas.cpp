#include "genu/mesh/sheet_atlas.h"

#include <algorithm>

namespace genu {
namespace {

constexpr double kPiece = 1.5;  // of the length of a ray: a piece's size

}  // namespace

SheetAtlas::SheetAtlas(std::shared_ptr<const TriangleTree> tree, double length)
    : tree_(std::move(tree)),
      length_(length),
      first_(tree_->pieces(kPiece * length)),
      piece_of_(at(tree_->size())),
      sheets_(first_.size() - 1) {
  for (std::size_t i = 0; i + 1 < first_.size(); ++i)
    std::fill(piece_of_.begin() + first_[i], piece_of_.begin() + first_[i + 1], static_cast<int>(i));
}

const TriangleSheet& SheetAtlas::spread(int piece) const {
  const std::lock_guard lock(spreading_);
  auto& slot = sheets_[at(piece)];
  if (const TriangleSheet* known = slot.load(std::memory_order_acquire)) return *known;
  auto made = std::make_unique<TriangleSheet>();
  made->spread(*tree_, first_[at(piece)], first_[at(piece) + 1], length_, marks_);
  slot.store(made.get(), std::memory_order_release);
  kept_.push_back(std::move(made));
  return *kept_.back();
}

}  // namespace genu
