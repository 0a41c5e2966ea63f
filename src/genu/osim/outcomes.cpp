#include "genu/osim/outcomes.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "genu/core/file_text.h"
namespace genu::osim {
namespace {

/// Elements that have no place in a scene, and what they do in OpenSim.
struct KnownKind {
  std::string_view type;  ///< "*Probe": every type that ends so
  const char* reason;
  bool is(std::string_view other) const {
    return type.starts_with('*') ? other.ends_with(type.substr(1)) : other == type;
  }
};
constexpr std::array kKnownKinds = {
    KnownKind{"Marker", "marks a point for inverse kinematics; a scene has none"},
    KnownKind{"Mesh", "shown, without effect on any force"},
    KnownKind{"Sphere", "shown, without effect on any force"},
    KnownKind{"Cylinder", "shown, without effect on any force"},
    KnownKind{"Ellipsoid", "shown, without effect on any force"},
    KnownKind{"Brick", "shown, without effect on any force"},
    KnownKind{"ObjectGroup", "names a group; ligaments whose names differ in a number are one group in results"},
    KnownKind{"HuntCrossleyForce", "WARNING: contact that genu does not import; it would press the bodies apart"},
    KnownKind{"ElasticFoundationForce", "WARNING: contact that genu does not import; it would press the bodies apart"},
    KnownKind{"SmoothSphereHalfSpaceForce",
              "WARNING: contact that genu does not import; it would press the bodies apart"},
    KnownKind{"ContactMesh", "a shape of a contact force that genu does not import"},
    KnownKind{"ContactSphere", "a shape of a contact force that genu does not import"},
    KnownKind{"ContactHalfSpace", "a shape of a contact force that genu does not import"},
    KnownKind{"CoordinateLimitForce", "WARNING: would push a coordinate back beyond its limits"},
    KnownKind{"CoordinateActuator", "would drive a coordinate by a control; a load `on` the coordinate does that"},
    KnownKind{"TorqueActuator", "would drive bodies by a control"},
    KnownKind{"PointActuator", "would drive a body by a control"},
    KnownKind{"*Controller", "would excite muscles and actuators; the tension of a cable is its `magnitude`"},
    KnownKind{"*Probe", "reports, without effect on any force"},
    KnownKind{"BushingForce", "WARNING: would hold two frames together by springs"},
    KnownKind{"ExpressionBasedBushingForce", "WARNING: would hold two frames together by springs"},
    KnownKind{"Ligament",
              "WARNING: would pull by a curve of force over length; a ligament with law = \"table\" does that"},
    KnownKind{"CoordinateCouplerConstraint",
              "WARNING: would make one coordinate follow another; a [combination] does that"},
    KnownKind{"PointConstraint", "WARNING: would hold two points together"},
    KnownKind{"WeldConstraint", "WARNING: would hold two frames together"},
};

std::string whole_reason(const Outcome& o) {
  return o.reason + (o.reason.empty() || o.detail.empty() ? "" : ": ") + o.detail;
}

struct Group {
  std::string type;
  const Outcome* outcome;
  std::vector<std::string> names;
};

}  // namespace

const char* word_of(Fate fate) { return fate == Fate::kept ? "kept" : fate == Fate::frozen ? "frozen" : "left out"; }

void settle_the_rest(const std::vector<Item>& items, Outcomes& outcomes) {
  for (const Item& item : items) {
    if (outcomes.has(item.where)) continue;
    const auto known =
        std::find_if(kKnownKinds.begin(), kKnownKinds.end(), [&](const KnownKind& k) { return k.is(item.type); });
    outcomes.left_out(item.where,
                      known == kKnownKinds.end() ? "WARNING: genu does not know this kind of element" : known->reason);
  }
}

std::string outcome_table(const std::vector<Item>& items, const Outcomes& outcomes) {
  std::string text = "line,set,type,name,fate,in_scene,reason\n";
  for (const Item& item : items) {
    const Outcome& o = outcomes.of(item.where);
    text += fmt::format("{},{},{},{},{},{},{}\n", item.where.line, csv_word(item.set), csv_word(item.type),
                        csv_word(item.name), word_of(o.fate), csv_word(o.in_scene), csv_word(whole_reason(o)));
  }
  return text;
}

std::vector<std::string> outcome_summary(const std::vector<Item>& items, const Outcomes& outcomes) {
  std::vector<Group> groups;
  for (const Item& item : items) {
    const Outcome& o = outcomes.of(item.where);
    auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
      return g.type == item.type && g.outcome->fate == o.fate && g.outcome->reason == o.reason;
    });
    if (group == groups.end()) group = groups.insert(groups.end(), Group{item.type, &o, {}});
    group->names.push_back(item.name.empty() ? fmt::format("line {}", item.where.line) : item.name);
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const Group& a, const Group& b) { return a.outcome->fate < b.outcome->fate; });
  constexpr std::size_t kNamed = 5;
  std::vector<std::string> lines;
  for (const Group& g : groups) {
    std::string names;
    for (std::size_t k = 0; k < std::min(kNamed, g.names.size()); ++k) names += (k > 0 ? ", " : "") + g.names[k];
    if (g.names.size() > kNamed) names += ", ...";
    const std::string why = g.outcome->reason.empty() ? "" : ": " + g.outcome->reason;
    lines.push_back(fmt::format("{:<8} {:>4} {} ({}){}", word_of(g.outcome->fate), g.names.size(), g.type, names, why));
  }
  for (const Item& item : items)  // of one element alone, which its group does not say
    if (const Outcome& o = outcomes.of(item.where); o.detail.find("WARNING") != std::string::npos)
      lines.push_back(fmt::format("{:<8}      {} {}: {}", word_of(o.fate), item.type, item.name, o.detail));
  return lines;
}

}  // namespace genu::osim
