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
  if (is_fixed(context, load.body)) refuse(context, body, Code::no_effect, "is fixed: a load on it moves nothing");
  read_numbers(context, section, kind_of(load), load);
  const auto frame = read_choice(context, section.find("frame"), {"world", "body"});
  load.frame = frame == 1 ? LoadDef::Frame::body : LoadDef::Frame::world;
  for (const KindOf<LoadDef>& other : kLoadKinds)
    if (*other.word != 0) section.find(other.word);  // for messages
  if (!section.has("force") && !section.has("moment"))
    section.error(Code::missing_key, "force",
                  "is missing: a load needs a force, a moment, `toward`, `on` or a path `from` ... `to`");
}

/// The other end of a force between two bodies.
void read_end(ReadContext& context, const Item& item, LoadDef& load) {
  if (!is_table(context, item)) return;
  Section section(context, item, "the point a load is directed at");
  const Item body = section.require("body");
  load.toward_body = read_body(context, body);
  read_numbers(context, section, kind_of(load), load, {.table = "toward"});
  section.finish();
  if (load.body < 0 || load.toward_body < 0) return;
  if (load.body == load.toward_body) {
    refuse(context, body, Code::conflict, "both points are on the same body");
  } else if (is_fixed(context, load.body) && is_fixed(context, load.toward_body)) {
    refuse(context, body, Code::no_effect, "both points are on fixed bodies");
  }
}

void read_toward(ReadContext& context, Section& section, LoadDef& load) {
  load.kind = LoadDef::Kind::toward;
  section.rename(kind_of(load).what);
  load.body = read_body(context, section.require("body"));
  read_numbers(context, section, kind_of(load), load);
  read_end(context, section.find("toward"), load);
}

/// A force along a path.
void read_cable(ReadContext& context, Section& section, LoadDef& load) {
  load.kind = LoadDef::Kind::cable;
  section.rename(kind_of(load).what);
  ReadPath path = read_path(context, section, "a cable");
  load.points = std::move(path.points);
  load.wraps = std::move(path.wraps);
  read_numbers(context, section, kind_of(load), load);
}

void read_on(ReadContext& context, Section& section, LoadDef& load) {
  load.kind = LoadDef::Kind::coordinate;
  section.rename(kind_of(load).what);
  const Item on = section.find("on");
  const auto name = read_string(context, on);
  const auto coordinate =
      name ? find_coordinate(context, on.node->where, on.path, *name, literal(*on.node)) : std::nullopt;
  load.coordinate = coordinate.value_or(CoordinateRef{});
  read_numbers(context, section, kind_of(load), load);
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
    } else if (section.has("from")) {
      read_cable(context, section, load);
    } else if (section.has("toward")) {
      read_toward(context, section, load);
    } else {
      read_wrench(context, section, load);
    }
    load.scale = read_scale(context, section.find("scale"));
    const bool enabled = read_enabled(context, section, "load");
    section.finish();
    if (enabled) context.scene.loads.push_back(load);
  }
}

}  // namespace genu
