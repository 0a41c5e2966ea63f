#include "genu/store/opensim_columns.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "genu/assemble/opensim_names.h"
#include "genu/assemble/plain_text.h"
#include "genu/assemble/refuse_option.h"

namespace genu {
namespace {

/// Rotations that published models cut short.
const std::map<std::string, std::string> kCutShort = {{"flexion", "flex"}, {"adduction", "add"}, {"rotation", "rot"}};

bool ends_with_side(const std::string& joint) { return joint.ends_with("_r") || joint.ends_with("_l"); }

std::string side_of(const JointDef& joint, const std::string& side) {
  if (ends_with_side(joint.name)) return joint.name.substr(joint.name.size() - 2);
  if (!side.empty()) return "_" + side;
  if (joint.grood_suntay) return joint.grood_suntay->right ? "_r" : "_l";
  return {};
}

std::string habitual_name(const SceneTables& scene, const CoordinateRef& c, const std::string& side) {
  const JointDef& joint = scene.joints[at(c.joint)];
  const std::string stem = ends_with_side(joint.name) ? joint.name.substr(0, joint.name.size() - 2) : joint.name;
  const auto with = [&](const std::string& word) { return stem + "_" + word + side_of(joint, side); };
  if (c.index >= 3) {
    const std::string& name = joint.translations[at(c.index - 3)];
    return with(name.size() == 1 ? "t" + name : name);
  }
  const std::string& name = joint.rotations[at(c.index)].name;
  const auto cut = kCutShort.find(lower_case(name));
  if (cut == kCutShort.end()) return with(name);
  // The whole word, if the short one is ambiguous.
  const std::string brief = with(cut->second);
  return opensim_coordinates(scene, brief) == std::vector<CoordinateRef>{c} ? brief : with(name);
}

bool can_be_name(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) { return c > ' ' && c < 127; });
}

class OpenSimNamer {
 public:
  OpenSimNamer(const SceneTables& scene, Diagnostics& out) : scene_(scene), out_(out) {
    for (int j = 0; j < static_cast<int>(scene.joints.size()); ++j)
      for (int i = 0; i < 6; ++i)
        if (scene.joints[at(j)].leaves(i)) wanted_.push_back({j, i});
  }

  std::optional<OpenSimNames> names(const OpenSimNameOptions& options) {
    const std::size_t before = out_.count(Diagnostic::Severity::error);
    if (!options.side.empty() && options.side != "r" && options.side != "l")
      refuse_option(out_, Code::unknown_name, "--side", options.side, "must be r or l");
    read(options.columns);
    OpenSimNames found;
    for (const CoordinateRef& c : wanted_) {
      const auto own = own_.find(coordinate_name(scene_, c));
      found.emplace_back(c, own != own_.end() ? own->second : habitual_name(scene_, c, options.side));
    }
    refuse_alike(found);
    if (out_.count(Diagnostic::Severity::error) > before) return std::nullopt;
    return found;
  }

 private:
  void read(std::string_view text) {
    while (!trimmed(text).empty()) {
      const std::size_t comma = std::min(text.find(','), text.size());
      read_one(std::string(trimmed(text.substr(0, comma))));
      text.remove_prefix(std::min(comma + 1, text.size()));
    }
  }

  void read_one(const std::string& part) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos)
      return refuse_option(out_, Code::wrong_form, "--columns", part,
                           "must be COORDINATE=NAME, such as knee.flexion=knee_angle_r");
    const std::string quantity(trimmed(part.substr(0, equals))), name(trimmed(part.substr(equals + 1)));
    std::vector<std::string> known;
    for (const CoordinateRef& c : wanted_) known.push_back(coordinate_name(scene_, c));
    if (std::find(known.begin(), known.end(), quantity) == known.end())
      return refuse_option(
          out_, Code::unknown_name, "--columns", quantity,
          "is no coordinate of the scene" + did_you_mean(quantity, known) + " (known: " + quoted_list(known) + ")");
    if (!can_be_name(name))
      return refuse_option(out_, Code::wrong_form, "--columns", part,
                           "must name the coordinate in OpenSim, without blanks");
    if (!own_.emplace(quantity, name).second)
      refuse_option(out_, Code::duplicate, "--columns", quantity, "is given twice");
  }

  void refuse_alike(const OpenSimNames& found) {
    std::map<std::string, CoordinateRef> taken;
    for (const auto& [c, name] : found) {
      const auto [other, fresh] = taken.emplace(lower_case(name), c);
      if (!fresh || lower_case(name) == "time")
        refuse_option(out_, Code::duplicate, "--columns", name,
                      fresh ? "is what the column of times is called"
                            : fmt::format("would be the name of both {} and {}: give \"{}=...\"",
                                          coordinate_name(scene_, other->second), coordinate_name(scene_, c),
                                          coordinate_name(scene_, c)));
    }
  }

  const SceneTables& scene_;
  Diagnostics& out_;
  std::vector<CoordinateRef> wanted_;
  std::map<std::string, std::string> own_;
};

}  // namespace

std::optional<OpenSimNames> opensim_column_names(const SceneTables& scene, const OpenSimNameOptions& options,
                                                 Diagnostics& out) {
  return OpenSimNamer(scene, out).names(options);
}

}  // namespace genu
