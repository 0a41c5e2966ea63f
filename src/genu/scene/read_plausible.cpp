// [plausible]: beyond what an answer is doubted.
#include "genu/core/units.h"
#include "genu/scene/plausible_def.h"
#include "genu/scene/read_parts.h"

namespace genu {
namespace {

NumberRule rule_of(const ReadContext& context, PlausibleKey::Unit unit) {
  switch (unit) {
    case PlausibleKey::Unit::newton:
      return plain_rule("N");
    case PlausibleKey::Unit::megapascal: {
      NumberRule rule = plain_rule("MPa");
      rule.unit = units::kMegapascal;
      return rule;
    }
    case PlausibleKey::Unit::length:
      return length_rule(context);
    case PlausibleKey::Unit::angle:
      return any_turns(angle_rule(context));
    case PlausibleKey::Unit::none:
      break;
  }
  return plain_rule({});
}

}  // namespace

void read_plausible(ReadContext& context, Section& root) {
  const Item item = root.find("plausible");
  if (!is_table(context, item)) return;
  Section section(context, item, "limits of what is plausible");
  for (const PlausibleKey& key : kPlausibleKeys)
    if (const auto value = read_number(context, section.find(key.key), positive(rule_of(context, key.unit))))
      context.scene.plausible.*key.member = *value;
  section.finish();
}

}  // namespace genu
