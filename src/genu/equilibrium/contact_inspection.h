// Looking at a converged pose: what is wrong with its contacts, and the certificate when nothing is.
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "genu/model/contact_field.h"

namespace genu {

/// What was verified at an accepted pose, and by how much.
struct Certificate {
  double residual = 0;        ///< scaled
  double smallest_force = 0;  ///< N, +infinity without contact
  double smallest_gap = 0;    ///< m, over the whole of every pair; +infinity when all are clear
  double least_opposed = -1;  ///< largest n_A . n_B of any contact, -1 is exactly opposed
  double edge_distance = 0;   ///< m: least distance of a contact point to an edge of its patch
  int barring = 0;            ///< the same, and of pairs without a contact along valleys too: what bars a motion
  int touching = 0;           ///< places where surfaces touch, gap 0 to rounding, and no contact is held
};

/// What is wrong with a converged state.
struct Findings {
  std::vector<int> pulling;                 ///< active contacts with negative force, worst first
  std::vector<Candidate> overlapping;       ///< minima with negative gap that are not held, deepest first
  std::vector<std::pair<int, int>> merged;  ///< active contacts at one place: an earlier and a later one
  std::vector<int> not_minimal;             ///< active contacts at a saddle of the gap
  std::vector<Candidate> beside;            ///< minima found beside those
  std::vector<int> left_piece;              ///< entries of State::pieces whose ligament has left its piece of the law
  bool over_edge = false;                   ///< a contact point or an overlap lies past the edge of a patch
  bool deep_overlap = false;                ///< samples overlap where no contact explains it
  bool doubtful = false;                    ///< a contact leans on a place where a mesh is flawed
  double worst =
      std::numeric_limits<double>::infinity();  ///< smallest of scaled forces and gaps not held: < 0 when wrong
  std::string where;                            ///< for over_edge, deep_overlap and doubtful, in words

  bool only_left_piece() const {
    return !left_piece.empty() && pulling.empty() && overlapping.empty() && not_minimal.empty() && merged.empty() &&
           !over_edge && !deep_overlap && !doubtful;
  }
  bool none() const {
    return pulling.empty() && overlapping.empty() && not_minimal.empty() && merged.empty() && left_piece.empty() &&
           !over_edge && !deep_overlap && !doubtful;
  }
  /// Nothing that a change of the contact set could mend.
  bool final() const { return over_edge || deep_overlap || doubtful; }
};

/// How much the surfaces bend away from each other at a contact, in the direction in which they do so least, 1/m.
double least_curvature(const JointModel& model, const State& state, const ActiveContact& contact);

/// Whether two contact geometries of one pair are nearer to each other than `distance` (m) on both surfaces.
bool same_place(const ContactGeometry& x, const ContactGeometry& y, double distance);

class ContactInspector {
 public:
  ContactInspector(const JointModel& model, ContactField& field);

  /// An overlap below this (m) is none: 1e-12 of the characteristic length, and what rounding makes of the distance of
  /// the bodies from the world's origin. Two contacts about to merge turn an overlap of 1 nm into 0.001 deg.
  double gap_tolerance() const { return gap_tolerance_; }

  /// A held contact and a refined minimum closer than this (m) are the same one.
  double same_contact() const { return 2e-3 * field_->spacing(); }

  void inspect(const State& state, Findings& out);

  /// Where surfaces touch, at a point, in the state inspected last and no contact is held.
  enum class Touching { places, all };  ///< all: along valleys too, of pairs that hold no contact
  std::vector<Candidate> touching(const State& state, Touching which = Touching::places, double within = 0) const;

  /// The facts at the state inspected last.
  Certificate certify(const State& state, double residual) const;

  /// Whether a contact of `state` is this candidate.
  bool held(const State& state, const Candidate& candidate) const;

  /// Of that, what concerns the contacts that are held, one by one: their forces, edges and relative curvature.
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
