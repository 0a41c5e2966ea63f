// The path of a ligament or cable: `from`, `to`, and between them `via`, `wrap`, or both in one list `path`.
#include <algorithm>

#include <fmt/format.h>

#include "genu/scene/read_parts.h"

namespace genu {
namespace {

class PathReader {
 public:
  PathReader(ReadContext& context, Section& section, const std::string& what)
      : context_(context), section_(section), what_(what) {}

  ReadPath read() {
    const PathEnd from = read_point(section_.require("from"), "the end of " + what_);
    const PathEnd to = read_point(section_.require("to"), "the end of " + what_);
    const Item via = section_.find("via"), wrap = section_.find("wrap"), path = section_.find("path");
    if (path && (via || wrap))
      refuse(context_, path, Code::conflict, "has all points and surfaces in order: leave out via and wrap");
    else if (via && wrap)
      refuse(context_, wrap, Code::conflict,
             "with via points the order is open: give path = [...] with points { body, point } and surfaces in order");
    read_list(via, "via points [{ body, point }, ...]", Of::points);
    read_list(wrap, "surfaces [\"NAME\", { surface, side }, ...]", Of::surfaces);
    read_list(path, "points { body, point } and surfaces in order", Of::both);
    out_.points.insert(out_.points.begin(), from);
    out_.points.push_back(to);
    check_bodies();
    return std::move(out_);
  }

 private:
  enum class Of { points, surfaces, both };

  PathEnd read_point(const Item& item, const std::string& what) {
    PathEnd end;
    if (!is_table(context_, item)) return end;
    Section section(context_, item, what);
    end.body = read_reference(context_, section.require("body"), "body", names_of(context_.scene.bodies)).value_or(-1);
    end.point = read_vector(context_, section.require("point"), length_rule(context_)).value_or(Vec3::Zero());
    section.finish();
    return end;
  }

  void read_list(const Item& item, const char* form, Of of) {
    if (!item || !is_array(context_, item, form)) return;
    for (std::size_t k = 0; k < item.node->children.size(); ++k) {
      const Item element = item.element(k);
      const bool surface = element.node->kind == TomlNode::Kind::string || element.node->member("surface") != nullptr;
      if (of == Of::surfaces || (of == Of::both && surface))
        read_wrap(element);
      else
        out_.points.push_back(read_point(element, "a via point"));
    }
  }

  void read_wrap(const Item& item) {
    WrapDef wrap;
    wrap.after = static_cast<int>(out_.points.size());
    wrap.where = item.node->where;
    Item name = item;
    if (item.node->kind != TomlNode::Kind::string) {
      if (!is_table(context_, item)) return;
      Section section(context_, item, "a surface that " + what_ + " wraps round");
      name = section.require("surface");
      read_side(section.find("side"), wrap);
      if (const Item inside = section.find("inside"))
        wrap.ignore_inside = read_choice(context_, inside, {"refuse", "ignore"}) == 1;
      section.finish();
    }
    const auto surface = read_reference(context_, name, "surface", names_of(context_.scene.surfaces));
    if (!surface) return;
    wrap.surface = *surface;
    const SurfaceDef& def = context_.scene.surfaces[static_cast<std::size_t>(*surface)];
    if (def.shape == SurfaceDef::Shape::plane)
      refuse(context_, name, Code::no_effect, "is a plane: a path has no way round it");
    if (std::count_if(out_.wraps.begin(), out_.wraps.end(), [&](const WrapDef& w) { return w.after == wrap.after; }) >=
        kMostWraps)
      refuse(context_, name, Code::too_large,
             fmt::format("is one surface too many between two points: at most {}", kMostWraps));
    out_.wraps.push_back(wrap);
  }

  void read_side(const Item& item, WrapDef& wrap) {
    if (!item) return;
    if (item.node->kind == TomlNode::Kind::string) {
      read_choice(context_, item, {"shortest"});
      return;
    }
    const auto side = read_vector(context_, item);
    if (!side) return;
    if (side->isZero(0)) refuse(context_, item, Code::out_of_range, "must be a direction [x, y, z] or \"shortest\"");
    wrap.side = side->normalized();
  }

  void check_bodies() {
    std::vector<int> bodies;
    for (const PathEnd& end : out_.points) bodies.push_back(end.body);
    for (const WrapDef& wrap : out_.wraps)
      bodies.push_back(context_.scene.surfaces[static_cast<std::size_t>(wrap.surface)].body);
    const auto all = [&](const auto& holds) { return std::all_of(bodies.begin(), bodies.end(), holds); };
    if (!all([](int body) { return body >= 0; })) return;
    const std::string which = bodies.size() == 2   ? "both ends"
                              : out_.wraps.empty() ? "all its points"
                                                   : "all its points and surfaces";
    const Item body_of_to = section_.find("to").member(*section_.find("to").node->member("body"));
    if (all([&](int body) { return body == bodies[0]; })) {
      refuse(context_, body_of_to, Code::conflict, which + " are on the same body");
    } else if (all([&](int body) { return context_.scene.bodies[static_cast<std::size_t>(body)].fixed; })) {
      refuse(context_, body_of_to, Code::no_effect, which + " are on fixed bodies");
    }
  }

  static constexpr int kMostWraps = 8;  // as many arcs as wrap/taut_string.h has room for

  ReadContext& context_;
  Section& section_;
  const std::string& what_;
  ReadPath out_;
};

}  // namespace

ReadPath read_path(ReadContext& context, Section& section, const std::string& what) {
  return PathReader(context, section, what).read();
}

}  // namespace genu
