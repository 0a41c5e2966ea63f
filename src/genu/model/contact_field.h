// All surface pairs of a model at once: where they are near, overlap, or run over an edge.
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
  std::vector<Candidate> minima;     ///< below the window, pair by pair, by gap
  std::vector<Candidate> edges;      ///< the gap falls across the edge of a patch
  std::vector<double> smallest_gap;  ///< of each pair, m: samples and minima; +infinity when clear beyond the window
};

/// m: how far apart surfaces are looked at; finer where one is small.
double sample_spacing(const JointModel& model);

class ContactField {
 public:
  explicit ContactField(const JointModel& model);

  /// The same field, as if nothing had been looked at yet. What `prepared` has prepared of pairs of the same surfaces is
  /// shared with it where it would come out the same: only numbers differ between the models.
  ContactField(const JointModel& model, const ContactField& prepared);

  /// Points that stand for a surface are about this far apart (m): 1/30 of the characteristic length, 1/60 of the
  /// smallest surface. Every length in the search for contacts is a fraction of it.
  double spacing() const { return spacing_; }

  /// Candidates are looked for below this gap (m); open contacts beyond it are not followed.
  double window() const { return 0.2 * spacing_; }

  /// As if nothing had been looked at yet: what comes out later depends on no earlier state, to the last bit.
  void forget();

  /// Looks at the whole of every pair.
  void survey(const State& state, Survey& out);

  /// The local minimum that continues `contact` at this state, if it still exists.
  std::optional<Descent> follow(const State& state, int pair, const ContactGeometry& contact) const;

  /// Further minima hidden next to a contact between the samples.
  void probe_around(const State& state, int pair, const ContactGeometry& contact, double radius, double steep,
                    std::vector<LocalMinimum>& out) const;

  double edge_distance(int pair, const ContactGeometry& contact) const;

  /// The first doubtful place of a surface that a contact or a layer's pressure at `state` leans on, or where the other
  /// surface comes near to what is missing; null where there is none. `also`: places that are touched beside those
  /// contacts.
  const DoubtfulPlace* doubtful(const State& state, const std::vector<Candidate>& also = {});
  bool any_doubtful() const { return any_doubtful_; }

  /// A layer whose surfaces overlap deeper (m) than its rays look, where it carries nothing: the first there is.
  struct BuriedLayer {
    int layer = 0;
    double depth = 0;  ///< m
  };
  std::optional<BuriedLayer> buried(const State& state);

  /// Smallest gap of a pair wherever it is (m), looked for in growing windows. For results, not for the solver.
  double smallest_gap(const State& state, int pair);

  /// Where that gap is: the local minimum that lies lowest; empty where an edge is nearer, or nothing near.
  std::optional<LocalMinimum> nearest(const State& state, int pair);

  /// Whether no sample of a pair has a gap below this (m), overlapping ones included: cheap.
  bool is_clear(const State& state, int pair, double gap);

  /// How far (m) a point of one surface of a pair moves at most in the frame of the other.
  double motion(const State& from, const State& to, int pair) const;

  /// How far (m) the samples of a pair overlap, 0 where none does: coarse, but cheap however deep it is.
  double overlap(const State& state, int pair);

  /// Wrench and stiffness of an elastic foundation of `modulus` (Pa per m of overlap) under every overlapping sample,
  /// added to `out`; returns the deepest overlap (m, positive). A seed for cold starts, not a cartilage model.
  double add_foundation(const State& state, double modulus, Linearization& out);

 private:
  ContactField(const JointModel& model, const ContactField* prepared);

  /// Where two surfaces touch, in the frames of their bodies, and how far (m) each of these points stands for more.
  struct Feet {
    std::vector<Vec3> on_a, on_b;
    std::vector<double> size;
  };
  template <typename Meeting>
  static const DoubtfulPlace* doubtful_between(const Meeting& surfaces, const Pose& X_ab, const Feet& feet);
  Feet feet_of_pair(const State& state, const std::vector<Candidate>& also, int pair) const;
  Feet feet_of_layer(const State& state, int layer);

  void scan_pairs(const State& state, Survey& out);
  template <typename Meeting>
  Proximity proximity_of(const Meeting& surfaces, const Proximity* prepared = nullptr) const;
  Pose relative(const State& state, int pair) const;

  const JointModel* model_;
  double spacing_;
  bool any_doubtful_ = false;
  std::vector<Proximity> pairs_;
  std::shared_ptr<LayerMemories> layers_;
  std::vector<std::optional<Proximity>> layer_pairs_;  // made when one is asked
  ProximityScan scan_;
  std::vector<NearSample> near_;
};

}  // namespace genu
