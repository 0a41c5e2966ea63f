// Contact detection for all surface pairs of a model: where they are close, overlap, or cross an edge.
#pragma once

#include <string>
#include <vector>

#include "genu/contact/proximity.h"
#include "genu/model/linearization.h"

namespace genu {

/// A local minimum of the gap of one pair.
struct Candidate {
  int pair = 0;
  LocalMinimum minimum;
};

struct Survey {
  std::vector<Candidate> minima;  ///< below the window, pair by pair, by gap
  std::vector<Candidate> edges;   ///< the gap decreases across the edge of a patch
  std::vector<double>
      smallest_gap;  ///< of each pair, m: over samples and minima; +infinity when clear beyond the window
};

/// m: spacing of the samples on surfaces; finer where a surface is small.
double sample_spacing(const JointModel& model);

class ContactField {
 public:
  explicit ContactField(const JointModel& model);

  /// The same field, as if nothing had been looked at yet. What `prepared` has prepared of pairs of the same surfaces
  /// is shared with it where it would come out the same: only numbers differ between the models.
  ContactField(const JointModel& model, const ContactField& prepared);

  /// m: spacing of the samples that represent a surface: 1/30 of the characteristic length, or 1/60 of the smallest
  /// surface. All lengths in the search for contacts are fractions of it.
  double spacing() const { return spacing_; }

  /// m: candidates are searched below this gap; open contacts with a larger one are not followed.
  double window() const { return 0.2 * spacing_; }

  /// Discards all memory, so that later results do not depend on earlier states, to the last bit.
  void forget();

  /// Searches every pair completely.
  void survey(const State& state, Survey& out);

  /// The local minimum that continues `contact` at this state, if it exists.
  std::optional<Descent> follow(const State& state, int pair, const ContactGeometry& contact) const;

  /// Further minima next to a contact, hidden between the samples.
  void probe_around(const State& state, int pair, const ContactGeometry& contact, double radius, double steep,
                    std::vector<LocalMinimum>& out) const;

  double edge_distance(int pair, const ContactGeometry& contact) const;

  /// The first doubtful place of a surface that a contact or a layer's pressure at `state` touches, or where the other
  /// surface comes close to missing surface; null where there is none. `also`: further places to check besides those
  /// contacts.
  const DoubtfulPlace* doubtful(const State& state, const std::vector<Candidate>& also = {});
  bool any_doubtful() const { return any_doubtful_; }

  /// A layer without load whose surfaces overlap deeper (m) than its rays reach: the first one.
  struct BuriedLayer {
    int layer = 0;
    double depth = 0;  ///< m
  };
  std::optional<BuriedLayer> buried(const State& state);

  /// m: smallest gap of a pair anywhere, searched in growing windows. For results, not for the solver.
  double smallest_gap(const State& state, int pair);

  /// The lowest local minimum of the gap. Empty where an edge is closer or nothing is near.
  std::optional<LocalMinimum> nearest(const State& state, int pair);

  /// Whether no sample of a pair has a gap below this (m), overlapping samples included. Cheap.
  bool is_clear(const State& state, int pair, double gap);

  /// m: largest displacement of a point of one surface of a pair in the frame of the other.
  double motion(const State& from, const State& to, int pair) const;

  /// m: deepest overlap of the samples of a pair, 0 where none overlaps. Coarse, and cheap at any depth.
  double overlap(const State& state, int pair);

  /// Adds to `out` the wrench and stiffness of an elastic foundation of `modulus` (Pa per m of overlap) under every
  /// overlapping sample. Returns the deepest overlap (m, positive). For seeds of cold starts; no cartilage model.
  double add_foundation(const State& state, double modulus, Linearization& out);

 private:
  ContactField(const JointModel& model, const ContactField* prepared);

  /// Points of contact of two surfaces, in the frames of their bodies, with the extent (m) that each represents.
  struct Feet {
    std::vector<Vec3> on_a, on_b;
    std::vector<double> size;
  };
  template <typename Meeting>
  static const DoubtfulPlace* doubtful_between(const Meeting& surfaces, const Pose& X_ab, const Feet& feet);
  Feet feet_of_pair(const State& state, const std::vector<Candidate>& also, int pair) const;
  Feet feet_of_layer(const State& state, int layer);

  void scan_pairs(const State& state, Survey& out);
  double spacing_of(const JointModel& model, const ContactField* prepared) const;
  template <typename Meeting>
  Proximity proximity_of(const Meeting& surfaces, const Proximity* prepared = nullptr) const;
  Pose relative(const State& state, int pair) const;

  const JointModel* model_;
  double length_;  // m: characteristic length that spacing_ was chosen for
  double spacing_;
  bool any_doubtful_ = false;
  std::vector<Proximity> pairs_;
  std::shared_ptr<LayerMemories> layers_;
  std::vector<std::optional<Proximity>> layer_pairs_;  // made on demand
  ProximityScan scan_;
  std::vector<NearSample> near_;
};

}  // namespace genu
