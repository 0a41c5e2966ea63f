#include "genu/results/pressure_map.h"

#include <array>
#include <iterator>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/model/layer_report.h"

namespace genu {
namespace {

constexpr const char* kHeading =
    "row,surface,triangle,x_mm,y_mm,z_mm,normal_x,normal_y,normal_z,area_mm2,depth_mm,strain,pressure_MPa,force_x_N,"
    "force_y_N,force_z_N\n";

class PressureMap {
 public:
  PressureMap(const PlacedScene& scene, const JointModel& model, int layer)
      : model_(model), index_(at(layer)), layer_(model.layers[at(layer)]), text_(kHeading) {
    const ContactDef& pair = scene.layers[at(layer)].pair;
    names_ = {scene.surfaces[at(pair.surface_a)].name, scene.surfaces[at(pair.surface_b)].name};
  }

  void add(std::size_t row, const State& state) {
    const Pose &X_Wa = state.poses[at(layer_.body_a)], &X_Wb = state.poses[at(layer_.body_b)];
    const Mat3 R_ba = X_Wb.R.transpose() * X_Wa.R;
    const auto& sides = layer_.layer->sides();
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const bool a = sides[i].a;
      const double share = sides[i].share;
      const Vec3 origin = own_origin(model_, a ? layer_.body_a : layer_.body_b);
      const auto write = [&](const LayerPoint& point) {
        const Vec3 x = to::kMillimetre * (point.x - origin);
        const Vec3 force = share * point.load * (a ? Vec3(R_ba * point.n) : Vec3(-point.n));
        fmt::format_to(std::back_inserter(text_), "{},{},{}", row, names_[a ? 0 : 1], point.cell);
        for (const double value : {x[0], x[1], x[2], point.n[0], point.n[1], point.n[2],
                                   share * to::kSquareMillimetre * point.area, to::kMillimetre * point.depth,
                                   point.used, point.pressure / units::kMegapascal, force[0], force[1], force[2]})
          fmt::format_to(std::back_inserter(text_), ",{:.17g}", value);
        text_ += '\n';
      };
      layer_.layer->visit(X_Wa, X_Wb, i, memory_, write, state.layer_level(index_));
    }
  }

  std::string take() { return std::move(text_); }

 private:
  const JointModel& model_;
  std::size_t index_;
  const JointModel::Layer& layer_;
  std::string text_;
  std::array<std::string, 2> names_;
  ElasticLayer::Memory memory_;
};

}  // namespace

std::string pressure_map(const PlacedScene& scene, const JointModel& model, int layer,
                         const std::vector<PoseRecord>& records) {
  PressureMap map(scene, model, layer);
  for (std::size_t row = 0; row < records.size(); ++row) {
    const PosePoint& point = records[row].point;
    const bool shown = records[row].pair_gap.size() == model.pairs.size() && !point.pose.state.poses.empty();
    if (shown) map.add(row + 1, point.pose.state);
  }
  return map.take();
}

std::vector<std::pair<std::string, std::string>> pressure_maps(const PlacedScene& scene, const JointModel& model,
                                                               const std::vector<PoseRecord>& records) {
  std::vector<std::pair<std::string, std::string>> files;
  for (std::size_t k = 0; k < model.layers.size(); ++k)
    files.emplace_back("pressures_" + model.layers[k].name + ".csv",
                       pressure_map(scene, model, static_cast<int>(k), records));
  return files;
}

}  // namespace genu
