#include "genu/assemble/scene_values.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include <fmt/format.h>

#include "genu/assemble/changed_scene.h"
#include "genu/assemble/parameter_values.h"
#include "genu/assemble/text_places.h"
#include "genu/scene/toml_document.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

/// Calls visit(key, node) for every name of a mesh file.
void for_mesh_names(const TomlNode& document, const std::function<void(const std::string&, const TomlNode&)>& visit) {
  const auto look = [&](const TomlNode* table, const char* member, const std::string& key) {
    const TomlNode* names = table ? table->member(member) : nullptr;
    if (names == nullptr) return;
    if (names->kind == TomlNode::Kind::string) visit(key + "." + member, *names);
    if (names->kind == TomlNode::Kind::array)  // of the pieces of one mesh
      for (const TomlNode& name : names->children)
        if (name.kind == TomlNode::Kind::string) visit(key + "." + member, name);
  };
  if (const TomlNode* bodies = document.member("body"))
    for (const TomlNode& body : bodies->children) look(body.member("solid"), "file", "body." + body.key + ".solid");
  if (const TomlNode* surfaces = document.member("surface"))
    for (const TomlNode& surface : surfaces->children) {
      look(&surface, "file", "surface." + surface.key);
      look(surface.member("thickness"), "bone", "surface." + surface.key + ".thickness");
    }
}

}  // namespace

std::string with_values(const std::string& file, const SceneTables& scene,
                        const std::vector<std::pair<Parameter, double>>& values, const std::string& folder,
                        Diagnostics& out) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream read;
  read << in.rdbuf();
  const auto document = parse_toml(read.str(), file, out);
  if (!document) return {};
  TextPlaces replaced(read.str());
  const auto error = [&](const SourceLocation& where, Code code, const std::string& key, const std::string& rule) {
    out.add(error_at({file, where}, code, key, {}, rule));
  };
  for (const auto& [parameter, value] : values) {
    const ParameterPlace place = parameter_place(scene, parameter, *document);
    if (place.node)
      replaced.value(place.node->where, fmt::format("{}", value / place.file_unit));
    else
      error({}, Code::missing_key, place.key,
            "is not said by the scene, and so cannot be varied: write the value that holds without it");
  }
  write_changes(scene, replaced, out);
  const fs::path from = fs::absolute(folder).lexically_normal();
  const fs::path own = fs::absolute(file).lexically_normal().parent_path();
  for_mesh_names(*document, [&](const std::string& key, const TomlNode& name) {
    if (fs::path(name.text).is_absolute()) return;
    const std::string path = (own / name.text).lexically_normal().lexically_relative(from).generic_string();
    if (!replaced.word(name.where, name.text, path))
      error(name.where, Code::wrong_form, key,
            "cannot be told from the new scene's folder: give the mesh a name without quotes, backslashes and control "
            "characters");
  });
  return replaced.text();
}

std::string with_mesh_names(const std::string& text, const std::function<std::string(const std::string&)>& rename) {
  Diagnostics ignored;
  const auto document = parse_toml(text, "", ignored);
  if (!document) return text;
  TextPlaces replaced(text);
  for_mesh_names(*document, [&](const std::string&, const TomlNode& name) {
    replaced.word(name.where, name.text, rename(name.text));
  });
  return replaced.text();
}

}  // namespace genu
