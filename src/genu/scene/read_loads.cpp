#include "genu/scene/read_parts.h"

namespace genu {

namespace {

bool is_fixed(const ReadContext& context, int body) {
  return body >= 0 && context.scene.bodies[static_cast<std::size_t>(body)].fixed;
}

int read_body(ReadContext& context, const Item& item) {
  return read_reference(context, item, "body", names_of(context.scene.bodies)).value_or(-1);
}

/// A force and a moment on one body.
void read_wrench(ReadContext& context, Section& section, LoadDef& load) {
  const Item body = section.require("body");
  load.body = read_body(context, body);
  if (is_fixed(context, load.body)) refuse(context, body, "is fixed: a load on it moves nothing");
  const Item force = section.find("force"), moment = section.find("moment"), point = section.find("point");
  load.force = read_vector(context, force, plain_rule("N")).value_or(Vec3::Zero());
  load.moment = read_vector(context, moment, plain_rule("N m")).value_or(Vec3::Zero());
  load.point = read_vector(context, point, length_rule(context)).value_or(Vec3::Zero());
  const auto frame = read_choice(context, section.find("frame"), {"world", "body"});
  load.frame = frame == 1 ? LoadDef::Frame::body : LoadDef::Frame::world;
  if (point && !force) refuse(context, point, "is where a force acts, and there is no force");
  for (const char* other : {"toward", "on"}) section.find(other);  // the keys of the other kinds, for messages
  if (!force && !moment) section.error("force", "is missing: a load needs a force, a moment, `toward` or `on`");
}

/// The other end of a force between two bodies.
void read_end(ReadContext& context, const Item& item, LoadDef& load) {
  if (!is_table(context, item)) return;
  Section section(context, item, "the point a load is directed at");
  const Item body = section.require("body");
  load.toward_body = read_body(context, body);
  load.toward_point = read_vector(context, section.require("point"), length_rule(context)).value_or(Vec3::Zero());
  section.finish();
  if (load.body < 0 || load.toward_body < 0) return;
  if (load.body == load.toward_body) {
    refuse(context, body, "both points are on the same body");
  } else if (is_fixed(context, load.body) && is_fixed(context, load.toward_body)) {
    refuse(context, body, "both points are on fixed bodies");
  }
}

void read_toward(ReadContext& context, Section& section, LoadDef& load) {
  section.rename("a load toward a point");
  load.kind = LoadDef::Kind::toward;
  load.body = read_body(context, section.require("body"));
  load.point = read_vector(context, section.find("point"), length_rule(context)).value_or(Vec3::Zero());
  read_end(context, section.find("toward"), load);
  load.value = read_number(context, section.require("magnitude"), non_negative(plain_rule("N"))).value_or(0);
}

void read_on(ReadContext& context, Section& section, LoadDef& load) {
  section.rename("a load on a joint coordinate");
  load.kind = LoadDef::Kind::coordinate;
  const Item on = section.find("on");
  const auto name = read_string(context, on);
  const auto coordinate =
      name ? find_coordinate(context, on.node->where, on.path, *name, literal(*on.node)) : std::nullopt;
  load.coordinate = coordinate.value_or(CoordinateRef{});
  const bool translation = coordinate && coordinate->index >= 3;
  load.value = read_number(context, section.find("value"), plain_rule(translation ? "N" : "N m")).value_or(1);
}

}  // namespace

void read_loads(ReadContext& context, Section& root) {
  for (const Item& item : named_tables(context, root, "load")) {
    Section section(context, item, "a load");
    LoadDef load;
    load.name = item.node->key;
    load.where = item.node->key_where;
    if (section.has("on")) {
      read_on(context, section, load);
    } else if (section.has("toward")) {
      read_toward(context, section, load);
    } else {
      read_wrench(context, section, load);
    }
    load.scale = read_scale(context, section.find("scale"));
    section.finish();
    context.scene.loads.push_back(load);
  }
}

}  // namespace genu
