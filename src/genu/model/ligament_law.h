// The law of one ligament: a force-length law (law/force_law.h) with its slack length, cut into pieces at its sharp
// breaks.
//
// Beyond a sharp break a piece continues straight with the force and stiffness it has there. A solver keeps to one
// piece while it iterates. At the other breaks a law can be solved as it is.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "genu/law/force_law.h"
#include "genu/scene/scene.h"

namespace genu {

class LigamentLaw {
 public:
  /// As a piece: whichever the length lies in.
  static constexpr int kByLength = -1;

  /// A law of the caller's own. Empty where its breaks are not finite, positive and increasing, or differ from what it
  /// evaluates to just beside them; then `why` says what is wrong.
  static std::optional<LigamentLaw> custom(std::shared_ptr<const ForceLaw> law, std::string& why);

  /// Length in m, >= 0.
  LawValue evaluate(double length) const;

  /// The same on one piece (0 for lengths up to the first sharp break), which beyond its ends goes on straight.
  LawValue evaluate(double length, int piece) const;

  /// Derivatives by the law's numbers and its slack length; where the law is slack those of the force are 0.
  LawRates rates(double length) const;

  /// All breaks, by increasing length.
  const std::vector<LawBreak>& breaks() const { return breaks_; }

  /// Those at which force or stiffness jumps: where pieces meet.
  const std::vector<LawBreak>& sharp_breaks() const { return sharp_breaks_; }

  /// Whether the force is 0 on the whole of a piece.
  bool is_slack(int piece) const;

  /// The piece a length lies in: a sharp break belongs to the shorter side.
  int piece_at(double length) const;

  /// (L - L0) / L0; NaN for a law without a slack length and for a spring of slack length 0, which have no strain.
  double strain(double length) const;

  /// L0, m; NaN for a law that has none.
  double slack_length() const { return slack_length_; }

  /// Up to this length (m) force, stiffness and energy are exactly 0; negative for a law that is never slack.
  double slack_until() const { return slack_until_; }

 private:
  friend std::optional<LigamentLaw> make_law(const LigamentDef& def, double reference_length, std::string& why);

  explicit LigamentLaw(std::shared_ptr<const ForceLaw> law);
  void find_sharp_breaks();

  std::shared_ptr<const ForceLaw> law_;
  double slack_length_ = 1;
  double slack_until_ = 1;
  std::vector<LawBreak> breaks_, sharp_breaks_;
  std::vector<bool> slack_pieces_;
};

/// The law that `def` describes; `reference_length` (m) is its length in the reference pose, which reference_strain and
/// reference_force mean. A force reached at several strains means the smallest; the force 0 means a ligament about to
/// become taut. Empty where no such law exists (a parameter out of range, a force the law cannot have); then `why` says
/// what is wrong, without the ligament's name.
std::optional<LigamentLaw> make_law(const LigamentDef& def, double reference_length, std::string& why);

}  // namespace genu
