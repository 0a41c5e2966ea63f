// The knee of Lenhart et al. (2015) as a simulation of it was published: femur, tibia and patella, two cartilage
// contacts, 75 ligaments as straight lines, and the 251 poses of a passive flexion with what OpenSim-JAM found there.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "support/knee_scene.h"

namespace genu::test {

inline nlohmann::json published_json() {
  return nlohmann::json::parse(read_text(data_path("lenhart2015/lenhart_ligaments.json")));
}

/// The scene, in m and rad, with the femur's cartilage from `femur`. The joints' rotations are those of the model;
/// lines that wrap in it are straight here.
inline std::string published_scene(const std::string& femur) {
  const std::map<std::string, std::string> bodies = {
      {"femur_distal_r", "femur"}, {"tibia_proximal_r", "tibia"}, {"patella_r", "patella"}};
  std::string text = R"(format = 1
title = "Lenhart 2015, published poses"
units = { length = "m", angle = "rad" }
[body.femur]
fixed = true
[body.tibia]
[body.patella]
[joint.knee]
type = "free"
parent = "femur"
child = "tibia"
rotations = ["flexion -z", "adduction x", "rotation y"]
translations = ["x", "y", "z"]
[joint.pf]
type = "free"
parent = "femur"
child = "patella"
rotations = ["flexion -z", "rotation x", "tilt y"]
translations = ["x", "y", "z"]
)";
  for (const auto& [body, file] : {std::pair<std::string, std::string>{"femur", femur},
                                   {"tibia", data_path("lenhart2015/ACLC01-R-tibia-cart.stl")},
                                   {"patella", data_path("lenhart2015/ACLC01-R-patella-cart_shift.stl")}})
    text += fmt::format("[surface.{0}]\nbody = \"{0}\"\nshape = \"mesh\"\nfile = \"{1}\"\nunits = \"m\"\n", body, file);
  for (const auto& [name, body] : {std::pair<std::string, std::string>{"tf", "tibia"}, {"pf", "patella"}})
    text += fmt::format(
        "[contact.{0}]\nsurfaces = [\"femur\", \"{1}\"]\nmodel = \"cartilage\"\nmodulus = 10\npoisson = 0.45\n"
        "thickness = 0.006\nlaw = \"linear\"\nquadrature = \"triangles\"\ncast_from = \"{1}\"\nsearch_depth = 0.02\n",
        name, body);
  for (const auto& l : published_json().at("ligaments")) {
    const auto from = bodies.find(l.at("bodyA").get<std::string>()), to = bodies.find(l.at("bodyB").get<std::string>());
    if (from == bodies.end() || to == bodies.end()) continue;
    const auto point = [&](const char* key) {
      return fmt::format("{:.17g}", fmt::join(l.at(key).get<std::vector<double>>(), ", "));
    };
    text += fmt::format(
        "[ligament.{}]\nfrom = {{ body = \"{}\", point = [{}] }}\nto = {{ body = \"{}\", point = [{}] }}\n"
        "law = \"blankevoort\"\nstiffness = {:.17g}\nslack_length = {:.17g}\ntransition_strain = {:.17g}\n",
        l.at("name").get<std::string>(), from->second, point("pA"), to->second, point("pB"),
        l.at("linear_stiffness_N_per_strain").get<double>(), l.at("slack_length_m").get<double>(),
        l.at("transition_strain").get<double>());
  }
  return text + "[[step]]\nincrements = 1\n";
}

/// A column of one of the published tables.
class PublishedTable {
 public:
  explicit PublishedTable(const std::string& file) {
    std::istringstream text(read_text(data_path("lenhart2015/" + file)));
    std::string line;
    std::getline(text, line);
    for (const std::string& name : split(line)) names_.push_back(name);
    while (std::getline(text, line)) rows_.push_back(split(line));
  }
  std::size_t rows() const { return rows_.size(); }
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

}  // namespace genu::test
