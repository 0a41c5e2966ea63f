#include "genu/scene/read_parts.h"

namespace genu {

namespace {

void check_kinds(ReadContext& context, Section& root) {
  int fixed = 0;
  for (const BodyDef& body : context.scene.bodies) fixed += body.fixed ? 1 : 0;
  const Item all = root.find("body");
  const SourceLocation where = all ? all.node->key_where : SourceLocation{1, 1};
  if (fixed == 0) {
    context.error(where, "body", {}, "at least one body must be fixed: [body.NAME] with fixed = true");
  } else if (fixed == static_cast<int>(context.scene.bodies.size())) {
    context.error(where, "body", {}, "at least one body must be free to move: [body.NAME] without fixed");
  }
}

}  // namespace

void read_bodies(ReadContext& context, Section& root) {
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
    section.not_built({"mass", "centre_of_mass", "inertia"}, "inertia and weight");
    section.finish();
    context.scene.bodies.push_back(body);
  }
  if (understood) check_kinds(context, root);
}

}  // namespace genu
