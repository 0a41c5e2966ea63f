#include "genu/assemble/scene_values.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include <fmt/format.h>

#include "genu/assemble/parameter_values.h"
#include "genu/scene/toml_document.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

/// Spans of a text to be replaced, found by line and column.
class Replacements {
 public:
  explicit Replacements(std::string text) : text_(std::move(text)) {
    starts_.push_back(0);
    for (std::size_t k = 0; k < text_.size(); ++k)
      if (text_[k] == '\n') starts_.push_back(k + 1);
  }

  /// Of a place as TOML counts columns: in characters, of which UTF-8 may need several bytes.
  std::size_t offset(const SourceLocation& where) const {
    std::size_t k = starts_[static_cast<std::size_t>(where.line) - 1];
    for (int column = 1; column < where.column && k < text_.size(); ++column) {
      ++k;
      while (k < text_.size() && (static_cast<unsigned char>(text_[k]) & 0xC0) == 0x80) ++k;
    }
    return k;
  }

  void number(const SourceLocation& where, const std::string& with) {
    const std::size_t first = offset(where);
    spans_.push_back({first, text_.find_first_not_of("0123456789+-._eExXoObBaAcCdDfFinN", first), with});
  }

  /// False where the value is not written as the name in quotes of one character.
  bool word(const SourceLocation& where, const std::string& name, const std::string& with) {
    const std::size_t first = offset(where) + 1;
    if (text_.compare(first, name.size(), name) != 0) return false;
    const char quote = text_[first - 1];
    if ((quote != '"' && quote != '\'') || text_[first + name.size()] != quote) return false;
    if (with.find_first_of("\"'\\\n") != std::string::npos) return false;
    spans_.push_back({first, first + name.size(), with});
    return true;
  }

  std::string text() {
    std::sort(spans_.begin(), spans_.end(), [](const Span& a, const Span& b) { return a.first > b.first; });
    for (const Span& s : spans_) text_.replace(s.first, std::min(s.last, text_.size()) - s.first, s.with);
    return std::move(text_);
  }

 private:
  struct Span {
    std::size_t first, last;
    std::string with;
  };
  std::string text_;
  std::vector<std::size_t> starts_;
  std::vector<Span> spans_;
};

/// Calls visit(key, node) for every name of a mesh file.
void for_mesh_names(const TomlNode& document, const std::function<void(const std::string&, const TomlNode&)>& visit) {
  const auto look = [&](const TomlNode* table, const char* member, const std::string& key) {
    if (const TomlNode* name = table ? table->member(member) : nullptr; name && name->kind == TomlNode::Kind::string)
      visit(key + "." + member, *name);
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
  Replacements replaced(read.str());
  const auto error = [&](const SourceLocation& where, Code code, const std::string& key, const std::string& rule) {
    out.add(error_at({file, where}, code, key, {}, rule));
  };
  for (const auto& [parameter, value] : values) {
    const ParameterPlace place = parameter_place(scene, parameter, *document);
    if (place.node)
      replaced.number(place.node->where, fmt::format("{}", value / place.file_unit));
    else
      error({}, Code::missing_key, place.key,
            "is not said by the scene, and so cannot be varied: write the value that holds without it");
  }
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
  Replacements replaced(text);
  for_mesh_names(*document, [&](const std::string&, const TomlNode& name) {
    replaced.word(name.where, name.text, rename(name.text));
  });
  return replaced.text();
}

}  // namespace genu
