#include "genu/scene/read_parts.h"

namespace genu {

namespace {

void read_wrench(ReadContext& context, Section& section, LoadDef& load) {
  const Item force = section.find("force"), moment = section.find("moment"), point = section.find("point");
  const NumberRule newton{.unit = 1, .unit_name = "N", .above = {}, .at_least = {}};
  const NumberRule newton_metre{.unit = 1, .unit_name = "N m", .above = {}, .at_least = {}};
  load.force = read_vector(context, force, newton).value_or(Vec3::Zero());
  load.moment = read_vector(context, moment, newton_metre).value_or(Vec3::Zero());
  load.point = read_vector(context, point, length_rule(context)).value_or(Vec3::Zero());
  const auto frame = read_choice(context, section.find("frame"), {"world", "body"});
  load.frame = frame == 1 ? LoadDef::Frame::body : LoadDef::Frame::world;
  if (point && !force) refuse(context, point, "is where a force acts, and there is no force");
}

/// Loads of the kinds that are not built yet carry other keys; only what is wrong in any case is said about them.
bool is_for_later(const Section& section) {
  for (const char* key : {"toward", "on", "magnitude", "value"}) {
    if (section.has(key)) return true;
  }
  return false;
}

}  // namespace

void read_loads(ReadContext& context, Section& root) {
  const std::vector<BodyDef>& bodies = context.scene.bodies;
  for (const Item& item : named_tables(context, root, "load")) {
    Section section(context, item, "a load");
    LoadDef load;
    load.name = item.node->key;
    load.where = item.node->key_where;
    const bool later = is_for_later(section);
    const Item body = later ? section.find("body") : section.require("body");
    load.body = read_reference(context, body, "body", names_of(bodies)).value_or(-1);
    if (load.body >= 0 && bodies[static_cast<std::size_t>(load.body)].fixed) {
      refuse(context, body, "is fixed: a load on it moves nothing");
    }
    read_wrench(context, section, load);
    if (!later && !section.has("force") && !section.has("moment")) {
      section.error("force", "is missing: a load needs a force, a moment or both");
    }
    section.not_built({"toward", "magnitude"}, "loads toward a point");
    section.not_built({"on", "value"}, "loads on a joint coordinate");
    section.not_built({"scale"}, "loads scaled over a coordinate or time");
    section.finish();
    context.scene.loads.push_back(load);
  }
}

}  // namespace genu
