#include "genu/run/chosen_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include <fmt/format.h>

#include "genu/core/atomic_output.h"
#include "genu/geometry/blend_surface.h"
#include "genu/geometry/mesh_writer.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

bool is_header(const std::string& line) {
  const auto first = line.find_first_not_of(" \t");
  return first != std::string::npos && line[first] == '[';
}

bool sets(const std::string& line, const std::string& key) {
  return std::regex_search(line, std::regex("^\\s*" + key + "\\s*="));
}

/// Paths of files, seen from another folder.
void move_paths(std::vector<std::string>& lines, const fs::path& from, const fs::path& to) {
  static const std::regex quoted("\"([^\"\\\\]+)\"");
  for (std::string& line : lines) {
    std::string moved;
    auto rest = line.cbegin();
    for (std::smatch m; std::regex_search(rest, line.cend(), m, quoted); rest = m[0].second) {
      const fs::path path = m[1].str();
      std::error_code unused;
      const bool file = path.is_relative() && fs::is_regular_file(from / path, unused);
      moved.append(rest, m[0].first);
      moved += file ? "\"" + fs::absolute(from / path).lexically_normal().lexically_relative(to).generic_string() + "\""
                    : m[0].str();
    }
    moved.append(rest, line.cend());
    line = moved;
  }
}

/// How many brackets a line leaves open.
int open_brackets(const std::string& line) {
  int open = 0;
  for (const char c : line.substr(0, line.find('#'))) open += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
  return open;
}

/// Puts keys right below the header on line `header` (from 1), and makes comments of those that were set before and of
/// the others in `without`.
bool set_keys(std::vector<std::string>& lines, int header, const std::vector<std::pair<std::string, std::string>>& keys,
              std::vector<std::string> without = {}) {
  const std::size_t first = static_cast<std::size_t>(header) - 1;
  if (header < 1 || first >= lines.size() || !is_header(lines[first])) return false;
  for (const auto& [key, value] : keys) without.push_back(key);
  int open = 0;
  for (std::size_t k = first + 1; k < lines.size() && (open > 0 || !is_header(lines[k])); ++k) {
    const bool drop = open > 0 || std::any_of(without.begin(), without.end(),
                                              [&](const std::string& key) { return sets(lines[k], key); });
    if (!drop) continue;
    open += open_brackets(lines[k]);
    lines[k] = "# " + lines[k];
  }
  for (const auto& [key, value] : keys) lines[first] += "\n" + key + " = " + value;
  return true;
}

/// The mesh as its file would have it: in the surface's own frame, in metres.
std::string write_own_mesh(const Prepared& p, std::size_t surface, const AccuracySetting& setting,
                           const fs::path& file) {
  Mesh mesh = mesh_of(p, surface, setting);
  const SurfaceDef& def = p.scene.surfaces[surface];
  const Pose back = def.placement.inverse();
  for (Vec3& v : mesh.vertices) v = back * v;
  if (def.inside)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return write_mesh(mesh, file.string(), 1, "cut by genu accuracy: " + def.name);
}

}  // namespace

std::string write_chosen_scene(const std::string& file, const Prepared& p, const AccuracySetting& setting,
                               const std::string& folder) {
  std::vector<std::string> lines = lines_of(file);
  move_paths(lines, fs::absolute(file).parent_path(), fs::absolute(folder).lexically_normal());
  for (std::size_t i = 0; i < p.scene.surfaces.size(); ++i) {
    const SurfaceDef& def = p.scene.surfaces[i];
    const bool mesh = def.shape == SurfaceDef::Shape::mesh;
    // What with_setting() leaves as it is.
    if (!mesh && (p.surfaces[i]->is_unbounded() || !has_closed_forms_alone(p))) continue;
    std::vector<std::pair<std::string, std::string>> keys;
    if (mesh ? setting.edge_factor > 1 : setting.edge_factor > 0) {
      const std::string name = def.name + ".ply";
      if (const std::string error = write_own_mesh(p, i, setting, fs::path(folder) / name); !error.empty())
        return error;
      keys = {{"shape", "\"mesh\""}, {"file", "\"" + name + "\""}, {"units", "\"m\""}};
    }
    if ((p.notes[i].blend || !keys.empty()) && setting.degree > 0)
      keys.emplace_back("degree", std::to_string(setting.degree));
    if (p.notes[i].blend && setting.radius_factor > 0)
      keys.emplace_back(
          "fit_radius",
          fmt::format("{:.17g}", setting.radius_factor * p.notes[i].blend->facts().fit_radius / p.scene.length_unit));
    if (!keys.empty() &&
        !set_keys(lines, def.where.line, keys, {"radius", "radii", "major_radius", "minor_radius", "chart", "terms"}))
      return "surface." + def.name +
             " is not written as a table with a header of its own: its setting cannot be written";
  }
  std::string text;
  for (const std::string& line : lines) {
    std::smatch m;
    static const std::regex increments("^(\\s*increments\\s*=\\s*)([0-9_]+)(.*)$");
    if (setting.increments > 0 && std::regex_match(line, m, increments))
      text += m[1].str() + std::to_string(std::lround(setting.increments * std::stod(m[2].str()))) + m[3].str() + "\n";
    else
      text += line + "\n";
  }
  return write_file_atomically(fs::path(folder) / "scene.toml", text);
}

}  // namespace genu
