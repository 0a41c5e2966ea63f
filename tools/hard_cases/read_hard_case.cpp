#include <algorithm>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/scene/read_context.h"
#include "genu/scene/section.h"
#include "hard_cases/hard_case.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExpectEnding = ".expect.toml";
constexpr int kMostExitCode = 4;

/// An array of tables; absent: none.
std::vector<Item> tables_of(ReadContext& context, const Item& item) {
  std::vector<Item> out;
  if (!item || !is_array(context, item, "tables")) return out;
  for (std::size_t k = 0; k < item.node->children.size(); ++k)
    if (const Item element = item.element(k); is_table(context, element)) out.push_back(element);
  return out;
}

std::vector<std::string> strings_of(ReadContext& context, const Item& item) {
  std::vector<std::string> out;
  if (!item || !is_array(context, item, "strings")) return out;
  for (std::size_t k = 0; k < item.node->children.size(); ++k)
    if (const auto text = read_string(context, item.element(k))) out.push_back(*text);
  return out;
}

/// { name = count, ... }
std::vector<std::pair<std::string, int>> counts_of(ReadContext& context, const Item& item) {
  constexpr int kMost = 1'000'000;
  std::vector<std::pair<std::string, int>> out;
  if (!item || !is_table(context, item)) return out;
  for (const TomlNode& child : item.node->children)
    if (const auto count = read_integer(context, item.member(child), 0, kMost))
      out.emplace_back(child.key, static_cast<int>(*count));
  return out;
}

/// A number, or a formula as a string.
void read_formula(ReadContext& context, const Item& item, std::string& out) {
  if (item && is_number(*item.node))
    out = fmt::format("({:.17g})", item.node->number);
  else if (const auto text = read_string(context, item))
    out = *text;
}

void read_value(ReadContext& context, const Item& item, Expectation& out) {
  Section section(context, item, "a value");
  ExpectedValue v;
  const std::vector<std::string> tables = {"results", "events", "starts"};
  if (const auto k = read_choice(context, section.find("table"), tables))
    v.table = static_cast<ExpectedValue::Table>(*k);
  if (const auto event = read_string(context, section.find("event"))) {
    v.event = *event;
    v.table = ExpectedValue::Table::events;
    v.row = 1;
  }
  v.column = read_string(context, section.require("column")).value_or("");
  constexpr int kMost = 1'000'000;
  if (const auto row = read_integer(context, section.find("row"), -kMost, kMost)) v.row = static_cast<int>(*row);
  if (v.row == 0) section.error(Code::out_of_range, "row", "rows count from 1, from the end -1");
  v.is_word = section.has("word");
  if (v.is_word) {
    v.value = read_string(context, section.find("word")).value_or("");
  } else {
    read_formula(context, section.require("is"), v.value);
    NumberRule rule = non_negative(plain_rule(""));
    v.tolerance = read_number(context, section.require("tolerance"), rule).value_or(0);
  }
  section.finish();
  out.values.push_back(v);
}

void read_damage(ReadContext& context, const Item& item, MeshRecipe& out) {
  if (!is_table(context, item)) return;
  Section section(context, item, "a damage");
  MeshRecipe::Damage d;
  const Item kind = section.require("kind");
  if (const auto name = read_string(context, kind)) {
    const auto known = mesh_damage_named(*name);
    if (known)
      d.kind = *known;
    else
      refuse(context, kind, Code::unknown_name, "is no damage that is known");
  }
  const NumberRule length = {
      .unit = units::kMillimetre, .unit_name = "mm", .above = {}, .at_least = {}, .largest = 1e9};
  const bool plain = d.kind == MeshDamage::scale || d.kind == MeshDamage::subdivide;
  if (const auto size = read_number(context, section.find("size"), plain ? plain_rule("") : length)) d.size = *size;
  if (const auto near = read_vector(context, section.find("near"), length)) d.near = *near;
  if (const auto shift = read_vector(context, section.find("shift"), length)) d.shift = *shift;
  section.finish();
  out.damage.push_back(d);
}

void read_recipe(ReadContext& context, const Item& item, Expectation& out) {
  Section section(context, item, "a mesh");
  MeshRecipe recipe;
  recipe.file = read_string(context, section.require("file")).value_or("");
  if (recipe.file.empty() || recipe.file.find('/') != std::string::npos)
    section.error(Code::wrong_form, "file", "is a name, in no folder");
  recipe.text = read_string(context, section.find("text")).value_or("");
  if (recipe.text.empty()) {
    recipe.shape = read_string(context, section.require("shape")).value_or("");
    const NumberRule edge = positive({.unit = units::kMillimetre, .unit_name = "mm", .above = {}, .at_least = {}});
    recipe.edge = read_number(context, section.require("edge"), edge).value_or(1e-3);
  }
  if (const auto k = read_choice(context, section.find("units"), {"mm", "m"})) recipe.unit = *k == 0 ? 1e-3 : 1;
  const Item damage = section.find("damage");
  if (damage && is_array(context, damage, "tables"))
    for (std::size_t k = 0; k < damage.node->children.size(); ++k) read_damage(context, damage.element(k), recipe);
  section.finish();
  out.meshes.push_back(recipe);
}

void read_safeguard(ReadContext& context, Section& root, Expectation& out) {
  out.cannot_switch = read_string(context, root.find("cannot_switch")).value_or("");
  const Item item = root.find("safeguard");
  if (const auto name = read_string(context, item)) {
    out.safeguard = *name;
    std::error_code failed;
    const fs::path patch = (context.folder / ".." / "mutants" / (*name + ".patch")).lexically_normal();
    if (!fs::is_regular_file(patch, failed))
      refuse(context, item, Code::no_such_file, "has no patch: " + patch.string() + " is missing");
  }
  if (!item && out.cannot_switch.empty())
    root.error(Code::missing_key, "safeguard",
               "name the safeguard this case is about, or say why none can be taken out (cannot_switch)");
}

}  // namespace

std::optional<Expectation> read_expectation(const std::string& path, Diagnostics& out) {
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    out.error(Code::cannot_read, path, "cannot be read: each case has one");
    return std::nullopt;
  }
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const auto document = parse_toml(text, path, out);
  if (!document) return std::nullopt;
  Diagnostics found;
  Scene unused;
  ReadContext context(path, found, unused);
  Section root(context, {&*document, ""}, "an expectation");
  Expectation e;
  e.why = read_string(context, root.require("why")).value_or("");
  e.source = read_string(context, root.find("source")).value_or("");
  e.shortcoming = read_string(context, root.find("shortcoming")).value_or("");
  read_safeguard(context, root, e);
  e.exit_code = static_cast<int>(read_integer(context, root.require("exit_code"), 0, kMostExitCode).value_or(0));
  e.statuses = counts_of(context, root.find("status"));
  e.events = counts_of(context, root.find("events"));
  e.says = strings_of(context, root.find("says"));
  e.says_not = strings_of(context, root.find("says_not"));
  e.takes_long = read_bool(context, root.find("long")).value_or(false);
  constexpr int kMostStarts = 1000;
  e.starts = static_cast<int>(read_integer(context, root.find("starts"), 0, kMostStarts).value_or(0));
  constexpr int kMostIterations = 1'000'000'000;
  if (const auto most = read_integer(context, root.find("most_iterations"), 0, kMostIterations))
    e.most_iterations = static_cast<int>(*most);
  e.limit = read_number(context, root.find("limit"), positive(plain_rule("s"))).value_or(e.limit);
  for (const Item& item : tables_of(context, root.find("value"))) read_value(context, item, e);
  for (const Item& item : tables_of(context, root.find("mesh"))) read_recipe(context, item, e);
  if (!e.values.empty() && e.source.empty())
    root.error(Code::missing_key, "source", "say where the expected values come from");
  if (e.values.empty() && e.says.empty() && e.statuses.empty() && e.events.empty())
    root.error(Code::missing_key, "why", "nothing is expected: name values, statuses, events or words");
  root.finish();
  for (const Diagnostic& d : found.items()) out.add(d);
  return found.has_errors() ? std::nullopt : std::optional(e);
}

std::vector<HardCase> find_hard_cases(const std::string& folder, Diagnostics& out) {
  std::vector<HardCase> cases;
  std::error_code failed;
  for (const auto& family : fs::directory_iterator(folder, failed)) {
    if (!family.is_directory()) continue;
    for (const auto& entry : fs::directory_iterator(family.path(), failed)) {
      const std::string file = entry.path().filename().string();
      if (file.ends_with(kExpectEnding) || entry.path().extension() != ".toml") continue;
      HardCase c;
      c.family = family.path().filename().string();
      c.name = entry.path().stem().string();
      c.scene_file = entry.path().string();
      const auto expected = read_expectation((family.path() / (c.name + kExpectEnding)).string(), out);
      if (!expected) continue;
      c.expected = *expected;
      cases.push_back(std::move(c));
    }
  }
  if (failed) out.error(Code::cannot_read, folder, "cannot be read as a folder of hard cases: " + failed.message());
  std::sort(cases.begin(), cases.end(), [](const HardCase& a, const HardCase& b) {
    return std::pair(a.family, a.name) < std::pair(b.family, b.name);
  });
  return cases;
}

}  // namespace genu
