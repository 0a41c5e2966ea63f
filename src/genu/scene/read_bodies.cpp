#include "genu/scene/read_parts.h"

namespace genu {

namespace {

void check_kinds(ReadContext& context, Section& root) {
  int fixed = 0;
  for (const BodyDef& body : context.scene.bodies) fixed += body.fixed ? 1 : 0;
  const Item all = root.find("body");
  const SourceLocation where = all ? all.node->key_where : SourceLocation{1, 1};
  if (fixed == 0) {
    context.error(where, Code::missing_key, "body", {},
                  "at least one body must be fixed: [body.NAME] with fixed = true");
  } else if (fixed == static_cast<int>(context.scene.bodies.size())) {
    context.error(where, Code::conflict, "body", {},
                  "at least one body must be free to move: [body.NAME] without fixed");
  }
}

constexpr const char* kNoUse = "has no effect: without `gravity` no body has a weight, without [dynamics] no inertia";

void refuse_key(ReadContext& context, const Item& item, std::string rule) {
  context.error(item.node->key_where, Code::no_effect, item.path, literal(*item.node), std::move(rule));
}

/// Numbers that give a body weight, or `solid`, where only gravity asks for them.
void read_weight(ReadContext& context, Section& section, bool gravity, BodyDef& body) {
  if (gravity) {
    if (!read_solid(context, section, body)) read_mass(context, section, {.none_required = true}, body);
    return;
  }
  for (const Item& item : given_numbers(section, kind_of(body))) refuse_key(context, item, kNoUse);
  if (const Item solid = section.find("solid")) refuse_key(context, solid, kNoUse);
}

void check_gravity(ReadContext& context, const Item& gravity, const std::vector<Item>& tables) {
  for (const Item& item : tables) {
    if (item.node->member("mass") || item.node->member("solid")) return;
  }
  if (gravity) refuse(context, gravity, Code::no_effect, "acts on nothing: no body has a mass");
}

}  // namespace

void read_mass(ReadContext& context, Section& section, const NumbersOf& how, BodyDef& body) {
  read_numbers(context, section, kind_of(body), body, how);
  for (const NumberOf<BodyDef>& number : kind_of(body).numbers)
    if (const Item item = section.find(number.row.key);
        item && body.fixed && !lacks_other(section, kind_of(body), number.row, how))
      refuse(context, item, Code::no_effect, "is of a fixed body, which nothing moves");
}

void read_bodies(ReadContext& context, Section& root) {
  const Item gravity = root.find("gravity");
  context.scene.gravity = read_vector(context, gravity, {.unit = 1, .unit_name = "m/s^2", .above = {}, .at_least = {}});
  const std::vector<Item> tables = named_tables(context, root, "body");
  const Item all = root.find("body");
  // A body that is not understood may well be the fixed or the moving one that would seem to be missing.
  bool& understood = context.bodies_understood;
  understood = !all || (all.node->kind == TomlNode::Kind::table && all.node->children.size() == tables.size());
  for (const Item& item : tables) {
    Section section(context, item, "a body");
    BodyDef body;
    body.name = item.node->key;
    body.where = item.node->key_where;
    const Item fixed = section.find("fixed");
    const auto is_fixed = read_bool(context, fixed);
    body.fixed = is_fixed.value_or(false);
    understood = understood && (!fixed || is_fixed);
    if (context.in_motion) {
      read_inertia(context, section, body);
    } else {
      read_weight(context, section, static_cast<bool>(gravity), body);
      if (const Item inertia = section.find("inertia"))
        refuse_key(context, inertia, "has an effect only in a scene with [dynamics]");
    }
    read_enabled(context, section, "body");
    section.finish();
    context.scene.bodies.push_back(body);
  }
  if (understood) check_kinds(context, root);
  if (context.scene.gravity) check_gravity(context, gravity, tables);
}

}  // namespace genu
