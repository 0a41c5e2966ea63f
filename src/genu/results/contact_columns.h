// The columns of contacts, rigid and elastic: the same for equilibria and for motions.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "genu/equilibrium/active_set.h"
#include "genu/model/layer_report.h"
#include "genu/results/result_table.h"

namespace genu {

class ContactColumns {
 public:
  /// `numbers`: how many contacts each pair has had; each has columns of its own where that is 2 or more.
  ContactColumns(const PlacedScene& scene, const JointModel& model, std::vector<int> numbers)
      : scene_(scene), model_(model), numbers_(std::move(numbers)) {}

  void add_columns(ResultTable& table) const;

  /// Fills the last row. `pair_gap`: m, of each pair; `layers`: of each elastic layer, empty where they are to be found
  /// here, with the damping that the bodies' `twist` means where there is one; `forces`: those of rigid contacts are
  /// known.
  void set(ResultTable& table, const State& state, const std::vector<OpenContact>& open,
           const std::vector<double>& pair_gap, const std::vector<LayerReport>& layers, bool forces,
           const VecX* twist = nullptr);

 private:
  /// A contact point as shown: held or open.
  struct Shown {
    double force = 0, gap = 0;
    Vec3 a, b;
  };
  using Contacts = std::map<int, Shown>;  ///< by number

  void add_pair(const std::string& name, std::size_t pair, ResultTable& table) const;
  void add_layer(const LayerDef& layer, ResultTable& table) const;
  void set_pair(std::size_t pair, const Contacts& contacts, double gap, bool forces, ResultTable& table) const;
  void set_point(std::size_t column, std::size_t pair, const Vec3& a, const Vec3& b, ResultTable& table) const;
  void set_contact(const std::string& name, std::size_t pair, const Shown& c, ResultTable& table) const;
  void set_region(const std::string& name, const RegionDef& region, const Contacts& contacts, const Vec3& origin,
                  ResultTable& table) const;
  void set_layer(std::size_t k, const LayerReport& report, ResultTable& table) const;
  Contacts contacts_of(std::size_t pair, const State& state, const std::vector<OpenContact>& open) const;
  const Vec3& centre(std::size_t pair, bool second) const;

  const PlacedScene& scene_;
  const JointModel& model_;
  std::vector<int> numbers_;
  std::vector<ElasticLayer::Memory> layer_memory_;
};

}  // namespace genu
