#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <sstream>

#include "genu/scene/read_parts.h"
#include "genu/scene/tolerances.h"
#include "genu/scene/words.h"

namespace genu {

namespace {

struct Axis {
  const char* word;
  int index;
  double sign;
};
constexpr std::array<Axis, 6> kAxes = {
    {{"x", 0, 1}, {"y", 1, 1}, {"z", 2, 1}, {"-x", 0, -1}, {"-y", 1, -1}, {"-z", 2, -1}}};

/// "-z", or the three numbers of a direction "0.1 0 0.99".
std::optional<Vec3> direction_of(const std::vector<std::string>& words) {
  if (words.size() == 1) {
    const auto found = std::find_if(kAxes.begin(), kAxes.end(), [&](const Axis& a) { return words[0] == a.word; });
    return found == kAxes.end() ? std::nullopt : std::optional(Vec3(found->sign * Vec3::Unit(found->index)));
  }
  if (words.size() != 3) return std::nullopt;
  Vec3 direction;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const std::string& word = words[static_cast<std::size_t>(k)];
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), direction[k]);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  }
  if (!(direction.cwiseAbs().maxCoeff() <= kMaxNumber) || !(direction.norm() > kLeastDirection)) return std::nullopt;
  return direction.normalized();
}

/// "flexion -z"
std::optional<JointDef::Rotation> read_rotation(ReadContext& context, const Item& item) {
  const auto text = read_string(context, item);
  if (!text) return {};
  std::istringstream stream(*text);
  std::string name;
  stream >> name;
  const std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
  const auto axis = direction_of(words);
  if (!is_name(name) || !axis) {
    refuse(context, item, Code::wrong_form,
           "must be \"NAME AXIS\" with a name and one of x, y, z, -x, -y, -z, or \"NAME X Y Z\" with a direction");
    return {};
  }
  JointDef::Rotation rotation;
  rotation.name = name;
  rotation.axis = *axis;
  return rotation;
}

/// Directions are written with few digits: neighbours become exactly perpendicular.
void make_perpendicular(JointDef& joint) {
  Vec3 &first = joint.rotations[0].axis, &second = joint.rotations[1].axis, &third = joint.rotations[2].axis;
  if (first.dot(second) == 0 && second.dot(third) == 0) return;
  const Vec3 across = first.cross(third);
  if (across.norm() > kAxesApart) {
    second = (across.dot(second) < 0 ? -across : across).normalized();
  } else {
    second = (second - first * first.dot(second)).normalized();
    third = (third - second * second.dot(third)).normalized();
  }
}

bool read_rotations(ReadContext& context, const Item& item, JointDef& joint) {
  if (!is_array(context, item, "three rotations [\"NAME AXIS\", ...]", 3)) return false;
  bool good = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto rotation = read_rotation(context, item.element(k));
    good = good && rotation.has_value();
    if (rotation) joint.rotations[k] = *rotation;
  }
  for (std::size_t k = 1; good && k < 3; ++k) {
    const double cosine = std::abs(joint.rotations[k].axis.dot(joint.rotations[k - 1].axis));
    if (cosine <= kAxesAskew) continue;
    refuse(context, item.element(k), Code::conflict,
           cosine > 1 - kAxesAskew ? "turns about the same axis as the rotation before it: neighbours must differ"
                                   : "must be perpendicular to the rotation before it, to three digits");
    good = false;
  }
  if (good) make_perpendicular(joint);
  return good;
}

bool read_translations(ReadContext& context, const Item& item, JointDef& joint) {
  if (!is_array(context, item, "three names of translations along x, y and z", 3)) return false;
  bool good = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const Item element = item.element(k);
    const auto name = read_string(context, element);
    if (name && !is_name(*name))
      refuse(context, element, Code::wrong_form,
             "a name is a letter or _, then letters, digits, _ or -, 100 characters at most");
    good = good && name && is_name(*name);
    joint.translations[k] = name.value_or("");
  }
  return good;
}

std::vector<std::string> coordinate_names(const JointDef& joint) {
  std::vector<std::string> names;
  for (const auto& rotation : joint.rotations) names.push_back(rotation.name);
  for (const std::string& name : joint.translations) names.push_back(name);
  return names;
}

bool names_are_distinct(ReadContext& context, const Item& rotations, const Item& translations, const JointDef& joint) {
  const std::vector<std::string> names = coordinate_names(joint);
  bool good = true;
  for (std::size_t k = 1; k < names.size(); ++k) {
    const auto end = names.begin() + static_cast<std::ptrdiff_t>(k);
    if (std::find(names.begin(), end, names[k]) == end) continue;
    refuse(context, k < 3 ? rotations.element(k) : translations.element(k - 3), Code::duplicate,
           "another coordinate of this joint has the name " + with_quotes(names[k]));
    good = false;
  }
  return good;
}

void read_pose(ReadContext& context, const Item& item, const JointDef& joint, std::array<double, 6>& out) {
  if (!is_table(context, item)) return;
  const std::vector<std::string> names = coordinate_names(joint);
  for (const TomlNode& child : item.node->children) {
    const Item value = item.member(child);
    const auto found = std::find(names.begin(), names.end(), child.key);
    if (found == names.end()) {
      context.error(child.key_where, Code::unknown_name, value.path, literal(child),
                    unknown_name_rule("coordinate", child.key, names));
      continue;
    }
    const auto k = static_cast<std::size_t>(found - names.begin());
    const NumberRule rule = k < 3 ? angle_rule(context) : length_rule(context);
    out[k] = read_number(context, value, rule).value_or(0);
  }
}

/// True if all six coordinates were understood.
bool read_coordinates(ReadContext& context, Section& section, JointDef& joint) {
  const Item rotations = section.require("rotations");
  const Item translations = section.require("translations");
  const Item reference = section.find("reference"), start = section.find("start");
  const bool rotations_good = read_rotations(context, rotations, joint);
  const bool translations_good = read_translations(context, translations, joint);
  if (!rotations_good || !translations_good) return false;
  if (!names_are_distinct(context, rotations, translations, joint)) return false;
  read_pose(context, reference, joint, joint.reference);
  if (start) read_pose(context, start, joint, joint.start.emplace(joint.reference));
  return true;
}

void read_bodies_of(ReadContext& context, Section& section, JointDef& joint) {
  const Scene& scene = context.scene;
  const std::vector<std::string> names = names_of(scene.bodies);
  const Item parent = section.require("parent");
  const Item child = section.require("child");
  joint.parent = read_reference(context, parent, "body", names).value_or(-1);
  joint.child = read_reference(context, child, "body", names).value_or(-1);
  if (joint.child < 0) return;
  if (joint.child == joint.parent) {
    refuse(context, child, Code::conflict, "parent and child must be different bodies");
  } else if (scene.bodies[static_cast<std::size_t>(joint.child)].fixed) {
    refuse(context, child, Code::conflict, "is fixed: the child of a joint must be a moving body");
  }
  for (const JointDef& other : scene.joints) {
    if (other.child != joint.child) continue;
    refuse(context, child, Code::duplicate,
           "is already the child of joint." + other.name + ": a body has one joint to its parent");
    break;
  }
}

/// Why a joint of the scene has no coordinate `name`, which begins with the joint's name; empty for a free joint.
std::string held_rule(const JointDef& joint) {
  if (joint.type == JointDef::Type::fixed) return "joint." + joint.name + " is fixed: it holds all its coordinates";
  if (joint.type == JointDef::Type::revolute)
    return "joint." + joint.name + " is revolute: it holds all coordinates but " + with_quotes(joint.name + ".angle");
  return {};
}

std::vector<std::string> joint_words() {
  std::vector<std::string> words;
  for (const KindOf<JointDef>& kind : kJointKinds) words.emplace_back(kind.word);
  return words;
}

}  // namespace

void read_joints(ReadContext& context, Section& root) {
  for (const Item& item : named_tables(context, root, "joint")) {
    Section section(context, item, "a free joint");
    JointDef joint;
    joint.name = item.node->key;
    joint.where = item.node->key_where;
    read_bodies_of(context, section, joint);
    read_grood_suntay(context, section.find("grood_suntay"), joint);
    const auto type = read_choice(context, section.require("type"), joint_words());
    bool understood = false;
    if (!type) {
      for (const char* key : {"rotations", "translations", "reference", "start", "origin", "axis"}) section.find(key);
      for (const KindOf<JointDef>& kind : kJointKinds) know_numbers(section, kind);
    } else {
      joint.type = static_cast<JointDef::Type>(*type);
      understood = joint.type == JointDef::Type::free ? read_coordinates(context, section, joint)
                                                      : read_held_joint(context, section, joint);
    }
    section.finish();
    context.scene.joints.push_back(joint);
    context.joint_understood.push_back(understood);
  }
}

std::optional<CoordinateRef> find_coordinate(ReadContext& context, SourceLocation where, const std::string& path,
                                             const std::string& name, const std::string& found,
                                             const std::vector<std::string>& also_known) {
  const Scene& scene = context.scene;
  std::vector<std::string> known;
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    if (!context.joint_understood[j]) {
      if (name.rfind(scene.joints[j].name + ".", 0) == 0) return {};
      continue;
    }
    for (int k = 0; k < 6; ++k) {
      if (!scene.joints[j].leaves(k)) continue;
      const CoordinateRef c{static_cast<int>(j), k};
      known.push_back(coordinate_name(scene, c));
      if (known.back() == name) return c;
    }
  }
  for (const JointDef& joint : scene.joints) {
    const std::string rule = name.rfind(joint.name + ".", 0) == 0 ? held_rule(joint) : std::string();
    if (rule.empty()) continue;
    context.error(where, Code::conflict, path, found, rule);
    return {};
  }
  for (const CombinationDef& combination : scene.combinations) {
    if (combination.name != name) continue;
    context.error(where, Code::conflict, path, found, "is a combination: only a single coordinate can stand here");
    return {};
  }
  known.insert(known.end(), also_known.begin(), also_known.end());
  context.error(where, Code::unknown_name, path, found, unknown_name_rule("coordinate", name, known));
  return {};
}

}  // namespace genu
