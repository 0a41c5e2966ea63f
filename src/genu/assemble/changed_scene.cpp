#include "genu/assemble/changed_scene.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "genu/assemble/parameter_values.h"
#include "genu/assemble/refuse_option.h"
#include "genu/assemble/text_places.h"
#include "genu/core/counted.h"
#include "genu/scene/leave_out_bodies.h"
#include "genu/scene/reader.h"

namespace genu {
namespace {

constexpr std::array kGroups = {"ligament", "bushing", "contact", "load", "body"};

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
        if (!means(pattern, group, table.key)) continue;
        disable(group, table);
        ++count;
      }
      if (count > 0) found += (found.empty() ? "" : ", ") + counted(count, group);
    }
    if (found.empty())
      refuse_option(
          out_, Code::unknown_name, "--without", pattern,
          "is no ligament, bundle, bushing, contact, load or body of this scene" + did_you_mean(pattern, known));
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
    const Named named = named_by(pattern);
    double before = 0, after = 0;
    for (const Place& place : named.places) {
      before = place.node->number;
      after = value->of(before);
      put(*place.node, after);
      applied_.edits.push_back({place.node->where, place.key, fmt::format("{}", after)});
    }
    if (named.places.empty()) return;
    std::string words = fmt::format("{} {:g} -> {:g}", named.places[0].name, before, after);
    if (named.places.size() > 1)
      words = fmt::format("{} ({} of {})", option, counted(named.places.size(), "number"), objects_of(named.places));
    else if (named.places[0].name != pattern)
      words = fmt::format("{} ({})", option, words);
    applied_.words.push_back(words + some_of("; not given in the file, and left: ", named.missing) +
                             some_of("; not to be set: ", named.fixed));
  }

  AppliedChanges take() { return std::move(applied_); }

 private:
  struct Place {
    TomlNode* node;
    std::string key;   ///< "ligament.AAC.stiffness"
    std::string name;  ///< "AAC.stiffness"
  };

  /// What a pattern names.
  struct Named {
    std::vector<Place> places;
    std::vector<std::string> missing, fixed;  ///< names of numbers that the file does not give, or that have no key
  };

  /// "2 ligaments, 1 load"
  static std::string objects_of(const std::vector<Place>& places) {
    std::map<std::string, std::set<std::string>> objects;
    for (const Place& place : places) {
      const std::size_t group = place.key.find('.');
      objects[place.key.substr(0, group)].insert(
          place.key.substr(group + 1, place.key.find('.', group + 1) - group - 1));
    }
    std::string text;
    for (const auto& [group, names] : objects) text += (text.empty() ? "" : ", ") + counted(names.size(), group);
    return text;
  }

  /// "; left: a, b, c and 4 more"; empty for none.
  static std::string some_of(const char* what, const std::vector<std::string>& names) {
    constexpr std::size_t kShown = 3;
    std::string text;
    for (std::size_t k = 0; k < std::min(kShown, names.size()); ++k) text += (k == 0 ? what : ", ") + names[k];
    return names.size() > kShown ? text + fmt::format(" and {} more", names.size() - kShown) : text;
  }

  std::vector<TomlNode> none_;

  std::vector<TomlNode>& members(const char* group) {
    for (TomlNode& child : document_.children)
      if (child.key == group) return child.children;
    return none_;
  }

  bool means(const std::string& pattern, const std::string& group, const std::string& name) const {
    if (group == "body") return means_body(pattern, name);
    return matches(scene_, pattern, name) || matches(scene_, pattern, group + "." + name);
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

  /// Whether a pattern names a number by its name, or with the kind of table in front.
  bool names(const std::string& pattern, const char* group, const std::string& name) const {
    return matches(scene_, pattern, name) || matches(scene_, pattern, std::string(group) + "." + name);
  }

  void find_parameters(const std::string& pattern, Named& named, std::vector<std::string>& known) {
    for (const Parameter& p : parameters_of(scene_)) {
      known.push_back(p.name);
      if (!names(pattern, p.group(), p.name)) continue;
      Scene& numbers = const_cast<Scene&>(scene_);  // looked up, not written
      if (parameter_number(numbers, p) == nullptr && p.kind != Parameter::Kind::term &&
          p.kind != Parameter::Kind::surface_number) {
        named.fixed.push_back(p.name);
        continue;
      }
      const ParameterPlace place = parameter_place(scene_, p, document_);
      if (place.node == nullptr)
        named.missing.push_back(place.key);
      else  // a node of document_, which is ours
        named.places.push_back({const_cast<TomlNode*>(place.node), place.key, p.name});
    }
  }

  void find_numbers_of_contacts(const std::string& pattern, Named& named, std::vector<std::string>& known) {
    for (TomlNode& contact : members("contact"))
      for (TomlNode& number : contact.children) {
        if (number.kind != TomlNode::Kind::integer && number.kind != TomlNode::Kind::floating) continue;
        const std::string name = contact.key + "." + number.key;
        known.push_back(name);
        if (names(pattern, "contact", name)) named.places.push_back({&number, "contact." + name, name});
      }
  }

  void find_points_of_cables(const std::string& pattern, Named& named) const {
    for (const LoadDef& load : scene_.loads)
      for (std::size_t k = 0; k < load.points.size(); ++k)
        for (const char* axis : {"x", "y", "z"}) {
          const std::string end = k == 0 ? "from" : k + 1 == load.points.size() ? "to" : fmt::format("via.{}", k);
          const std::string name = load.name + "." + end + "." + axis;
          if (names(pattern, "load", name)) named.fixed.push_back(name);
        }
  }

  /// The numbers that a pattern names: those of parameters as the file gives them, and those of contacts. Without any
  /// the reason is in `out_`.
  Named named_by(const std::string& pattern) {
    Named named;
    std::vector<std::string> known;
    find_parameters(pattern, named, known);
    find_numbers_of_contacts(pattern, named, known);
    find_points_of_cables(pattern, named);
    if (!named.places.empty()) return named;
    if (!named.missing.empty())
      refuse_option(
          out_, Code::missing_key, "--set", pattern,
          "is not given in the file (" + named.missing.back() + "): write the value that holds without it there");
    else if (!named.fixed.empty())
      refuse_option(out_, Code::not_applicable, "--set", pattern,
                    "cannot be set (" + named.fixed.front() +
                        "): change it in the steps, surfaces or cables of the scene's file");
    else
      refuse_option(out_, Code::unknown_name, "--set", pattern,
                    "is no number of this scene" + did_you_mean(pattern, known) +
                        " (names as of genu sensitivity: AAC.stiffness, AAC.from.x, push.force.z)");
    return named;
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

}  // namespace

std::string words_of(const SceneChanges& changes) {
  std::string words;
  for (const std::string& name : changes.without) words += (words.empty() ? "without " : ", ") + name;
  for (const std::string& option : changes.set) words += (words.empty() ? "" : "; ") + option;
  return words;
}

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
  scene->title += (scene->title.empty() ? "(" : " (") + words_of(source.changes) + ")";
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
