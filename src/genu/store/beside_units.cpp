#include "genu/store/beside_units.h"

#include <algorithm>

#include "genu/assemble/column_units.h"
#include "genu/core/units.h"

namespace genu {
namespace {

enum class Kind { angle, length, time, force, moment, pressure, area, energy, number };

struct Unit {
  const char* name;
  Kind kind;
  double si;  ///< SI per unit
};

constexpr double kMilli = 1e-3, kKilo = 1e3, kPercent = 1e-2;

constexpr Unit kUnits[] = {{"s", Kind::time, 1},           {"ms", Kind::time, kMilli},
                           {"N", Kind::force, 1},          {"kN", Kind::force, kKilo},
                           {"Nm", Kind::moment, 1},        {"Nmm", Kind::moment, units::kMillimetre},
                           {"kNm", Kind::moment, kKilo},   {"MPa", Kind::pressure, units::kMegapascal},
                           {"kPa", Kind::pressure, kKilo}, {"Pa", Kind::pressure, 1},
                           {"mm2", Kind::area, 1e-6},      {"cm2", Kind::area, 1e-4},
                           {"m2", Kind::area, 1},          {"J", Kind::energy, 1},
                           {"mJ", Kind::energy, kMilli},   {"1", Kind::number, 1},
                           {"%", Kind::number, kPercent}};

/// "Nmm" of "N mm", "mm2" of "mm^2" and "mm²".
std::string plain_unit(std::string text) {
  for (const auto& [sign, plain] : {std::pair(" ", ""), std::pair("^", ""), std::pair("*", ""),
                                    std::pair("\xC2\xB7", ""), std::pair("\xC2\xB2", "2")})
    for (std::size_t k = text.find(sign); k != std::string::npos; k = text.find(sign))
      text.replace(k, std::string(sign).size(), plain);
  return text;
}

std::optional<Unit> unit_called(const std::string& word) {
  const std::string plain = plain_unit(word);
  for (const Unit& unit : kUnits)
    if (plain == unit.name) return unit;
  if (const ColumnUnit* unit = column_unit(word))
    return Unit{unit->name, unit->angle ? Kind::angle : Kind::length, unit->si};
  return std::nullopt;
}

Unit unit_of_column(const std::string& column) {
  const std::size_t line = column.rfind('_');
  const auto unit = line == std::string::npos ? std::nullopt : unit_called(column.substr(line + 1));
  return unit.value_or(Unit{"1", Kind::number, 1});
}

}  // namespace

std::optional<double> unit_factor(const std::string& column, const std::string& unit) {
  const Unit to = unit_of_column(column);
  const auto from = unit_called(unit);
  if (!from || from->kind != to.kind) return std::nullopt;
  return from->si / to.si;
}

std::string units_of(const std::string& column) {
  const Kind kind = unit_of_column(column).kind;
  if (kind == Kind::angle) return "deg, rad";
  if (kind == Kind::length) return "mm, cm, m";
  std::string out;
  for (const Unit& unit : kUnits)
    if (unit.kind == kind) out += (out.empty() ? "" : ", ") + std::string(unit.name);
  return out;
}

std::string unit_in_name(const std::string& name, const std::string& column) {
  std::string word;
  if (name.ends_with(']') || name.ends_with(')'))
    word = bare_unit(name.substr(std::min(name.rfind(name.back() == ']' ? '[' : '('), name.size() - 1)));
  else if (const std::size_t line = name.rfind('_'); line != std::string::npos)
    word = name.substr(line + 1);
  return unit_factor(column, word) ? word : std::string();
}

std::string unit_unsaid(const std::string& column, const AngleUnit& angles) {
  const Unit own = unit_of_column(column);
  if (own.kind != Kind::angle && own.kind != Kind::length) return own.name;
  return unsaid_unit(angles, own.kind == Kind::angle).name;
}

}  // namespace genu
