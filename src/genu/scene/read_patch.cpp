#include <algorithm>
#include <numbers>

#include "genu/scene/read_parts.h"
#include "genu/scene/tolerances.h"

namespace genu {

namespace {

/// [from, to], from < to.
SurfaceDef::Patch::Range read_range(ReadContext& context, const Item& item, const NumberRule& rule) {
  if (!item || !is_array(context, item, "a range [from, to]", 2)) return {};
  const auto from = read_number(context, item.element(0), rule), to = read_number(context, item.element(1), rule);
  if (!from || !to) return {};
  if (*from < *to) return std::pair(*from, *to);
  refuse(context, item, Code::wrong_form, "must be a range [from, to] with from < to");
  return {};
}

void check_turn(ReadContext& context, const Item& item, const SurfaceDef& surface, const SurfaceDef::Patch& patch) {
  constexpr double kHalfTurn = std::numbers::pi;
  if (!patch.theta) return;
  const auto [from, to] = *patch.theta;
  if (to - from >= (2 - kAngleRangeRounding) * kHalfTurn) {
    refuse(context, item, Code::out_of_range,
           "must be less than a full turn wide; without theta the patch goes all the way round");
    return;
  }
  const bool seam = surface.shape == SurfaceDef::Shape::cylindrical_polynomial &&
                    std::any_of(surface.terms.begin(), surface.terms.end(), [](const auto& t) { return t.i > 0; });
  if (seam && (from < -(1 + kAngleRangeRounding) * kHalfTurn || to > (1 + kAngleRangeRounding) * kHalfTurn))
    refuse(context, item, Code::out_of_range,
           "must stay within half a turn from 0 to either side, where this polynomial ends");
}

}  // namespace

std::optional<SurfaceDef::Patch> read_patch(ReadContext& context, const Item& item, const SurfaceDef& surface) {
  if (!is_table(context, item)) return {};
  Section section(context, item, "a patch");
  SurfaceDef::Patch patch;
  patch.where = item.node->key_where;
  patch.box[0] = read_range(context, section.find("x"), length_rule(context));
  patch.box[1] = read_range(context, section.find("y"), length_rule(context));
  patch.box[2] = read_range(context, section.find("z"), length_rule(context));
  const Item theta = section.find("theta");
  patch.theta = read_range(context, theta, angle_rule(context));
  check_turn(context, theta, surface, patch);
  section.finish();
  if (item.node->children.empty()) refuse(context, item, Code::missing_key, "needs at least one of x, y, z, theta");
  return patch;
}

}  // namespace genu
