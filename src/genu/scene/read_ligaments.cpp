#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "genu/scene/read_parts.h"

namespace genu {

namespace {

using Law = LigamentDef::Law;
using Rest = LigamentDef::Rest;

LigamentDef::End read_point(ReadContext& context, const Item& item, const char* what = "the end of a ligament") {
  LigamentDef::End end;
  if (!is_table(context, item)) return end;
  Section section(context, item, what);
  end.body = read_reference(context, section.require("body"), "body", names_of(context.scene.bodies)).value_or(-1);
  end.point = read_vector(context, section.require("point"), length_rule(context)).value_or(Vec3::Zero());
  section.finish();
  return end;
}

void read_via(ReadContext& context, const Item& item, LigamentDef& ligament) {
  if (!item || !is_array(context, item, "via points [{ body, point }, ...]")) return;
  for (std::size_t k = 0; k < item.node->children.size(); ++k)
    ligament.via.push_back(read_point(context, item.element(k), "a via point"));
}

void read_ends(ReadContext& context, Section& section, LigamentDef& ligament) {
  ligament.from = read_point(context, section.require("from"));
  ligament.to = read_point(context, section.require("to"));
  read_via(context, section.find("via"), ligament);
  std::vector<int> bodies{ligament.from.body, ligament.to.body};
  for (const LigamentDef::End& via : ligament.via) bodies.push_back(via.body);
  const auto all = [&](const auto& holds) { return std::all_of(bodies.begin(), bodies.end(), holds); };
  if (!all([](int body) { return body >= 0; })) return;
  const std::string which = ligament.via.empty() ? "both ends" : "all its points";
  const Item body_of_to = section.find("to").member(*section.find("to").node->member("body"));
  if (all([&](int body) { return body == bodies[0]; })) {
    refuse(context, body_of_to, which + " are on the same body");
  } else if (all([&](int body) { return context.scene.bodies[static_cast<std::size_t>(body)].fixed; })) {
    refuse(context, body_of_to, which + " are on fixed bodies");
  }
}

/// What `stiffness` is measured in, for each law.
NumberRule stiffness_rule(const ReadContext& context, Law law) {
  const bool per_length = law == Law::spring || law == Law::abdel_rahman;
  if (!per_length) return positive({.unit = 1, .unit_name = "N", .above = {}, .at_least = {}});
  return positive(
      {.unit = 1 / context.scene.length_unit, .unit_name = "N/" + context.length_name, .above = {}, .at_least = {}});
}

void read_force_table(ReadContext& context, const Item& item, LigamentDef& ligament) {
  if (!is_array(context, item, "points [[strain, N], ...]")) return;
  if (item.node->children.size() < 2) refuse(context, item, "needs at least two points [strain, N]");
  const NumberRule strain{.unit = 1, .unit_name = {}, .above = -1, .at_least = {}};
  const NumberRule force = non_negative({.unit = 1, .unit_name = "N", .above = {}, .at_least = {}});
  for (std::size_t k = 0; k < item.node->children.size(); ++k) {
    const Item point = item.element(k);
    if (!is_array(context, point, "a point [strain, N]", 2)) continue;
    const auto e = read_number(context, point.element(0), strain);
    const auto f = read_number(context, point.element(1), force);
    if (!e || !f) continue;
    if (!ligament.table.empty() && *e <= ligament.table.back().first) {
      refuse(context, point.element(0), "strains must increase from point to point");
    }
    ligament.table.emplace_back(*e, *f);
  }
}

void read_law_keys(ReadContext& context, Section& section, LigamentDef& ligament) {
  const Law law = ligament.law;
  if (law == Law::table) {
    read_force_table(context, section.require("points"), ligament);
    return;
  }
  ligament.stiffness = read_number(context, section.require("stiffness"), stiffness_rule(context, law)).value_or(1);
  if (law == Law::blankevoort || law == Law::abdel_rahman) {
    ligament.transition_strain = read_number(context, section.require("transition_strain"), positive({})).value_or(1);
  }
  if (law == Law::abdel_rahman) {
    const double unit = 1 / (context.scene.length_unit * context.scene.length_unit);
    const NumberRule rule{.unit = unit, .unit_name = "N/" + context.length_name + "^2", .above = 0, .at_least = {}};
    ligament.toe_stiffness = read_number(context, section.require("toe_stiffness"), rule).value_or(1);
  }
}

struct LawName {
  const char* word;
  const char* what;
  Law law;
};
constexpr std::array<LawName, 6> kLaws = {{
    {"quadratic", "a quadratic ligament", Law::quadratic},
    {"linear", "a linear ligament", Law::linear},
    {"blankevoort", "a blankevoort ligament", Law::blankevoort},
    {"spring", "a spring", Law::spring},
    {"table", "a table ligament", Law::table},
    {"abdel-rahman", "an abdel-rahman ligament", Law::abdel_rahman},
}};

/// False where the law is absent or unknown.
bool read_law(ReadContext& context, Section& section, LigamentDef& ligament) {
  std::vector<std::string> words;
  for (const LawName& law : kLaws) words.emplace_back(law.word);
  const auto k = read_choice(context, section.require("law"), words);
  if (!k) {
    // Without a law no key of any law can be called wrong.
    for (const char* key : {"stiffness", "transition_strain", "toe_stiffness", "points"}) section.find(key);
    return false;
  }
  ligament.law = kLaws[static_cast<std::size_t>(*k)].law;
  section.rename(kLaws[static_cast<std::size_t>(*k)].what);
  read_law_keys(context, section, ligament);
  return true;
}

NumberRule rest_rule(const ReadContext& context, const LigamentDef& ligament, bool law_known) {
  const bool both_ways = ligament.law == Law::spring || !law_known;
  switch (ligament.rest) {
    case Rest::slack_length:
      return both_ways ? non_negative(length_rule(context)) : positive(length_rule(context));
    case Rest::reference_strain:
      return {.unit = 1, .unit_name = {}, .above = -1, .at_least = {}};
    case Rest::reference_force:
      break;
  }
  const NumberRule force{.unit = 1, .unit_name = "N", .above = {}, .at_least = {}};
  return both_ways ? force : non_negative(force);
}

void check_table_reaches(ReadContext& context, const Item& item, const LigamentDef& ligament) {
  if (ligament.table.empty()) return;
  const auto by_force = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto [least, most] = std::minmax_element(ligament.table.begin(), ligament.table.end(), by_force);
  if (ligament.rest_value >= least->second && ligament.rest_value <= most->second) return;
  refuse(context, item, fmt::format("must be a force of the table, from {:g} to {:g} N", least->second, most->second));
}

void read_rest(ReadContext& context, Section& section, LigamentDef& ligament, bool law_known) {
  constexpr std::array<std::pair<const char*, Rest>, 3> kForms = {{{"slack_length", Rest::slack_length},
                                                                   {"reference_strain", Rest::reference_strain},
                                                                   {"reference_force", Rest::reference_force}}};
  Item first;
  for (const auto& [key, rest] : kForms) {
    const Item item = section.find(key);
    if (!item) continue;
    if (first) {
      refuse(context, item, "only one of slack_length, reference_strain and reference_force may be given");
      continue;
    }
    first = item;
    ligament.rest = rest;
    const auto value = read_number(context, item, rest_rule(context, ligament, law_known));
    ligament.rest_value = value.value_or(1);
    if (value && ligament.rest == Rest::reference_force && ligament.law == Law::table) {
      check_table_reaches(context, item, ligament);
    }
  }
  if (!first) section.error("slack_length", "is missing: give one of slack_length, reference_strain, reference_force");
}

}  // namespace

void read_ligaments(ReadContext& context, Section& root) {
  for (const Item& item : named_tables(context, root, "ligament")) {
    Section section(context, item, "a ligament");
    LigamentDef ligament;
    ligament.name = item.node->key;
    ligament.where = item.node->key_where;
    read_ends(context, section, ligament);
    const bool law_known = read_law(context, section, ligament);
    read_rest(context, section, ligament, law_known);
    section.not_built({"wrap"}, "ligaments that wrap");
    ligament.damping =
        read_damping(context, section, "ligaments", 1 / context.scene.length_unit, "N s/" + context.length_name);
    section.finish();
    context.scene.ligaments.push_back(ligament);
  }
}

}  // namespace genu
