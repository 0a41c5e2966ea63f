// Adds the wrench and stiffness between two bodies to those of the moving bodies.
#pragma once

#include "genu/core/types.h"
#include "genu/core/which_move.h"
#include "genu/model/ligament.h"

namespace genu {

class TwoBodyScatter {
 public:
  /// Indices among the moving bodies, -1 for a fixed one.
  TwoBodyScatter(int moving_a, int moving_b) : index_{moving_a, moving_b} {}

  void add_wrench(const Vec12& wrench, VecX& out) const {
    for (int i = 0; i < 2; ++i)
      if (index_[i] >= 0) out.segment<6>(6 * index_[i]) += wrench.segment<6>(6 * i);
  }
  void add_wrench(const Vec6& on_a, const Vec6& on_b, VecX& out) const {
    if (index_[0] >= 0) out.segment<6>(6 * index_[0]) += on_a;
    if (index_[1] >= 0) out.segment<6>(6 * index_[1]) += on_b;
  }
  void add_stiffness(const Mat12& stiffness, MatX& out) const { add_stiffness(stiffness, *this, out); }
  /// The same where the wrench depends on the twists of two other bodies.
  void add_stiffness(const Mat12& stiffness, const TwoBodyScatter& twists, MatX& out) const {
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        if (index_[i] >= 0 && twists.index_[j] >= 0)
          out.block<6, 6>(6 * index_[i], 6 * twists.index_[j]) += stiffness.block<6, 6>(6 * i, 6 * j);
  }

  WhichMove which_move() const { return {index_[0] >= 0, index_[1] >= 0}; }

 private:
  int index_[2];
};

}  // namespace genu
