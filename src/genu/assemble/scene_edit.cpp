#include "genu/assemble/scene_edit.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "genu/scene/surface_writer.h"
#include "genu/scene/toml_document.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

/// The lines of a TOML file and where its tables begin.
class Lines {
 public:
  Lines(const std::string& text, const TomlNode& document) {
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines_.push_back(line);
    for (const TomlNode& group : document.children) {
      starts_.insert(group.key_where.line);
      for (const TomlNode& member : group.children)
        starts_.insert(member.where.line), starts_.insert(member.key_where.line);
    }
    dropped_.assign(lines_.size(), false);
  }

  /// Drops the table whose header stands on a line, up to the next one's header and the comment right above that.
  bool drop_table(int header) {
    const std::size_t first = static_cast<std::size_t>(header) - 1;
    if (header < 1 || first >= lines_.size() || !is_header(first)) return false;
    std::size_t last = first + 1;
    while (last < lines_.size() && !(is_header(last) && starts_.count(static_cast<int>(last) + 1) > 0)) ++last;
    while (last < lines_.size() && last > first + 1 && is_comment(last - 1)) --last;
    for (std::size_t k = first; k < last; ++k) dropped_[k] = true;
    return true;
  }

  /// False where the line does not hold it, as where a string is written with escapes.
  bool replace(int line, const std::string& what, const std::string& with) {
    std::string& text = lines_[static_cast<std::size_t>(line) - 1];
    const auto place = text.find(what);
    if (place == std::string::npos) return false;
    text.replace(place, what.size(), with);
    return true;
  }

  /// The text with `insert` in front of line `before`.
  std::string text(int before, const std::string& insert) const {
    std::string out;
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      if (static_cast<int>(k) + 1 == before) out += insert;
      if (!dropped_[k]) out += lines_[k] + "\n";
    }
    return out;
  }

 private:
  static std::size_t first_letter(const std::string& line) { return line.find_first_not_of(" \t"); }
  bool is_header(std::size_t k) const {
    const std::size_t first = first_letter(lines_[k]);
    return first != std::string::npos && lines_[k][first] == '[';
  }
  bool is_comment(std::size_t k) const {
    const std::size_t first = first_letter(lines_[k]);
    return first != std::string::npos && lines_[k][first] == '#';
  }

  std::vector<std::string> lines_;
  std::set<int> starts_;
  std::vector<bool> dropped_;
};

std::string pair_tables(const std::vector<FittedPair>& pairs) {
  std::string out;
  for (const FittedPair& p : pairs)
    out += fmt::format("\n[contact.{}]\nsurfaces = [\"{}\", \"{}\"]\nmodel = \"rigid\"\n", p.name, p.surface_a,
                       p.surface_b);
  return out;
}

}  // namespace

std::string with_fitted_surfaces(const std::string& file, const SceneTables& scene,
                                 const std::vector<FittedPair>& pairs, const std::vector<NamedFit>& fits,
                                 const std::string& folder, Diagnostics& out) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream read;
  read << in.rdbuf();
  const std::string source = read.str();
  const auto document = parse_toml(source, file, out);
  if (!document) return {};
  Lines lines(source, *document);
  std::set<int> replaced, used;
  for (const FittedPair& p : pairs) replaced.insert(p.contact);
  for (std::size_t k = 0; k < scene.contacts.size(); ++k) {
    if (replaced.count(static_cast<int>(k)) > 0) continue;
    used.insert(scene.contacts[k].surface_a);
    used.insert(scene.contacts[k].surface_b);
  }
  for (const LayerDef& layer : scene.layers) used.insert({layer.pair.surface_a, layer.pair.surface_b});
  int first = static_cast<int>(std::count(source.begin(), source.end(), '\n')) + 1;
  const auto drop = [&](const std::string& what, const SourceLocation& where) {
    if (!lines.drop_table(where.line))
      out.add(error_at({file, where}, Code::wrong_form, what, {},
                       "is not written as a table with a header of its own, [" + what + "], and cannot be replaced"));
    first = std::min(first, where.line);
  };
  const auto rename_one = [&](const TomlNode* name, const std::string& opened, const std::string& key) {
    const fs::path from = fs::absolute(folder).lexically_normal(), to = fs::absolute(opened).lexically_normal();
    const std::string path = to.lexically_relative(from).generic_string();
    const bool plain = toml_string(path) == '"' + path + '"';  // reads back as it is, in any quotes
    if (name && !(plain && lines.replace(name->where.line, name->text, path)))
      out.add(error_at({file, name->where}, Code::wrong_form, key, {},
                       "cannot be told from the new scene's folder: give the mesh a name without quotes, "
                       "backslashes and control characters"));
  };
  const auto rename = [&](const TomlNode* names, const PieceFiles& opened, const std::string& key) {
    const bool list = names && names->kind == TomlNode::Kind::array;
    for (std::size_t k = 0; k < opened.paths.size(); ++k)
      rename_one(list ? &names->children[k] : names, opened.paths[k], key);
  };
  for (const BodyDef& body : scene.bodies)
    if (body.solid)
      rename(document->member("body")->member(body.name)->member("solid")->member("file"), body.solid->file,
             "body." + body.name + ".solid.file");
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
    const SurfaceDef& s = scene.surfaces[k];
    const bool meshed = s.shape == SurfaceDef::Shape::mesh;
    if (meshed && used.count(static_cast<int>(k)) == 0) {
      drop("surface." + s.name, s.where);
    } else {
      const TomlNode* table = document->member("surface")->member(s.name);
      if (meshed) rename(table ? table->member("file") : nullptr, s.file, "surface." + s.name + ".file");
      const TomlNode* thickness = table ? table->member("thickness") : nullptr;
      if (thickness && s.thickness && s.thickness->measured)
        rename(thickness->member("bone"), s.thickness->bone, "surface." + s.name + ".thickness.bone");
    }
  }
  for (const int k : replaced) {
    const ContactDef& c = scene.contacts[static_cast<std::size_t>(k)];
    const TomlNode* table = document->member("contact")->member(c.name);
    const TomlNode* model = table ? table->member("model") : nullptr;
    if (model && model->text != "rigid")
      out.add(error_at({file, model->where}, Code::not_applicable, "contact." + c.name + ".model", literal(*model),
                       "only rigid contacts are written anew with fitted surfaces"));
    drop("contact." + c.name, c.where);
  }
  return lines.text(first, surface_tables(fits, scene.length_unit, scene.angle_unit) + pair_tables(pairs) + "\n");
}

}  // namespace genu
