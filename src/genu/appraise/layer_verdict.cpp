#include "genu/appraise/layer_verdict.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/appraise/layer_doubts.h"
#include "genu/appraise/tolerances.h"
#include "genu/contact/layer_law.h"
#include "genu/contact/tolerances.h"
#include "genu/core/units.h"

namespace genu {
namespace {

/// The row where a column has its extreme, over cells with a number; no row where none has.
struct Extreme {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::size_t row = 0, count = 0;  ///< rows beyond the limit
};

template <typename Beyond>
Extreme extreme(const ResultTable& poses, const std::string& column, double sign, Beyond beyond) {
  Extreme out;
  for (std::size_t row = 0; row < poses.rows(); ++row) {
    const double x = poses.number(row, column);
    if (std::isnan(x)) continue;
    if (std::isnan(out.value) || sign * x > sign * out.value) out.value = x, out.row = row;
    if (beyond(x)) ++out.count;
  }
  return out;
}

/// A layer of which too few triangles carry the load in some rows.
struct TooFew {
  std::string layer, sheet;
  double points = std::numeric_limits<double>::infinity();  ///< fewest of a row in contact
  std::size_t row = 0, count = 0;                           ///< where that is; rows with too few
};

TooFew fewest(const ResultTable& poses, const std::string& layer, const std::string& sheet) {
  TooFew out{layer, sheet};
  for (std::size_t row = 0; row < poses.rows(); ++row) {
    const double points = poses.number(row, layer + ".points");
    if (!(points > 0) || points >= kFewLayerTriangles) continue;
    ++out.count;
    if (points < out.points) out.points = points, out.row = row;
  }
  return out;
}

/// A sentence for each of a few layers, one for all where there are many: the pieces of a meniscus.
void say_too_few(const std::vector<TooFew>& layers, std::size_t rows, std::vector<std::string>& out) {
  constexpr std::size_t kEachByItself = 3;
  if (layers.size() <= kEachByItself) {
    for (const TooFew& few : layers)
      out.push_back(
          fmt::format("The mesh is too coarse for the layer of {}: in {} of {} rows fewer than {:.0f} triangles of {} "
                      "carry the load ({:.0f} in row {}). Use a finer mesh or quadrature = \"smooth\".",
                      few.layer, few.count, rows, kFewLayerTriangles, few.sheet, few.points, few.row + 1));
    return;
  }
  const auto by_points = [](const TooFew& a, const TooFew& b) { return a.points < b.points; };
  const auto by_rows = [](const TooFew& a, const TooFew& b) { return a.count < b.count; };
  const TooFew& least = *std::min_element(layers.begin(), layers.end(), by_points);
  const TooFew& most = *std::max_element(layers.begin(), layers.end(), by_rows);
  out.push_back(fmt::format(
      "The meshes are too coarse for {} layers: in up to {} of {} rows ({}) fewer than {:.0f} triangles of a "
      "mesh carry the load ({:.0f} of {} in row {}). Use finer meshes or quadrature = \"smooth\".",
      layers.size(), most.count, rows, most.layer, kFewLayerTriangles, least.points, least.sheet, least.row + 1));
}

}  // namespace

std::vector<std::string> layer_sentences(const PlacedScene& scene, const JointModel& model, const ResultTable& poses) {
  std::vector<std::string> out;
  std::vector<TooFew> too_few;
  for (std::size_t k = 0; k < scene.layers.size(); ++k) {
    const LayerDef& layer = scene.layers[k];
    const std::string& name = layer.pair.name;
    const Extreme used =
        extreme(poses, name + ".max_strain", 1, [](double strain) { return strain > kMaxCompression; });
    const Extreme deepest = extreme(poses, name + ".max_depth_mm", 1, [](double) { return false; });
    if (used.count > 0)
      out.push_back(fmt::format(
          "The layer of {} is compressed by {:.0f} % of its thickness in row {} (more than {:.0f} % in {} rows). It is "
          "too soft or too thin for the load, and its law no longer holds.",
          name, 100 * used.value, used.row + 1, 100 * kMaxCompression, used.count));
    else if (deepest.value > kNearSearchDepth * to::kMillimetre * model.layers[k].search_depth)
      out.push_back(
          fmt::format("The layer of {} is compressed to {:.2f} mm in row {}, all of its search depth. Increase "
                      "`search_depth`.",
                      name, deepest.value, deepest.row + 1));
    if (layer.quadrature != LayerDef::Quadrature::triangles) continue;
    TooFew few = fewest(poses, name, scene.surfaces[static_cast<std::size_t>(layer.cast_from)].name);
    if (few.count > 0) too_few.push_back(std::move(few));
  }
  say_too_few(too_few, poses.rows(), out);
  return out;
}

void say_layer_doubts(const Prepared& prepared, const std::vector<PoseRecord>& records, std::vector<std::string>& out) {
  if (prepared.model.layers.empty()) return;
  constexpr std::size_t kPosesCompared = 8;
  const State start = start_state(prepared.model);
  std::vector<const State*> states{&start};
  for (std::size_t k = 0; k < std::min(kPosesCompared, records.size()); ++k) {
    const std::size_t row = records.size() <= kPosesCompared ? k : k * (records.size() - 1) / (kPosesCompared - 1);
    const State& state = records[row].point.pose.state;
    if (!state.poses.empty()) states.push_back(&state);
  }
  for (std::string& sentence : facing_doubts(prepared, states)) out.push_back(std::move(sentence));
  states.erase(states.begin());  // where the search starts bodies may lie anyhow
  for (std::string& sentence : passed_doubts(prepared, states)) out.push_back(std::move(sentence));
  for (std::string& sentence : footing_doubts(prepared, records)) out.push_back(std::move(sentence));
  for (std::string& sentence : tolerance_doubts(prepared, records)) out.push_back(std::move(sentence));
}

}  // namespace genu
