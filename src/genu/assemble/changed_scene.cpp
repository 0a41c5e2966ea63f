#include "genu/assemble/changed_scene.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "genu/assemble/parameter_values.h"
#include "genu/assemble/refuse_option.h"
#include "genu/assemble/text_places.h"
#include "genu/scene/reader.h"

namespace genu {
namespace {

constexpr std::array kGroups = {"ligament", "contact", "load"};

/// "x0.5", "+2" or "1000".
struct NewValue {
  enum class Kind { number, times, plus } kind = Kind::number;
  double value = 0;

  double of(double old) const { return kind == Kind::times ? old * value : kind == Kind::plus ? old + value : value; }
};

std::optional<NewValue> parse_value(std::string_view text) {
  NewValue v;
  if (!text.empty() && (text[0] == 'x' || text[0] == '+')) {
    v.kind = text[0] == 'x' ? NewValue::Kind::times : NewValue::Kind::plus;
    text.remove_prefix(1);
  }
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v.value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size() || !std::isfinite(v.value)) return {};
  return v;
}

/// "12 ligaments", "1 contact"
std::string counted(std::size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

class Changes {
 public:
  /// `scene` is what `document` says before it is changed.
  Changes(TomlNode& document, const Scene& scene, Diagnostics& out) : document_(document), scene_(scene), out_(out) {}

  void leave_out(const std::string& pattern) {
    std::vector<std::string> known;
    for (const BundleDef& bundle : scene_.bundles) known.push_back(bundle.name);
    std::string found;
    for (const char* group : kGroups) {
      std::size_t count = 0;
      for (TomlNode& table : members(group)) {
        known.push_back(table.key);
        if (!matches(scene_, pattern, table.key) && !matches(scene_, pattern, std::string(group) + "." + table.key))
          continue;
        disable(group, table);
        ++count;
      }
      if (count > 0) found += (found.empty() ? "" : ", ") + counted(count, group);
    }
    if (found.empty())
      refuse_option(out_, Code::unknown_name, "--without", pattern,
                    "is no ligament, bundle, contact or load of this scene" + did_you_mean(pattern, known));
    applied_.words.push_back("without " + pattern + " (" + found + ")");
  }

  void set(const std::string& option) {
    const auto equals = option.rfind('=');
    const auto value = equals == std::string::npos ? std::nullopt : parse_value(option.substr(equals + 1));
    if (!value || equals == 0) {
      refuse_option(out_, Code::wrong_form, "--set", option,
                    "is not NAME=VALUE with a number (AAC.stiffness=1000), a factor (x0.5) or a change (+2)");
      return;
    }
    const std::string pattern = option.substr(0, equals);
    std::size_t count = 0;
    double before = 0, after = 0;
    for (const Place& place : places_of(pattern)) {
      before = place.node->number;
      after = value->of(before);
      put(*place.node, after);
      applied_.edits.push_back({place.node->where, place.key, fmt::format("{}", after)});
      ++count;
    }
    if (count == 1)
      applied_.words.push_back(fmt::format("{} {:g} -> {:g}", pattern, before, after));
    else
      applied_.words.push_back(fmt::format("{} ({})", option, counted(count, "number")));
  }

  AppliedChanges take() { return std::move(applied_); }

 private:
  struct Place {
    TomlNode* node;
    std::string key;
  };

  std::vector<TomlNode> none_;

  std::vector<TomlNode>& members(const char* group) {
    for (TomlNode& child : document_.children)
      if (child.key == group) return child.children;
    return none_;
  }

  void disable(const std::string& group, TomlNode& table) {
    const TomlNode* written = table.member("enabled");
    if (written != nullptr && written->kind == TomlNode::Kind::boolean && !written->boolean) return;  // as it is
    TomlNode off;
    off.kind = TomlNode::Kind::boolean;
    off.key = "enabled";
    off.key_where = off.where = table.key_where;
    const std::string key = group + "." + table.key + ".enabled";
    if (written != nullptr)
      applied_.edits.push_back({written->where, key, "false"});
    else
      applied_.edits.push_back({table.key_where, key, "enabled = false", true});
    std::erase_if(table.children, [](const TomlNode& member) { return member.key == "enabled"; });
    table.children.push_back(off);
  }

  static void put(TomlNode& node, double value) {
    node.kind = TomlNode::Kind::floating;
    node.number = value;
  }

  /// The numbers that a pattern names: those of parameters as the file gives them, and those of contacts.
  std::vector<Place> places_of(const std::string& pattern) {
    std::vector<Place> found;
    std::vector<std::string> known;
    std::string missing, fixed;
    for (const Parameter& p : parameters_of(scene_)) {
      known.push_back(p.name);
      if (!matches(scene_, pattern, p.name)) continue;
      Scene& numbers = const_cast<Scene&>(scene_);  // looked up, not written
      if (parameter_number(numbers, p) == nullptr && p.kind != Parameter::Kind::term &&
          p.kind != Parameter::Kind::surface_number) {
        fixed = p.name;
        continue;
      }
      const ParameterPlace place = parameter_place(scene_, p, document_);
      if (place.node == nullptr)
        missing = place.key;
      else
        found.push_back({const_cast<TomlNode*>(place.node), place.key});  // a node of document_, which is ours
    }
    for (TomlNode& contact : members("contact"))
      for (TomlNode& number : contact.children) {
        if (number.kind != TomlNode::Kind::integer && number.kind != TomlNode::Kind::floating) continue;
        const std::string name = contact.key + "." + number.key;
        known.push_back(name);
        if (matches(pattern, name) || matches(pattern, "contact." + name))
          found.push_back({&number, "contact." + name});
      }
    if (!found.empty()) return found;
    if (!missing.empty())
      refuse_option(out_, Code::missing_key, "--set", pattern,
                    "is not given in the file (" + missing + "): write the value that holds without it there");
    else if (!fixed.empty())
      refuse_option(out_, Code::not_applicable, "--set", pattern,
                    "cannot be set: it is no number of a table; change it in the steps or surfaces of the scene");
    else
      refuse_option(out_, Code::unknown_name, "--set", pattern,
                    "is no number of this scene" + did_you_mean(pattern, known) +
                        " (names as of genu sensitivity: AAC.stiffness, AAC.from.x, push.force.z)");
    return found;
  }

  TomlNode& document_;
  const Scene& scene_;
  Diagnostics& out_;
  AppliedChanges applied_;
};

void add_errors(const Diagnostics& from, Diagnostics& to) {
  for (const Diagnostic& d : from.items())
    if (d.severity == Diagnostic::Severity::error) to.add(d);
}

/// "Knee (without ACL*; MCL*.stiffness=x0.5)"
std::string changed_title(const std::string& title, const SceneChanges& changes) {
  std::string words;
  for (const std::string& name : changes.without) words += (words.empty() ? "without " : ", ") + name;
  for (const std::string& option : changes.set) words += (words.empty() ? "" : "; ") + option;
  return title + (title.empty() ? "" : " ") + "(" + words + ")";
}

}  // namespace

std::optional<Scene> read_changed_scene(const SceneSource& source, InputFiles& files, Diagnostics& out) {
  auto document = read_document(source.path, files, out);
  if (!document) return std::nullopt;
  if (source.changes.empty()) return scene_of(*document, source.path, out);
  Diagnostics before;  // warnings are those of the changed scene
  const auto as_written = scene_of(*document, source.path, before);
  if (!as_written) return add_errors(before, out), std::nullopt;
  Diagnostics refused;
  Changes changes(*document, *as_written, refused);
  for (const std::string& option : source.changes.set) changes.set(option);
  for (const std::string& pattern : source.changes.without) changes.leave_out(pattern);
  if (refused.has_errors()) return add_errors(refused, out), std::nullopt;
  auto scene = scene_of(*document, source.path, out);
  if (!scene) {
    out.error(Code::out_of_range, {}, "the scene is refused as --without and --set change it; the file itself is fine");
    return std::nullopt;
  }
  scene->changed = changes.take();
  scene->changed.asked = source.changes;
  scene->title = changed_title(scene->title, source.changes);
  return scene;
}

std::optional<Scene> read_changed_scene(const SceneSource& source, Diagnostics& out) {
  InputFiles files;
  return read_changed_scene(source, files, out);
}

void write_changes(const SceneTables& scene, TextPlaces& places, Diagnostics& out) {
  const auto& edits = scene.changed.edits;
  for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit) {  // the last change of a number holds
    if (!edit->below)
      places.value(edit->where, edit->text);
    else if (!places.line_below(edit->where, edit->text))
      out.add(error_at({scene.file, edit->where}, Code::wrong_form, edit->key, {},
                       "cannot be written: give the table a header of its own, [" +
                           edit->key.substr(0, edit->key.rfind('.')) + "]"));
  }
}

std::string with_changes(const std::string& text, const SceneTables& scene, Diagnostics& out) {
  TextPlaces places(text);
  write_changes(scene, places, out);
  return places.text();
}

}  // namespace genu
