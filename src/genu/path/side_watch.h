// Paths over surfaces that keep their side while another one becomes shorter. A frictionless string that is held on its
// side does so too, hence nothing changes; but of a ligament without a given side the user may expect the shortest way.
//
// The other way is sought opposite to the middle of the touch, where the straight line shows that it may be shorter at
// all, and is then carried on from pose to pose beside the path's own.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "genu/model/joint_model.h"
#include "genu/model/state.h"

namespace genu {

class SideWatch {
 public:
  explicit SideWatch(const JointModel& model);

  /// Pairs of a path that may choose its side and one of its surfaces.
  std::size_t count() const { return watched_.size(); }

  /// Carries the other way of pair i on to a state, or seeks it. False where none is known.
  bool carry(std::size_t i, const State& state);
  /// Whether the other way of pair i has become shorter by more than kShorterShare since the last call. `excess`: that
  /// of excess(); NaN tells nothing.
  bool passed(std::size_t i, double excess) {
    if (std::isnan(excess)) return false;
    const bool before = watched_[i].shorter;
    watched_[i].shorter = excess > 0;
    return !before && watched_[i].shorter;
  }
  /// How much shorter the other way of pair i is at a state near the last one carried to, over the path's length, less
  /// kShorterShare. NaN where it is not found.
  double excess(std::size_t i, const State& state) const;
  /// The path and the surface, in words.
  std::string what(std::size_t i) const;

  template <typename Archive>
  void serialize(Archive& archive) {
    for (Watched& w : watched_) archive(w.known, w.shorter, w.sought_at, w.other);
  }

 private:
  struct Watched {
    const LigamentPath* path;
    std::size_t surface;  ///< index into its obstacles: the one that is passed on the other side
    std::string name;
    Wraps other = {};
    bool known = false, shorter = false;
    double sought_at = 1;  ///< the straight line over the path's length where the other way was sought last
  };
  bool seek(Watched& w, const State& state) const;

  std::vector<Watched> watched_;
};

}  // namespace genu
