#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "genu/law/laws.h"
#include "genu/scene/read_parts.h"

namespace genu {

namespace {

using Rest = LigamentDef::Rest;

void read_ends(ReadContext& context, Section& section, LigamentDef& ligament) {
  ReadPath path = read_path(context, section, "a ligament");
  ligament.from = path.points.front();
  ligament.to = path.points.back();
  ligament.via.assign(path.points.begin() + 1, path.points.end() - 1);
  ligament.wraps = std::move(path.wraps);
}

void read_force_table(ReadContext& context, const Item& item, LigamentDef& ligament) {
  if (!is_array(context, item, "points [[strain, N], ...]")) return;
  if (item.node->children.size() < 2) refuse(context, item, Code::missing_key, "needs at least two points [strain, N]");
  const NumberRule strain{.unit = 1, .unit_name = {}, .above = -1, .at_least = {}};
  const NumberRule force = non_negative({.unit = 1, .unit_name = "N", .above = {}, .at_least = {}});
  for (std::size_t k = 0; k < item.node->children.size(); ++k) {
    const Item point = item.element(k);
    if (!is_array(context, point, "a point [strain, N]", 2)) continue;
    const auto e = read_number(context, point.element(0), strain);
    const auto f = read_number(context, point.element(1), force);
    if (!e || !f) continue;
    if (!ligament.points.empty() && *e <= ligament.points.back().first) {
      refuse(context, point.element(0), Code::out_of_range, "strains must increase from point to point");
    }
    ligament.points.emplace_back(*e, *f);
  }
}

/// Null where the law is absent or unknown.
const LawKind* read_law(ReadContext& context, Section& section, LigamentDef& ligament) {
  std::vector<std::string> words;
  for (const auto& law : kLaws) words.push_back(law().name);
  const auto k = read_choice(context, section.require("law"), words);
  if (!k) {
    // Without a law no key of any law can be called wrong.
    for (const std::string& key : law_keys()) section.find(key.c_str());
    section.find("points");
    return nullptr;
  }
  const LawKind& law = kLaws[static_cast<std::size_t>(*k)]();
  ligament.law = law.name;
  section.rename(law.what);
  if (law.points) read_force_table(context, section.require("points"), ligament);
  for (const NumberRow& number : law.numbers) {
    ligament.numbers.push_back({number.key, 1});
    read_number_row(context, section, number, {.objects = "ligaments"}, &ligament.numbers.back().value);
  }
  return &law;
}

NumberRule rest_rule(const ReadContext& context, const LigamentDef& ligament, const LawKind* law) {
  const bool both_ways = law == nullptr || law->both_ways;
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
  if (ligament.points.empty()) return;
  const auto by_force = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto [least, most] = std::minmax_element(ligament.points.begin(), ligament.points.end(), by_force);
  if (ligament.rest_value >= least->second && ligament.rest_value <= most->second) return;
  refuse(context, item, Code::out_of_range,
         fmt::format("must be a force of the table, from {:g} to {:g} N", least->second, most->second));
}

void read_rest(ReadContext& context, Section& section, LigamentDef& ligament, const LawKind* law) {
  constexpr std::array<std::pair<const char*, Rest>, 3> kForms = {{{"slack_length", Rest::slack_length},
                                                                   {"reference_strain", Rest::reference_strain},
                                                                   {"reference_force", Rest::reference_force}}};
  Item first;
  for (const auto& [key, rest] : kForms) {
    const Item item = section.find(key);
    if (!item) continue;
    if (first) {
      refuse(context, item, Code::conflict,
             "only one of slack_length, reference_strain and reference_force may be given");
      continue;
    }
    first = item;
    ligament.rest = rest;
    ligament.rest_where = item.node->where;
    const auto value = read_number(context, item, rest_rule(context, ligament, law));
    ligament.rest_value = value.value_or(1);
    if (value && ligament.rest == Rest::reference_force && law != nullptr && law->points) {
      check_table_reaches(context, item, ligament);
    }
  }
  if (!first)
    section.error(Code::missing_key, "slack_length",
                  "is missing: give one of slack_length, reference_strain, reference_force");
}

}  // namespace

void read_ligaments(ReadContext& context, Section& root) {
  for (const Item& item : named_tables(context, root, "ligament")) {
    Section section(context, item, "a ligament");
    LigamentDef ligament;
    ligament.name = item.node->key;
    ligament.where = item.node->key_where;
    read_ends(context, section, ligament);
    const LawKind* law = read_law(context, section, ligament);
    read_rest(context, section, ligament, law);
    read_number_row(context, section, kLigamentDamping, {.objects = "ligaments"}, &ligament.damping);
    warn_unlikely(context, section, ligament);
    const bool enabled = read_enabled(context, section, "ligament");
    section.finish();
    context.ligaments.push_back(ligament.name);
    if (enabled) context.scene.ligaments.push_back(ligament);
  }
}

}  // namespace genu
