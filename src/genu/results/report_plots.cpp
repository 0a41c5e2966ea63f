#include "genu/results/report_plots.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/results/columns.h"
#include "genu/results/extensor_columns.h"
#include "genu/results/ligament_groups.h"
#include "genu/results/moment_arm_columns.h"
#include "genu/results/tolerances.h"

namespace genu {
namespace {

class ReportPlots {
 public:
  ReportPlots(const PlacedScene& scene, const ResultTable& poses, Chart& chart)
      : scene_(scene), poses_(poses), chart_(chart) {}

  void add() {
    put_first("Grood and Suntay: translations [mm]", clinical(3, 6, false));  // the words of the field come first
    put_first("Grood and Suntay: rotations [deg]", clinical(0, 3, false));
    insert("Translations [mm]", "Patella: rotations [deg]", clinical(0, 3, true), false);
    insert("Patella: rotations [deg]", "Patella: translations [mm]", clinical(3, 6, true), false);
    add_extensors();
    insert("Contact force [N]", "Contact area [mm2]", layers("area_mm2"), true);
    insert("Contact area [mm2]", "Largest contact pressure [MPa]", layers("max_pressure_MPa"), true);
    insert("Ligament force [N]", "Ligament strain, mean of fibres [%]", strains(), false);
    insert("Reaction moment [N m]", "Joint force [N]", joint_forces(), true);
    for (const CoordinateRef& c : scene_.moment_arms) add_moment_arms(c);
  }

 private:
  std::vector<double> column(const std::string& name) const {
    std::vector<double> values(poses_.rows());
    for (std::size_t row = 0; row < values.size(); ++row) values[row] = poses_.number(row, name);
    return values;
  }

  ChartSeries series(const std::string& name, const std::string& of) const { return {name, column(of), {}, of}; }

  void put_first(const char* title, std::vector<ChartSeries> series) {
    if (!series.empty()) chart_.panels.insert(chart_.panels.begin(), {title, std::move(series), false, false});
  }

  /// After the panel of the title `after`, or where the forces and moments of the whole end.
  void insert(const std::string& after, const char* title, std::vector<ChartSeries> series, bool from_zero) {
    if (series.empty()) return;
    const auto same = [&](const ChartPanel& p) { return p.title == after; };
    auto place = std::find_if(chart_.panels.begin(), chart_.panels.end(), same);
    if (place != chart_.panels.end()) ++place;
    chart_.panels.insert(place, {title, std::move(series), from_zero, false});
  }

  /// Of tibias, or of patellas.
  std::vector<ChartSeries> clinical(std::size_t from, std::size_t to, bool patella) const {
    std::vector<ChartSeries> out;
    const auto meant = [&](const JointDef& joint) {
      return joint.grood_suntay && joint.grood_suntay->patella == patella;
    };
    const auto knees = std::count_if(scene_.joints.begin(), scene_.joints.end(), meant);
    for (const JointDef& joint : scene_.joints)
      for (std::size_t i = from; meant(joint) && i < to; ++i) {
        const std::string name = clinical_column(joint, i), word = without_unit(clinical_name(joint, i));
        if (poses_.has_column(name)) out.push_back(series(knees > 1 ? joint.name + " " + word : word, name));
      }
    return out;
  }

  /// What quadriceps, patellar tendon and patellofemoral contact carry, and the share of the tendon.
  void add_extensors() {
    std::vector<ChartSeries> forces, ratios;
    const std::vector<ExtensorMechanism> all = extensor_mechanisms(scene_);
    for (const ExtensorMechanism& one : all) {
      const std::string of = all.size() > 1 ? one.joint + " " : "";
      const auto add = [&](std::vector<ChartSeries>& to, const std::string& name, const std::string& column) {
        if (poses_.has_column(column)) to.push_back(series(of + name, column));
      };
      add(forces, "quadriceps", one.quadriceps_column());
      add(forces, "patellar tendon", one.tendon_column());
      for (const std::string& contact : one.contacts) add(forces, contact + " contact", contact + ".force_N");
      add(ratios, "patellar tendon / quadriceps", one.ratio_column());
    }
    insert("Contact force [N]", "Extensor mechanism [N]", std::move(forces), true);
    insert("Extensor mechanism [N]", "Force of the patellar tendon per force of the quadriceps", std::move(ratios),
           true);
  }

  std::vector<ChartSeries> layers(const std::string& quantity) const {
    std::vector<ChartSeries> out;
    for (const LayerDef& layer : scene_.layers) {
      const bool several = scene_.layers.size() > 1;
      const auto add = [&](const std::string& of, const std::string& name) {
        if (poses_.has_column(of + "." + quantity)) out.push_back(series(name, of + "." + quantity));
      };
      for (const RegionDef& region : layer.pair.regions) {
        const std::string full = layer.pair.name + "." + region.name;
        add(full, several ? full : region.name);
      }
      add(layer.pair.name, layer.pair.regions.empty() || several ? layer.pair.name : "whole pair");
    }
    return out;
  }

  /// In the order, and of the ligaments alone, of the panel of forces.
  std::vector<ChartSeries> strains() const {
    const auto forces = std::find_if(chart_.panels.begin(), chart_.panels.end(),
                                     [](const ChartPanel& p) { return p.title == "Ligament force [N]"; });
    std::vector<ChartSeries> out;
    if (forces == chart_.panels.end()) return out;
    const std::vector<LigamentGroup> groups = ligament_groups(scene_);
    for (const ChartSeries& drawn : forces->series) {
      const auto group =
          std::find_if(groups.begin(), groups.end(), [&](const LigamentGroup& g) { return g.name == drawn.name; });
      if (group == groups.end()) continue;
      std::vector<double> mean(poses_.rows(), 0.0);
      for (const std::size_t member : group->members) {
        const std::string name = scene_.ligaments[member].name + ".strain";
        if (!poses_.has_column(name)) continue;
        const std::vector<double> strain = column(name);
        for (std::size_t k = 0; k < mean.size(); ++k)
          mean[k] += 100 * strain[k] / static_cast<double>(group->members.size());
      }
      if (std::any_of(mean.begin(), mean.end(), [](double v) { return std::isfinite(v); }))
        out.push_back({drawn.name, std::move(mean)});
    }
    return out;
  }

  /// About a coordinate: of groups of ligaments the mean of their fibres, and of cables, where they have any.
  void add_moment_arms(const CoordinateRef& c) {
    std::vector<ChartSeries> out;
    const auto add = [&](const std::string& name, const std::vector<std::string>& paths) {
      std::vector<double> mean(poses_.rows(), 0.0);
      double largest = 0;
      for (const std::string& path : paths) {
        const std::string arms = moment_arm_column(scene_, path, c);
        if (!poses_.has_column(arms)) return;
        const std::vector<double> arm = column(arms);
        for (std::size_t k = 0; k < mean.size(); ++k) {
          mean[k] += arm[k] / static_cast<double>(paths.size());
          if (std::isfinite(arm[k])) largest = std::max(largest, std::abs(arm[k]));
        }
      }
      if (largest > kLeastDrawnArm) out.push_back({name, std::move(mean)});
    };
    for (const LigamentGroup& group : ligament_groups(scene_)) {
      std::vector<std::string> fibres;
      for (const std::size_t member : group.members) fibres.push_back(scene_.ligaments[member].name);
      add(group.name, fibres);
    }
    for (const LoadDef& load : scene_.loads) add(load.name, {load.name});
    const std::string title = "Moment arms about " + coordinate_name(scene_, c) +
                              (c.index < 3 ? ", mean of fibres [mm]" : ", mean of fibres [1]");
    insert("Ligament strain, mean of fibres [%]", title.c_str(), std::move(out), false);
  }

  std::vector<ChartSeries> joint_forces() const {
    std::vector<ChartSeries> out;
    for (const JointDef& joint : scene_.joints) {
      if (!poses_.has_column(held_column(joint.name, 0))) continue;
      const auto x = column(held_column(joint.name, 0)), y = column(held_column(joint.name, 1)),
                 z = column(held_column(joint.name, 2));
      std::vector<double> size(x.size());
      for (std::size_t k = 0; k < x.size(); ++k) size[k] = std::hypot(x[k], y[k], z[k]);
      out.push_back({joint.name, std::move(size)});
    }
    return out;
  }

  const PlacedScene& scene_;
  const ResultTable& poses_;
  Chart& chart_;
};

}  // namespace

void add_report_plots(const PlacedScene& scene, const ResultTable& poses, Chart& chart) {
  ReportPlots(scene, poses, chart).add();
}

}  // namespace genu
