// Contact detection over two whole surfaces: candidates for contact, and the proof that there are no others.
//
// One surface is sampled; the other gives the signed distance. The samples are in a tree of spheres. A sphere known to
// be clear is skipped with its contents until the bodies have moved by its clearance. The rest is tested sample by
// sample, and every local minimum among neighbouring samples is refined on the smooth surfaces. Overlap far beyond the
// band where a meshed surface is smooth is found with the nearest triangle; a surface entirely inside the other is
// found with points of its own (swallowed.h).
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "genu/contact/far_distance.h"
#include "genu/contact/local_minimum.h"
#include "genu/contact/rim.h"
#include "genu/contact/sample_tree.h"
#include "genu/contact/swallowed.h"

namespace genu {

/// A sample that overlaps or is near: for compliant seeds and for reporting overlaps.
struct NearSample {
  Vec3 point;       ///< m, in the frame of the sampled body
  Vec3 direction;   ///< unit, in the frame of the other body: gradient of its distance
  double gap = 0;   ///< m
  double area = 0;  ///< m^2
};

struct ProximityScan {
  std::vector<LocalMinimum> minima;  ///< converged local minima below the window, by gap, without duplicates
  std::vector<LocalMinimum> edge;    ///< the gap decreases across the edge of a patch and is below the window there
  double smallest_sample_gap = 0;    ///< m; below the window exact; above it a neighbour's may be smaller. To the
                                     ///< smooth surface within its band, to facets beyond
  NearSample deepest;                ///< the sample of that gap
  double swallowed = 0;              ///< m, < 0: depth of a point of the queried surface inside the sampled one
};

class Proximity {
 public:
  /// `spacing` (m) of samples on surfaces without samples of their own. `reach` (m) bounds unbounded shapes around the
  /// location of the joint.
  struct Options {
    double spacing = 1e-3;
    double reach = 0.1;
    Vec3 centre_a = Vec3::Zero();  ///< m: location of the joint, in the frame of a's body
    Vec3 centre_b = Vec3::Zero();  ///< the same in b's
  };
  /// Copies share what was prepared of the surfaces.
  Proximity(const Surface& a, const Surface& b, const Options& options);

  bool is_between(const Surface& a, const Surface& b) const;
  /// Whether a pair made of these would be prepared in the same way.
  bool is_of(const Surface& a, const Surface& b, const Options& options) const;

  /// Discards all memory.
  void forget();

  /// Searches the whole pair at the relative pose X_ab for gaps below `window` (m).
  void scan(const Pose& X_ab, double window, ProximityScan& out);

  /// The smallest gap of any sample, +infinity where all are clear. Cheap; its error is that of a sample beside the
  /// true minimum.
  double smallest_sample_gap(const Pose& X_ab);

  /// m: largest motion of a point of the sampled surface from one relative pose to another.
  double motion(const Pose& from_ab, const Pose& to_ab) const;

  /// All samples with a gap below `window`, overlapping ones included, wherever they are.
  void near_samples(const Pose& X_ab, double window, std::vector<NearSample>& out);

  /// True when b is sampled and a asked (NearSample's frames), false the other way round.
  bool samples_b() const { return samples_b_; }

  /// The local minimum nearest to `contact` at the pose X_ab; empty when it has left the known surface.
  std::optional<Descent> follow(const Pose& X_ab, const ContactGeometry& contact) const;

  /// Minima beside `contact`, reached from points around it at `radius` (m): finds the second one of a contact about to
  /// split.
  /// Where the gap's curvature exceeds `steep` (1/m) in one direction, two points in the other direction suffice:
  /// further minima of a valley lie along its bottom.
  void probe_around(const Pose& X_ab, const ContactGeometry& contact, double radius, double steep,
                    std::vector<LocalMinimum>& out) const;

  /// Smallest distance (m) of the contact's points to the edges of their patches; negative outside.
  double edge_distance(const ContactGeometry& contact) const;

 private:
  struct Group : SampleNode {
    double clearance = std::numeric_limits<double>::quiet_NaN();  ///< m, at `measured`; none before the first time
    Pose measured = {};
  };

  /// What is known of a sample since it was last tested, in the frame of the queried surface.
  struct Memory {
    Vec3 at = Vec3::Zero(), doubted_at = Vec3::Zero();
    double clearance = -1;  ///< m: clearance from the surface
    double doubt = -1;      ///< m: clearance by facets, where the smooth surface gives the wrong side
  };

  /// A sample that has been tested at some time. Most of a surface never comes near the other.
  struct Tested {
    Memory memory;
    std::optional<SurfacePoint> foot;  ///< on the queried surface at the last measurement, where asked for
    std::optional<SurfacePoint> own;   ///< its place on its own surface, where asked for
  };

  Pose query_from_samples(const Pose& X_ab) const { return samples_b_ ? X_ab : X_ab.inverse(); }
  std::optional<Descent> descend(const Pose& X_qs, const Vec3& start) const;
  std::optional<Descent> descend_from(int sample, const Pose& X_qs, const DescentLimits& limits);
  void find_minima(const Pose& X_qs, double window, ProximityScan& out);
  void find_rims(const Pose& X_qs, ProximityScan& out);
  bool lowest_of_neighbours(int sample) const;
  bool is_bowl(const Mat2& bend) const;
  bool slopes_to_known(int sample) const;
  std::optional<double> near_clearance(std::optional<double> gap) const;
  double far_clearance(const FarDistance::Nearest& nearest, double radius, bool large) const;
  bool clear(Group& group, const Pose& X_qs, double window) const;
  void measure(const Pose& X_qs, double window);
  double sample_gap(const Pose& X_qs, int sample, Vec3* direction);
  double depth_behind(const Pose& X_qs, int sample);
  double doubtful_gap(const Vec3& x, double gap, Memory& memory) const;
  Tested& tested(int sample) {
    int& place = place_[at(sample)];
    if (place < 0) {
      place = static_cast<int>(tested_.size());
      tested_.emplace_back();
    }
    return tested_[at(place)];
  }
  template <typename Visit>
  void visit_near(const Pose& X_qs, double window, Visit visit);

  Options options_;
  const Surface* queried_;
  const Surface* sampled_;
  bool samples_b_;
  double spacing_;
  FarDistance far_;
  double reserve_;  // m: largest distance of facets from the smooth surface
  std::shared_ptr<const SampleSet> samples_;
  std::optional<Swallowed> swallowed_;  // the queried surface in the sampled one
  Rim rim_of_sampled_, rim_of_queried_;
  std::vector<LocalMinimum> rims_;  // as found
  std::vector<int> order_;
  std::vector<Group> groups_;  // the root first
  std::vector<int> open_;
  std::vector<int> touched_;    // groups with a memory
  std::vector<Tested> tested_;  // in order of their first test
  std::vector<int> place_;      // of each sample in tested_; -1 where it is not there
  std::vector<double> gap_;     // of each sample at the last measurement; infinity where clear
  std::vector<int> measured_;   // the samples that have one
  std::vector<int> starts_;     // of descents, by gap
  std::vector<Descent> raw_;    // ends of descents: a of the queried surface, b of the sampled one
};

}  // namespace genu
