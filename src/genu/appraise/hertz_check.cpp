#include "genu/appraise/hertz_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "genu/appraise/tolerances.h"
#include "genu/contact/contact_equations.h"
#include "genu/contact/elastic_layer.h"
#include "genu/contact/hertz.h"
#include "genu/core/decompositions.h"
#include "genu/core/units.h"

namespace genu {
namespace {

/// What a layer is like at a pose: all pressed points together, and the deepest.
struct Pressed {
  double force = 0, peak = 0, area = 0;  ///< N, Pa, m^2
  LayerPoint deepest;
  bool on_a = true;  ///< whose body the deepest point's frame is
};

Pressed pressed_at(const JointModel::Layer& layer, const State& state, int level, ElasticLayer::Memory& memory) {
  Pressed out;
  Vec3 force = Vec3::Zero();
  const Pose &X_Wa = state.poses[at(layer.body_a)], &X_Wb = state.poses[at(layer.body_b)];
  for (std::size_t i = 0; i < layer.layer->sides().size(); ++i) {
    const auto& side = layer.layer->sides()[i];
    const Mat3& R = side.a ? X_Wa.R : X_Wb.R;
    layer.layer->visit(
        X_Wa, X_Wb, i, memory,
        [&](const LayerPoint& point) {
          force += (side.a ? 1 : -1) * side.share * point.load * (R * point.n);
          out.area += side.share * point.area;
          out.peak = std::max(out.peak, point.pressure);
          if (point.depth > out.deepest.depth) out.deepest = point, out.on_a = side.a;
        },
        level);
  }
  out.force = force.norm();
  return out;
}

/// The surfaces where the layer is deepest. Empty where one of them is flat triangles.
std::optional<ContactGeometry> geometry_at(const JointModel::Layer& layer, const State& state, const Pressed& pressed) {
  const Pose &X_Wa = state.poses[at(layer.body_a)], &X_Wb = state.poses[at(layer.body_b)];
  const Pose& X_Wc = pressed.on_a ? X_Wa : X_Wb;
  const Vec3 x = X_Wc * pressed.deepest.x, y = x - pressed.deepest.depth * (X_Wc.R * pressed.deepest.n);
  ContactGeometry g;
  const bool known = layer.a->project(X_Wa.inverse() * (pressed.on_a ? x : y), g.a) &&
                     layer.b->project(X_Wb.inverse() * (pressed.on_a ? y : x), g.b);
  return known ? std::optional(g) : std::nullopt;
}

double largest_curvature(const SurfacePoint& point) { return symmetric_eigen(point.S).values.cwiseAbs().maxCoeff(); }

/// Young's modulus of the half spaces: of one alone where the other surface is bare bone.
double reduced_modulus(const PlacedScene& scene, const LayerDef& def) {
  const auto bare = [&](int surface) {
    const auto& thickness = scene.surfaces[at(surface)].thickness;
    return thickness && !thickness->measured && thickness->constant == 0;
  };
  const int soft = bare(def.pair.surface_a) || bare(def.pair.surface_b) ? 1 : 2;
  return def.modulus / (soft * (1 - def.poisson * def.poisson));
}

/// Fills the check in, or says why there is none.
void compare(const PlacedScene& scene, const LayerDef& def, const JointModel::Layer& layer, const State& state,
             const Pressed& pressed, HertzCheck& check) {
  const auto geometry = geometry_at(layer, state, pressed);
  if (!geometry) {
    check.why = "flat triangles have no curvature: quadrature = \"smooth\" gives the surfaces one";
    return;
  }
  const Mat2 K = relative_curvature(state.poses[at(layer.body_a)], state.poses[at(layer.body_b)], *geometry);
  const Vec2 curvatures = symmetric_eigen(Mat2(0.5 * (K + K.transpose()))).values;
  if (!(curvatures[0] > 0)) {
    check.why = "the surfaces conform at the deepest point: the contact is no ellipse";
    return;
  }
  const double depth = pressed.deepest.depth, ellipse = 2 * std::numbers::pi * depth / std::sqrt(curvatures.prod());
  if (std::abs(pressed.area / ellipse - 1) > kEllipseTolerance) {
    check.why = fmt::format(
        "the area in contact is {:.2f} times the ellipse from the curvatures at the deepest point: it is not one "
        "compact area, or its curvature is not even",
        pressed.area / ellipse);
    return;
  }
  const HertzContact h = hertz(curvatures[0], curvatures[1], reduced_modulus(scene, def), depth);
  const double sharpest = std::max(largest_curvature(geometry->a), largest_curvature(geometry->b));
  const double thickness = depth / pressed.deepest.used;
  if (h.a * sharpest > kNarrowContact) {
    check.why =
        fmt::format("the area in contact is not small against the surfaces: half axis {:.2g} mm, radius {:.2g} mm",
                    to::kMillimetre * h.a, to::kMillimetre / sharpest);
    return;
  }
  check.axis_over_thickness = h.a / thickness;
  if (h.a > kThickLayer * thickness) {
    check.why = fmt::format(
        "the layer is thin against the area in contact (half axis {:.2g} mm, thickness {:.2g} mm): it is pressed "
        "between bones, where Hertz's half spaces do not apply and an elastic foundation does",
        to::kMillimetre * h.a, to::kMillimetre * thickness);
    return;
  }
  check.force = h.force;
  check.peak_pressure = h.peak_pressure;
  check.a = h.a;
  check.b = h.b;
}

HertzCheck check_row(const Prepared& prepared, std::size_t k, const PoseRecord& record, std::size_t row,
                     ElasticLayer::Memory& memory) {
  const JointModel::Layer& layer = prepared.model.layers[k];
  const State& state = record.point.pose.state;
  const Pressed pressed = pressed_at(layer, state, state.layer_level(k), memory);
  HertzCheck check;
  check.contact = layer.name;
  check.row = row + 1;
  check.layer_force = pressed.force;
  check.layer_peak_pressure = pressed.peak;
  check.approach = pressed.deepest.depth;
  compare(prepared.scene, prepared.scene.layers[k], layer, state, pressed, check);
  return check;
}

}  // namespace

std::vector<HertzCheck> hertz_checks(const Prepared& prepared, const std::vector<PoseRecord>& records,
                                     const ResultTable& poses) {
  std::vector<HertzCheck> out;
  for (std::size_t k = 0; k < prepared.model.layers.size(); ++k) {
    const std::string column = prepared.model.layers[k].name + ".force_N";
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < records.size(); ++row)
      if (poses.number(row, column) > 0) rows.push_back(row);
    if (rows.empty()) continue;
    std::stable_sort(rows.begin(), rows.end(),
                     [&](std::size_t x, std::size_t y) { return poses.number(x, column) > poses.number(y, column); });
    ElasticLayer::Memory memory;
    const auto check = [&](std::size_t i) { return check_row(prepared, k, records[rows[i]], rows[i], memory); };
    HertzCheck best = check(0);
    std::size_t no = 0, yes = rows.size() - 1;
    if (!best.applies() && yes > 0) {
      HertzCheck found = check(yes);
      while (found.applies() && yes - no > 1) {
        const std::size_t middle = (no + yes) / 2;
        const HertzCheck between = check(middle);
        (between.applies() ? yes : no) = middle;
        if (between.applies()) found = between;
      }
      if (found.applies()) best = found;
    }
    out.push_back(best);
  }
  return out;
}

std::vector<std::string> hertz_sentences(const std::vector<HertzCheck>& checks) {
  std::vector<std::string> out;
  for (const HertzCheck& c : checks)
    if (c.applies())
      out.push_back(fmt::format(
          "Half spaces of the material of {} pressed as deep ({:.3g} mm, row {}) would carry {:.3g} N with {:.3g} MPa "
          "at most on half axes of {:.3g} and {:.3g} mm (Hertz): the layer carries {:.2f} times that, at {:.2f} times "
          "the pressure. Hertz's half axis is {:.2f} of the thickness; the foundation is meant for contacts wider than "
          "the layer is thick.",
          c.contact, to::kMillimetre * c.approach, c.row, c.force, c.peak_pressure / units::kMegapascal,
          to::kMillimetre * c.a, to::kMillimetre * c.b, c.layer_force / c.force,
          c.layer_peak_pressure / c.peak_pressure, c.axis_over_thickness));
  return out;
}

}  // namespace genu
