#include "genu/store/beside_units.h"

#include <algorithm>

#include "genu/assemble/column_units.h"
#include "genu/core/units.h"

namespace genu {
namespace {

enum class Dimension { angle, length, time, force, moment, pressure, area, energy, number };

struct MeasuredUnit {
  const char* name;
  Dimension kind;
  double si;  ///< SI per unit
};

constexpr double kMilli = 1e-3, kKilo = 1e3, kPercent = 1e-2;

constexpr MeasuredUnit kMeasuredUnits[] = {
    {"s", Dimension::time, 1},           {"ms", Dimension::time, kMilli},
    {"N", Dimension::force, 1},          {"kN", Dimension::force, kKilo},
    {"Nm", Dimension::moment, 1},        {"Nmm", Dimension::moment, units::kMillimetre},
    {"kNm", Dimension::moment, kKilo},   {"MPa", Dimension::pressure, units::kMegapascal},
    {"kPa", Dimension::pressure, kKilo}, {"Pa", Dimension::pressure, 1},
    {"mm2", Dimension::area, 1e-6},      {"cm2", Dimension::area, 1e-4},
    {"m2", Dimension::area, 1},          {"J", Dimension::energy, 1},
    {"mJ", Dimension::energy, kMilli},   {"1", Dimension::number, 1},
    {"%", Dimension::number, kPercent}};

/// "Nmm" of "N mm", "mm2" of "mm^2" and "mm²".
std::string plain_unit(std::string text) {
  for (const auto& [sign, plain] : {std::pair(" ", ""), std::pair("^", ""), std::pair("*", ""),
                                    std::pair("\xC2\xB7", ""), std::pair("\xC2\xB2", "2")})
    for (std::size_t k = text.find(sign); k != std::string::npos; k = text.find(sign))
      text.replace(k, std::string(sign).size(), plain);
  return text;
}

std::optional<MeasuredUnit> unit_called(const std::string& word) {
  const std::string plain = plain_unit(word);
  for (const MeasuredUnit& unit : kMeasuredUnits)
    if (plain == unit.name) return unit;
  if (const ColumnUnit* unit = column_unit(word))
    return MeasuredUnit{unit->name, unit->angle ? Dimension::angle : Dimension::length, unit->si};
  return std::nullopt;
}

MeasuredUnit unit_of_column(const std::string& column) {
  const std::size_t line = column.rfind('_');
  const auto unit = line == std::string::npos ? std::nullopt : unit_called(column.substr(line + 1));
  return unit.value_or(MeasuredUnit{"1", Dimension::number, 1});
}

}  // namespace

std::optional<double> unit_factor(const std::string& column, const std::string& unit) {
  const MeasuredUnit to = unit_of_column(column);
  const auto from = unit_called(unit);
  if (!from || from->kind != to.kind) return std::nullopt;
  return from->si / to.si;
}

std::string units_of(const std::string& column) {
  const Dimension kind = unit_of_column(column).kind;
  if (kind == Dimension::angle) return "deg, rad";
  if (kind == Dimension::length) return "mm, cm, m";
  std::string out;
  for (const MeasuredUnit& unit : kMeasuredUnits)
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
  const MeasuredUnit own = unit_of_column(column);
  if (own.kind != Dimension::angle && own.kind != Dimension::length) return own.name;
  return unsaid_unit(angles, own.kind == Dimension::angle).name;
}

}  // namespace genu
