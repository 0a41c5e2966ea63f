// Scenes of the statistical shape model's knees (Clouthier et al. 2019): meshes as published, ligaments between
// vertices of the bone meshes, which correspond from knee to knee.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "support/knee_scene.h"

namespace genu::test {

using Point = std::array<double, 3>;

/// Vertices of a binary little-endian PLY as VTK writes it, in the order of the file, in the axes of the published
/// model: x anterior, y superior, z lateral (the mesh's y, z, x), mm.
inline std::vector<Point> ply_vertices(const std::string& path) {
  const std::string bytes = read_text(path);
  const std::size_t header = bytes.find("end_header\n") + 11;
  const std::string head = bytes.substr(0, header);
  const std::size_t count = std::stoul(head.substr(head.find("element vertex") + 15));
  std::size_t floats = 0;
  for (std::size_t at = head.find("property float"); at != std::string::npos; at = head.find("property float", at + 1))
    ++floats;
  std::vector<Point> out(count);
  for (std::size_t i = 0; i < count; ++i) {
    float v[3];
    std::memcpy(v, bytes.data() + header + 4 * floats * i, sizeof v);
    out[i] = {v[1], v[2], v[0]};
  }
  return out;
}

inline double extent(const std::vector<Point>& points, std::size_t axis) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Point& p : points) low = std::min(low, p[axis]), high = std::max(high, p[axis]);
  return high - low;
}

/// The tibiofemoral scene of "mean", "S001" or "S002": 55 fibres with the stiffness of the Lenhart 2015 model, slack
/// lengths from the shape model's reference strains, 100 N along the tibia. The ligaments' shifts are fractions of the
/// tibia's width (mesh x) and height (mesh z): this reproduces the mean knee's published points to 4e-9 m.
inline std::string ssm_scene(const std::string& subject, int degrees, int increments) {
  const std::string tail = subject == "mean" ? "_shifted" : "";
  const auto femur = ply_vertices(data_path("ssm/" + subject + "_Femur.ply"));
  const auto tibia = ply_vertices(data_path("ssm/" + subject + "_Tibia" + tail + ".ply"));
  const double width = extent(tibia, 2), height = extent(tibia, 1);
  std::map<std::string, nlohmann::json> laws;
  const auto lenhart = nlohmann::json::parse(read_text(data_path("lenhart2015/lenhart_ligaments.json")));
  for (const auto& l : lenhart["ligaments"]) laws[l["name"]] = l;

  std::string text = lenhart_scene("", 0, degrees, increments);
  text = text.substr(0, text.find("[ligament."));
  const std::string axes = "units = \"mm\"\nx_axis = [0, 0, 1]\nz_axis = [0, 1, 0]\n";
  text = replaced(text, "units = \"m\"\n", axes);
  text = replaced(text, data_path("lenhart2015/ACLC01-R-femur-cart.stl"),
                  data_path("ssm/" + subject + "_Femur_Cartilage.ply"));
  text = replaced(text, data_path("lenhart2015/ACLC01-R-tibia-cart.stl"),
                  data_path("ssm/" + subject + "_Tibia_Cartilage" + tail + ".ply"));
  std::ostringstream out;
  out.precision(17);
  out << text;
  const auto point = [&out](const char* end, const char* body, const Point& p) {
    out << end << " = { body = \"" << body << "\", point = [" << p[0] << ", " << p[1] << ", " << p[2] << "] }\n";
  };
  for (const auto& l : nlohmann::json::parse(read_text(data_path("ssm/mean_ligaments.json")))) {
    if (l["segment"] != nlohmann::json({"femur_distal_r", "tibia_proximal_r"})) continue;
    Point to = tibia[l["node"][1].get<std::size_t>()];
    if (!l["shift"].empty()) {
      to[1] += l["shift"][1][2].get<double>() * height;
      to[2] += l["shift"][1][0].get<double>() * width;
    }
    const auto& law = laws.at(l["name"]);
    out << "[ligament." << l["name"].get<std::string>() << "]\n";
    point("from", "femur", femur[l["node"][0].get<std::size_t>()]);
    point("to", "tibia", to);
    out << "law = \"blankevoort\"\nstiffness = " << law["linear_stiffness_N_per_strain"].get<double>()
        << "\nreference_strain = " << l["ReferenceStrain"].get<double>()
        << "\ntransition_strain = " << law["transition_strain"].get<double>() << "\n\n";
  }
  out << "[[step]]\nprescribe = { \"knee.flexion\" = [0, " << degrees << "] }\nincrements = " << increments << "\n";
  return out.str();
}

}  // namespace genu::test
