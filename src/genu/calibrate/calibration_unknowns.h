// The unknowns of a calibration: single numbers of a scene, or groups of them that share one factor or one offset, with
// bounds and priors.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "genu/assemble/with_numbers.h"
#include "genu/core/diagnostics.h"

namespace genu {

/// As the unknown u of the fit, 0 at the start: a share is exp(u) times its start, an offset is u scales added to it.
struct CalibrationUnknown {
  struct Member {
    Parameter parameter;
    double start = 0;  ///< SI
  };
  struct Prior {
    double mean = 0, deviation = 1;  ///< as shown()
  };

  std::string name;  ///< Parameter::name; of a group the pattern, or "ACL.slack_length"
  std::string unit;  ///< of shown()
  double si = 1;     ///< SI per that unit
  bool share = false;
  bool group = false;  ///< its number is the factor, 1 at the start, or the offset, 0 at the start
  double scale = 1;    ///< SI; of an offset
  std::vector<Member> members;
  double lower = -std::numeric_limits<double>::infinity();  ///< of u
  double upper = std::numeric_limits<double>::infinity();   ///< of u
  std::optional<Prior> prior = {};

  double value(const Member& member, double u) const;  ///< SI
  double slope(const Member& member, double u) const;  ///< its derivative to u
  double u_of(const Member& member, double value) const;
  /// The number that is reported, in `unit`.
  double shown(double u) const;
  double shown_slope(double u) const;
  double u_of_shown(double number) const;
  /// The standard change of the first member, as a change of u.
  double standard_change() const;
  /// The longest step of u in a fit: a slack length that grows too far pulls no more, and nobody sees it any more.
  double most_step() const;
};

/// What the fit may change, as the options say it; * and ? are wildcards, bundles stand for their fibres.
struct UnknownChoice {
  /// "ACLam1.stiffness", "ACL*.slack_length" (each for itself), "ACL*.slack_length+PCL*.slack_length:together" (one
  /// factor, or one offset of what may be 0), "...:factor", "...:offset", "*.slack_length:bundles" (one unknown for
  /// each bundle of the scene, and for fibres with one name and numbers behind it).
  std::vector<std::string> vary;
  std::vector<std::string> bounds;  ///< "NAME=LOW..HIGH", in the unknown's unit
  std::vector<std::string> priors;  ///< "NAME=MEAN~SD"; MEAN may be `start`, SD a share: 5%
};

/// In the order of the options. What is wrong is added to `out`, all of it.
std::vector<CalibrationUnknown> choose_unknowns(Scene& scene, const UnknownChoice& choice, Diagnostics& out);

/// Sets the bounds and priors of `choice` alone, which are about the starts that the members have now.
void set_limits(const Scene& scene, const UnknownChoice& choice, std::vector<CalibrationUnknown>& unknowns,
                Diagnostics& out);

/// The numbers of all members at u.
std::vector<NewNumber> numbers_at(const std::vector<CalibrationUnknown>& unknowns, const VecX& u);

}  // namespace genu
