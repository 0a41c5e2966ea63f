#include "genu/study/chosen_scene.h"

#include <algorithm>
#include <array>
#include <sstream>

#include <fmt/format.h>

#include "genu/assemble/scene_values.h"
#include "genu/mesh_files/mesh_writer.h"
#include "genu/scene/toml_document.h"
#include "genu/surface/blend_surface.h"

namespace genu {
namespace {

using Keys = std::vector<std::pair<std::string, std::string>>;

/// What a formula needs and a mesh does not.
constexpr std::array kOfFormulas = {"radius", "radii", "major_radius", "minor_radius", "chart", "terms"};

/// The keys of a surface's table that a setting changes; none where the surface stays as it is.
Keys keys_of(const Prepared& p, std::size_t surface, const AccuracySetting& setting) {
  const SurfaceDef& def = p.scene.surfaces[surface];
  const auto& blend = p.notes[surface].blend;
  Keys keys;
  if (changes_mesh(p, surface, setting))
    keys = {{"shape", "\"mesh\""}, {"file", fmt::format("\"{}.ply\"", def.name)}, {"units", "\"m\""}};
  if ((blend || !keys.empty()) && setting.degree > 0) keys.emplace_back("degree", std::to_string(setting.degree));
  if (blend && setting.radius_factor > 0)
    keys.emplace_back("fit_radius",
                      fmt::format("{}", setting.radius_factor * blend->facts().fit_radius / p.scene.length_unit));
  return keys;
}

/// The mesh as its file would have it: in the surface's own frame, in metres.
std::string own_mesh(const Prepared& p, std::size_t surface, const AccuracySetting& setting) {
  Mesh mesh = mesh_of(p, surface, setting);
  const SurfaceDef& def = p.scene.surfaces[surface];
  const Pose back = def.placement.inverse();
  for (Vec3& v : mesh.vertices) v = back * v;
  if (def.inside)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return ply_bytes(mesh, 1, "cut by genu accuracy: " + def.name);
}

class Text {
 public:
  explicit Text(const std::string& text) {
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines_.push_back(line);
  }

  /// Puts keys below the header of a table, in the place of those it has; those of formulas go if a mesh comes. False
  /// where the table has no header.
  bool set(const TomlNode& table, const Keys& keys) {
    std::string& header = lines_[at(table.where.line - 1)];
    const auto first = header.find_first_not_of(" \t");
    if (first == std::string::npos || header[first] != '[') return false;
    const bool mesh = keys[0].first == "shape";
    for (const TomlNode& member : table.children) {
      const bool again = std::any_of(keys.begin(), keys.end(), [&](const auto& k) { return k.first == member.key; });
      const bool formula = std::find(kOfFormulas.begin(), kOfFormulas.end(), member.key) != kOfFormulas.end();
      if (again || (mesh && formula)) comment_out(member);
    }
    for (const auto& [key, value] : keys) header += "\n" + key + " = " + value;
    return true;
  }

  /// Puts another number in the place of one.
  void set_number(const SourceLocation& where, const std::string& value) {
    std::string& line = lines_[at(where.line - 1)];
    const auto first = static_cast<std::size_t>(where.column) - 1;
    line.replace(first, line.find_first_not_of("0123456789+-._eE", first) - first, value);
  }

  void append(const std::string& line) { lines_.push_back(line); }

  std::string whole() const {
    std::string out;
    for (const std::string& line : lines_) out += line + "\n";
    return out;
  }

 private:
  /// The last line of a value; a bracket may stand alone on the one after its last element.
  int last_line(const TomlNode& node) const {
    int last = node.where.line;
    for (const TomlNode& child : node.children) last = std::max(last, last_line(child));
    if (node.kind != TomlNode::Kind::array) return last;
    for (int k = last; k < static_cast<int>(lines_.size()); ++k) {
      const auto first = lines_[at(k)].find_first_not_of(" \t,]");
      if (lines_[at(k)].find(']') == std::string::npos || first == 0) break;
      if (first != std::string::npos && lines_[at(k)][first] != '#') break;
      last = k + 1;
    }
    return last;
  }

  void comment_out(const TomlNode& member) {
    const int last = last_line(member);
    for (int k = member.key_where.line; k <= last; ++k) lines_[at(k - 1)].insert(0, "# ");
  }

  std::vector<std::string> lines_;
};

/// False where the file has a [solver] that cannot be written anew.
bool set_tolerance(const TomlNode& document, double tolerance, Text& text) {
  const std::string value = fmt::format("{}", tolerance);
  const TomlNode* solver = document.member("solver");
  if (solver == nullptr) {
    for (const std::string& line : {std::string(), std::string("[solver]"), "tolerance = " + value}) text.append(line);
    return true;
  }
  const TomlNode* own = solver->member("tolerance");
  if (own == nullptr) return text.set(*solver, {{"tolerance", value}});
  text.set_number(own->where, value);
  return true;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> chosen_scene(const std::string& file, const Prepared& p,
                                                              const AccuracySetting& setting, const std::string& folder,
                                                              Diagnostics& out) {
  const std::string moved = with_values(file, p.scene, {}, folder, out);
  const auto document = parse_toml(moved, file, out);
  if (!document) return {};
  const auto refuse = [&](const std::string& key, const SourceLocation& where) {
    out.add(error_at({file, where}, Code::wrong_form, key, {},
                     "is not written as a table with a header of its own, and cannot be written anew: leave out "
                     "--target"));
  };
  Text text(moved);
  std::vector<std::pair<std::string, std::string>> files;
  for (std::size_t i = 0; i < p.scene.surfaces.size(); ++i) {
    const SurfaceDef& def = p.scene.surfaces[i];
    const Keys keys = keys_of(p, i, setting);
    if (keys.empty()) continue;
    if (!text.set(*document->member("surface")->member(def.name), keys))
      refuse("surface." + def.name, def.where);
    else if (changes_mesh(p, i, setting))
      files.emplace_back(def.name + ".ply", own_mesh(p, i, setting));
  }
  for (const LayerDef& layer : p.scene.layers)
    if (setting.layer_tolerance > 0 && layer.quadrature == LayerDef::Quadrature::smooth &&
        !text.set(*document->member("contact")->member(layer.pair.name),
                  {{"tolerance", fmt::format("{}", setting.layer_tolerance)}}))
      refuse("contact." + layer.pair.name, layer.pair.where);
  if (setting.tolerance > 0 && !set_tolerance(*document, setting.tolerance, text))
    refuse("solver", document->member("solver")->where);
  files.emplace_back("scene.toml", text.whole());
  return files;
}

}  // namespace genu
