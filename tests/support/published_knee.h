// The knee of Lenhart et al. (2015) at the 251 poses of a published passive flexion, and what OpenSim-JAM found there.
#pragma once

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "support/knee_scene.h"
#include "support/places.h"

namespace genu::test {

/// The scene of meshes/lenhart2015, its paths absolute, with the femur's cartilage from `femur`.
inline std::string published_scene(const std::string& femur) {
  const std::string text = read_text(genu::test::source_folder() + "/meshes/lenhart2015/scene-published-poses.toml");
  return replaced(replaced(text, "../../../shared/data/lenhart2015/ACLC01-R-femur-cart.stl", femur),
                  "../../../shared/data/lenhart2015/", data_path("lenhart2015/"));
}

/// Ligaments that are straight in every published pose.
inline std::vector<std::string> ligaments_that_never_wrap() {
  constexpr double kStraight = 1e-8;  // m: what wrapping ever adds to the length
  const auto json = nlohmann::json::parse(read_text(data_path("lenhart2015/lenhart_ligaments.json")));
  std::vector<std::string> names;
  for (const auto& l : json.at("ligaments"))
    if (l.contains("passive_flexion") && l.at("passive_flexion").at("max_wrap_effect_m").get<double>() < kStraight)
      names.push_back(l.at("name").get<std::string>());
  return names;
}

/// One of the published tables: a row of names, then numbers.
class PublishedTable {
 public:
  explicit PublishedTable(const std::string& file) {
    std::istringstream text(read_text(data_path("lenhart2015/" + file)));
    std::string line;
    std::getline(text, line);
    names_ = split(line);
    while (std::getline(text, line)) rows_.push_back(split(line));
  }
  std::size_t rows() const { return rows_.size(); }
  /// NaN for a column that is not there.
  double at(std::size_t row, const std::string& name) const {
    for (std::size_t c = 0; c < names_.size(); ++c)
      if (names_[c] == name) return std::stod(rows_.at(row).at(c));
    return std::nan("");
  }

 private:
  static std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    return cells;
  }
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> rows_;
};

/// Ligaments of which a published table has a length, NAME_L_m.
inline std::vector<std::string> ligament_names(const std::string& file) {
  std::istringstream text(read_text(data_path("lenhart2015/" + file)));
  std::string line;
  std::getline(text, line);
  std::istringstream cells(line);
  std::vector<std::string> names;
  for (std::string cell; std::getline(cells, cell, ',');)
    if (cell.ends_with("_L_m")) names.push_back(cell.substr(0, cell.size() - 4));
  return names;
}

}  // namespace genu::test
