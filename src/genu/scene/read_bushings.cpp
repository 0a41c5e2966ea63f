// [bushing.NAME]: linear springs between frames of two bodies.
#include <cmath>

#include <fmt/format.h>

#include "genu/core/decompositions.h"
#include "genu/scene/read_parts.h"
#include "genu/scene/tolerances.h"

namespace genu {
namespace {

/// A frame; `placed` tells whether more than its body is given.
BushingDef::Frame read_frame(ReadContext& context, const Item& item, const char* what, bool& placed) {
  BushingDef::Frame frame;
  if (!is_table(context, item)) return frame;
  Section section(context, item, what);
  frame.body = read_reference(context, section.require("body"), "body", names_of(context.scene.bodies)).value_or(-1);
  placed = section.has("origin") || section.has("x_axis") || section.has("z_axis");
  frame.placement = read_placement(context, section);
  section.finish();
  return frame;
}

/// Six rows of six numbers; empty where one is wrong.
std::optional<Mat6> read_rows(ReadContext& context, const Item& item) {
  constexpr const char* kForm = "must be six rows of six numbers, in N, m and rad";
  const auto is_six = [](const TomlNode& node) {
    return node.kind == TomlNode::Kind::array && node.children.size() == 6;
  };
  if (!is_six(*item.node)) return refuse(context, item, Code::wrong_form, kForm), std::nullopt;
  Mat6 K;
  bool good = true;
  for (int i = 0; i < 6; ++i) {
    const Item row = item.element(at(i));
    if (!is_six(*row.node)) return refuse(context, row, Code::wrong_form, kForm), std::nullopt;
    for (int j = 0; j < 6; ++j) {
      const auto number =
          read_number(context, row.element(at(j)), {.unit = 1, .unit_name = {}, .above = {}, .at_least = {}});
      good = good && number;
      K(i, j) = number.value_or(0);
    }
  }
  return good ? std::optional<Mat6>(K) : std::nullopt;
}

/// A stiffness matrix that has an energy, which nothing makes negative.
std::optional<Mat6> read_matrix(ReadContext& context, const Item& item) {
  const auto rows = read_rows(context, item);
  if (!rows) return std::nullopt;
  const Mat6& K = *rows;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < i; ++j)
      if (std::abs(K(i, j) - K(j, i)) > kSymmetric * std::max(std::abs(K(i, j)), std::abs(K(j, i))))
        return refuse(context, item, Code::out_of_range,
                      fmt::format("must be symmetric: row {}, column {} is {:g}, row {}, column {} is {:g}", i + 1,
                                  j + 1, K(i, j), j + 1, i + 1, K(j, i))),
               std::nullopt;
  // Rows of one size: lengths and angles have no common unit.
  Vec6 scale;
  for (int i = 0; i < 6; ++i) scale[i] = K(i, i) > 0 ? 1 / std::sqrt(K(i, i)) : 1;
  const SymmetricEigen<Eigen::Dynamic> e = symmetric_eigen(MatX(scale.asDiagonal() * K * scale.asDiagonal()));
  if (e.values[0] < -kSymmetric * std::max(1.0, e.values[5]))
    return refuse(context, item, Code::out_of_range,
                  "must not be negative in any direction: the energy of some displacement is below 0"),
           std::nullopt;
  return Mat6((K + K.transpose()) / 2);
}

void check_bodies(ReadContext& context, const Section& section, const BushingDef& bushing) {
  const int a = bushing.from.body, b = bushing.to.body;
  if (a < 0 || b < 0) return;
  const auto refuse_it = [&](Code code, const char* why) {
    context.error(bushing.where, code, section.item().path, {}, why);
  };
  if (a == b) return refuse_it(Code::conflict, "both frames are on the same body");
  if (context.scene.bodies[at(a)].fixed && context.scene.bodies[at(b)].fixed)
    refuse_it(Code::no_effect, "both frames are on fixed bodies");
}

void read_stiffness(ReadContext& context, Section& section, BushingDef& bushing) {
  read_numbers(context, section, kind_of(bushing), bushing, {.objects = "bushings"});
  if (const Item matrix = section.find("matrix")) {
    for (const char* key : {"stiffness", "rotation_stiffness"})
      if (const Item other = section.find(key))
        refuse(context, other, Code::conflict, "conflicts with `matrix`: give one of the two");
    bushing.matrix = read_matrix(context, matrix);
  } else if (!section.has("stiffness") && !section.has("rotation_stiffness")) {
    section.error(Code::missing_key, "stiffness",
                  "is missing: a bushing needs stiffness, rotation_stiffness or matrix");
  }
}

}  // namespace

void read_bushings(ReadContext& context, Section& root) {
  for (const Item& item : named_tables(context, root, "bushing")) {
    Section section(context, item, "a bushing");
    BushingDef bushing;
    bushing.name = item.node->key;
    bushing.where = item.node->key_where;
    bool placed = false;
    bushing.from = read_frame(context, section.require("from"), "the first frame of a bushing", placed);
    bushing.to = read_frame(context, section.require("to"), "the second frame of a bushing", placed);
    bushing.coincide = !placed;
    read_stiffness(context, section, bushing);
    check_bodies(context, section, bushing);
    const bool enabled = read_enabled(context, section, "bushing");
    section.finish();
    if (enabled) context.scene.bushings.push_back(bushing);
  }
}

void place_bushings(Scene& scene) {
  const std::vector<Pose> poses = reference_poses(scene);
  for (BushingDef& bushing : scene.bushings)
    if (bushing.coincide && bushing.from.body >= 0 && bushing.to.body >= 0)
      bushing.to.placement =
          poses[at(bushing.to.body)].inverse() * poses[at(bushing.from.body)] * bushing.from.placement;
}

}  // namespace genu
