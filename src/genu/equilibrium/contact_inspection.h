// Checks the contacts of a converged pose. If all conditions hold, the pose gets its certificate.
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "genu/model/contact_field.h"

namespace genu {

/// What was verified at an accepted pose, with margins.
struct Certificate {
  double residual = 0;        ///< scaled
  double smallest_force = 0;  ///< N, +infinity without contact
  double smallest_gap = 0;    ///< m, minimum over all pairs; +infinity when all are clear
  double least_opposed = -1;  ///< largest n_A . n_B of any contact; -1: exactly opposed
  double edge_distance = 0;   ///< m: least distance of a contact point to the edge of its patch
  int blocking = 0;  ///< as `touching`, and along valleys of pairs without a contact: places that block a motion
  int touching = 0;  ///< places where surfaces touch (gap 0 to rounding) without an active contact
};

/// Conditions that a converged state violates.
struct Findings {
  std::vector<int> pulling;                 ///< active contacts with negative force, worst first
  std::vector<Candidate> overlapping;       ///< minima with negative gap that are not active, deepest first
  std::vector<std::pair<int, int>> merged;  ///< active contacts at the same place: an earlier and a later one
  std::vector<int> not_minimal;             ///< active contacts at a saddle of the gap
  std::vector<Candidate> beside;            ///< minima found beside those saddles
  std::vector<int> left_piece;              ///< entries of State::pieces whose ligament has left its piece of the law
  std::vector<int> left_touch;              ///< entries of State::wraps that have to touch or leave
  bool over_edge = false;                   ///< a contact point or an overlap lies past the edge of a patch
  bool deep_overlap = false;                ///< samples overlap and no contact explains it
  bool doubtful = false;                    ///< a contact touches a place where a mesh is flawed
  bool slips_off = false;                   ///< a path over surfaces is no local minimum of its length
  bool lifts_off = false;                   ///< a path touches a surface where that is hollow
  double worst = std::numeric_limits<double>::infinity();  ///< smallest of scaled forces and of scaled gaps without a
                                                           ///< contact; < 0: violated
  std::string where;  ///< place for over_edge, deep_overlap, doubtful, slips_off and lifts_off, in words

  bool left_a_piece() const { return !left_piece.empty() || !left_touch.empty(); }
  bool only_left_piece() const {
    return left_piece.size() + left_touch.size() == 1 && pulling.empty() && overlapping.empty() &&
           not_minimal.empty() && merged.empty() && !final();
  }
  /// The only violation: contacts pull, or one place overlaps, or one contact splits.
  bool only_a_contact() const {
    const bool pulls = !pulling.empty() && overlapping.empty() && not_minimal.empty();
    const bool overlaps = pulling.empty() && overlapping.size() == 1 && not_minimal.empty();
    const bool splits = pulling.empty() && not_minimal.size() == 1;
    return (pulls || overlaps || splits) && merged.empty() && !left_a_piece() && !final();
  }
  bool none() const {
    return pulling.empty() && overlapping.empty() && not_minimal.empty() && merged.empty() && !left_a_piece() &&
           !final();
  }
  /// Violations that no change of the active set can repair.
  bool final() const { return over_edge || deep_overlap || doubtful || slips_off || lifts_off; }
};

/// Smallest relative curvature of the two surfaces at a contact over all tangent directions, 1/m.
double least_curvature(const JointModel& model, const State& state, const ActiveContact& contact);

/// Whether two contacts of one pair are closer to each other than `distance` (m) on both surfaces.
bool same_place(const ContactGeometry& x, const ContactGeometry& y, double distance);

class ContactInspector {
 public:
  ContactInspector(const JointModel& model, ContactField& field);

  /// m: a smaller overlap counts as zero. The larger of 1e-12 of the characteristic length and the rounding error at
  /// the bodies' distance from the world's origin. Where two contacts are about to merge, an overlap of 1 nm turns a
  /// body by 0.001 deg.
  double gap_tolerance() const { return gap_tolerance_; }

  /// m: an active contact and a refined minimum closer than this are the same.
  double same_contact() const { return 2e-3 * field_->spacing(); }

  void inspect(const State& state, Findings& out);

  /// Places where surfaces touch at a point, in the state inspected last, without an active contact.
  enum class Touching { places, all };  ///< all: also along valleys, of pairs without a contact
  std::vector<Candidate> touching(const State& state, Touching which = Touching::places, double within = 0) const;

  /// Distance of the only contact in `found` (only_a_contact()) from its violation at another state of the same
  /// contacts, scaled: of its force (the least of several) or of its gap; <= 0 beyond it. Of a split only the sign: 1
  /// or -1. NaN where the place that overlaps is lost; it is followed from that in `found`, which moves with it.
  double margin_of_contact(const State& state, Findings& found);

  /// The certificate of the state inspected last.
  Certificate certify(const State& state, double residual) const;

  /// Whether the candidate is already a contact of `state`.
  bool held(const State& state, const Candidate& candidate) const;

  /// The part of inspect() without any search: force and edge of each active contact.
  void inspect_forces(const State& state, Findings& out) const;

  /// The part of inspect() that looks at active contacts one by one: force, edge, relative curvature.
  void inspect_held(const State& state, Findings& out);

 private:
  void look_for_merged(const State& state, Findings& out) const;
  void look_beside(const State& state, int contact, Findings& out);
  void look_everywhere(const State& state, Findings& out);
  void look_for_buried(const State& state, Findings& out);
  void look_for_doubt(const State& state, Findings& out);

  const JointModel* model_;
  ContactField* field_;
  double gap_tolerance_;
  Survey survey_;
  std::vector<LocalMinimum> beside_;
  std::vector<Candidate> beyond_edge_;
};

}  // namespace genu
