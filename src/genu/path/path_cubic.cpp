#include "genu/path/path_cubic.h"

namespace genu {

PathCubic::PathCubic(const JointModel& model, const State& from, const Correction& tangent_from, const State& to,
                     const Correction& tangent_to, double span)
    : model_(model), from_(from), start_(tangent_from), span_(span), way_(tangent_from), end_(tangent_to) {
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const int k = model.bodies[i].moving;
    if (k < 0) continue;
    const Vec3 turn = log_rotation(to.poses[i].R * from.poses[i].R.transpose());
    way_.twist.segment<6>(6 * k) << to.poses[i].p - from.poses[i].p, turn;
    // The rotation continues from exp(w) as w' + w x w' / 2 + ...; solved for w'.
    const Vec3 rate = tangent_to.twist.segment<3>(6 * k + 3);
    end_.twist.segment<3>(6 * k + 3) = rate - 0.5 * turn.cross(rate);
  }
  for (std::size_t m = 0; m < from.multipliers.size(); ++m)
    way_.multipliers[static_cast<Eigen::Index>(m)] = to.multipliers[m] - from.multipliers[m];
  auto held = static_cast<Eigen::Index>(from.multipliers.size());
  for (std::size_t i = 0; i < from.pieces.size(); ++i)
    if (from.pieces[i].held) way_.multipliers[held++] = to.pieces[i].force - from.pieces[i].force;
  for (std::size_t c = 0; c < from.contacts.size(); ++c)
    way_.forces[static_cast<Eigen::Index>(c)] = to.contacts[c].force - from.contacts[c].force;
  here_ = way_;
}

bool PathCubic::at(double u, State& out) {
  const double s = span_ * u * (1 - u) * (1 - u), w = u * u * (3 - 2 * u), e = -span_ * u * u * (1 - u);
  here_ = start_;
  here_.add(s - 1, start_);
  here_.add(w, way_);
  here_.add(e, end_);
  for (std::size_t c = 0; c < here_.surface.size(); ++c) here_.surface[c] = span_ * u * start_.surface[c];
  return retract(model_, from_, here_, 1, out);
}

}  // namespace genu
