#include <algorithm>

#include "genu/scene/read_parts.h"

namespace genu {

namespace {

/// True if the term was understood.
bool read_term(ReadContext& context, const Item& item, const std::string& name, CombinationDef& combination) {
  const auto coordinate = find_coordinate(context, item.node->key_where, item.path, name);
  const auto factor = read_number(context, item);
  if (!coordinate || !factor) return false;
  std::optional<Fault> fault;
  if (*factor == 0) fault = {Code::out_of_range, "must not be 0"};
  for (const CombinationDef::Term& other : combination.terms) {
    if (other.coordinate == *coordinate) fault = {Code::duplicate, "is named twice in this combination"};
    if ((other.coordinate.index < 3) != (coordinate->index < 3))
      fault = {Code::conflict, "is " + std::string(coordinate->index < 3 ? "an angle" : "a length") +
                                   ", but terms before it are not: a combination has one unit"};
  }
  if (fault) {
    refuse(context, item, fault->code, fault->text);
    return false;
  }
  combination.terms.push_back({*coordinate, *factor});
  return true;
}

bool read_terms(ReadContext& context, const Item& item, CombinationDef& combination) {
  if (!is_table(context, item)) return false;
  if (item.node->children.empty())
    refuse(context, item, Code::missing_key, "must name at least one coordinate and its factor");
  bool good = !item.node->children.empty();
  for (const NamedItem& term : coordinate_items(item))
    good = read_term(context, term.item, term.name, combination) && good;
  return good;
}

}  // namespace

void read_combinations(ReadContext& context, Section& root) {
  for (const Item& item : named_tables(context, root, "combination")) {
    Section section(context, item, "a combination");
    CombinationDef combination;
    combination.name = item.node->key;
    combination.where = item.node->key_where;
    context.combination_understood.push_back(read_terms(context, section.require("terms"), combination));
    section.finish();
    context.scene.combinations.push_back(combination);
  }
}

std::optional<QuantityRef> find_quantity(ReadContext& context, SourceLocation where, const std::string& path,
                                         const std::string& name) {
  const auto& all = context.scene.combinations;
  const auto found = std::find_if(all.begin(), all.end(), [&](const CombinationDef& c) { return c.name == name; });
  if (found == all.end()) {
    const auto coordinate = find_coordinate(context, where, path, name, {}, names_of(all));
    return coordinate ? std::optional<QuantityRef>(*coordinate) : std::nullopt;
  }
  const auto k = static_cast<std::size_t>(found - all.begin());
  if (!context.combination_understood[k]) return {};
  return QuantityRef(found->terms.front().coordinate, static_cast<int>(k));
}

}  // namespace genu
