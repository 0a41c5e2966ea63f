// The law of one ligament: a force-length law (law/force_law.h) with its slack length, divided into pieces at its sharp
// breaks.
//
// Beyond a sharp break a piece continues linearly, with the force and stiffness at its end. A solver stays on one piece
// during its iterations. Smooth breaks need no special treatment.
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
  /// As `piece`: the piece that contains the length.
  static constexpr int kByLength = -1;

  /// A custom law. Empty where its breaks are not finite, positive and increasing, or differ from its values just
  /// beside them; `why` then gives the reason.
  [[nodiscard]] static std::optional<LigamentLaw> custom(std::shared_ptr<const ForceLaw> law, std::string& why);

  /// Length in m, >= 0.
  LawValue evaluate(double length) const;

  /// The same on one piece (0: lengths up to the first sharp break), continued linearly beyond its ends.
  LawValue evaluate(double length, int piece) const;

  /// Derivatives with respect to the law's numbers and its slack length. Where the law is slack those of the force are
  /// 0.
  LawRates rates(double length) const;

  /// All breaks, by increasing length.
  const std::vector<LawBreak>& breaks() const { return breaks_; }

  /// Breaks where force or stiffness jumps: boundaries of pieces.
  const std::vector<LawBreak>& sharp_breaks() const { return sharp_breaks_; }

  /// Whether the force is 0 on the whole of a piece.
  bool is_slack(int piece) const;

  /// The piece that contains a length; a sharp break belongs to the shorter side.
  int piece_at(double length) const;

  /// (L - L0) / L0; NaN for a law without a slack length and for a spring of slack length 0.
  double strain(double length) const;

  /// L0, m; NaN for a law without one.
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

/// The law of `def`. `reference_length` (m): its length in the reference pose, to which reference_strain and
/// reference_force refer. If several strains have that force, the smallest is taken; force 0 means a ligament about to
/// become taut. Empty where no such law exists (a parameter out of range, an impossible force); `why` then gives the
/// reason, without the ligament's name.
[[nodiscard]] std::optional<LigamentLaw> make_law(const LigamentDef& def, double reference_length, std::string& why);

}  // namespace genu
