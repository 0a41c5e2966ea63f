// Numbers that are allowed, and probably meant in another unit: warnings with what was probably meant.
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/law/laws.h"
#include "genu/scene/read_parts.h"
#include "genu/scene/tolerances.h"

namespace genu {

namespace {

/// Usual stiffness of a whole ligament: Blankevoort and Huiskes 1991, Butler, Kay and Stouffer 1986, Woo 1991; of hips
/// Hewitt 2002, of ankles Siegler 1988.
struct Usual {
  const char* words[4];  ///< in small letters, one of them in the bundle's name
  const char* what;
  double per_strain;  ///< N
  double per_length;  ///< N/m
};
constexpr Usual kUsual[] = {
    {{"acl", "anterior_cruciate"}, "an anterior cruciate ligament", 6e3, 2e5},
    {{"pcl", "posterior_cruciate"}, "a posterior cruciate ligament", 9e3, 2e5},
    {{"mcl", "medial_collateral", "tibial_collateral"}, "a medial collateral ligament", 5e3, 8e4},
    {{"lcl", "lateral_collateral", "fibular_collateral"}, "a lateral collateral ligament", 3e3, 6e4},
    {{"pcap", "capsule"}, "a capsule", 2e3, 5e4},
    {{"pfl", "patellofemoral", "popliteofibular", "retinacul"}, "a patellofemoral or popliteofibular one", 2e3, 3e4},
    {{"patellar_tendon", "patellar_lig", "patellartendon", "patella_tendon"}, "a patellar tendon", 2e4, 5e5},
    {{"iliofemoral", "ischiofemoral", "pubofemoral"}, "a ligament of the hip", 4e3, 7e4},
    {{"talofibular", "calcaneofibular", "atfl"}, "a lateral ligament of the ankle", 3e3, 1.3e5}};

/// In small letters, with lines for dashes; a name in two letters written out.
std::string plain_name(std::string name) {
  for (char& c : name) c = c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const bool numbered_pt = name.starts_with("pt") && name.find_first_not_of("0123456789", 2) == std::string::npos;
  return numbered_pt ? "patellar_tendon" : name;
}

const Usual* usual_of(const std::string& name) {
  const std::string plain = plain_name(name);
  for (const Usual& usual : kUsual)
    for (const char* word : usual.words)
      if (word != nullptr && plain.find(word) != std::string::npos) return &usual;
  return nullptr;
}

void warn(ReadContext& context, const Item& item, std::string rule) {
  context.warning(item.node->where, Code::unlikely, item.path, literal(*item.node), std::move(rule));
}

void warn_strain(ReadContext& context, const Item& item, double strain) {
  if (!(strain > kMostStrain)) return;
  warn(context, item,
       fmt::format("is a strain of {:.4g} %, and ligaments fail at 10 to 30 %: was {:.4g} ({:.4g} %) meant?",
                   100 * strain, strain / 100, strain));
}

/// "5000 N", "20 N/mm"
std::string stiffness_text(double value, bool per_length) {
  return per_length ? fmt::format("{:.3g} N/mm", value * units::kMillimetre)
                    : fmt::format("{:.3g} N per unit of strain", value);
}

/// ": was 5000 meant?", where a factor between units explains the difference, as of kN or of m.
std::string meant(double written, double ratio) {
  constexpr double kNear = 30;
  for (const double factor : {1e3, 1e-3, 1e6, 1e-6})
    if (ratio / factor < kNear && factor / ratio < kNear) return fmt::format(": was {:.4g} meant?", written * factor);
  return ": check its unit";
}

void warn_stiffness(ReadContext& context, const Item& item, const LigamentDef& ligament, const NumberRow& row) {
  const bool per_length = row.unit == Unit::force_per_length;
  const Usual* usual = usual_of(ligament.name);
  if (usual == nullptr || (!per_length && row.unit != Unit::force)) return;
  const double value = ligament.number(row.key), typical = per_length ? usual->per_length : usual->per_strain;
  if (value <= kMostStiffnessRatio * typical && value >= typical / kMostStiffnessRatio) return;
  warn(context, item,
       fmt::format("is {:.3g} {} that of {}, about {}{}", std::max(value / typical, typical / value),
                   value > typical ? "times" : "times below", usual->what, stiffness_text(typical, per_length),
                   meant(item.node->number, typical / value)));
}

/// A length (m) in the scene's unit, and in mm where that is another.
std::string in_words(const ReadContext& context, double length) {
  const double unit = context.scene.length_unit;
  const std::string own = fmt::format("{:.4g} {}", length / unit, context.length_name);
  return unit == units::kMillimetre ? own : own + fmt::format(" ({:.4g} mm)", to::kMillimetre * length);
}

}  // namespace

void warn_unlikely(ReadContext& context, Section& section, const LigamentDef& ligament) {
  const LawKind* law = find_law(ligament.law);
  if (law == nullptr) return;
  for (const NumberRow& row : law->numbers) {
    const Item item = section.has(row.key) ? section.find(row.key) : Item();
    if (!item || !is_number(*item.node)) continue;
    if (row.unit == Unit::number && std::string(row.key).ends_with("_strain"))
      warn_strain(context, item, item.node->number);
    if (std::string(row.key) == "stiffness") warn_stiffness(context, item, ligament, row);
  }
  if (ligament.rest == LigamentDef::Rest::reference_strain && section.has("reference_strain"))
    warn_strain(context, section.find("reference_strain"), ligament.rest_value);
  if (ligament.points.empty()) return;
  const Item points = section.find("points");
  const Item last = points.element(points.node->children.size() - 1);
  if (last.node->children.size() == 2) warn_strain(context, last.element(0), ligament.points.back().first);
}

void warn_unlikely(ReadContext& context, Section& section, const SurfaceDef& surface) {
  for (const NumberOf<SurfaceDef>& number : kind_of(surface).numbers) {
    const NumberRow& row = number.row;
    if (row.unit != Unit::length || row.range == NumberRow::Range::any || !section.has(row.key)) continue;
    const Item item = section.find(row.key);
    const double* values = number.values_of(surface);
    const double most = *std::max_element(values, values + row.size),
                 least = *std::min_element(values, values + row.size);
    if (most > kLikelyMaxRadius)
      warn(context, item, fmt::format("is {:.4g} m: was {} meant?", most, in_words(context, most / 1000)));
    else if (least > 0 && least < kLikelyMinRadius)
      warn(context, item,
           fmt::format("is {:.4g} mm: was {} meant?", to::kMillimetre * least, in_words(context, 1000 * least)));
  }
}

namespace {

void warn_modulus(ReadContext& context, const Item& item, double modulus) {
  constexpr double kCartilage = 5e6;  // Pa
  if (!(modulus > 0) || (modulus >= kLikelyMinModulus && modulus <= kLikelyMaxModulus)) return;
  warn(context, item,
       fmt::format("is {:.3g} MPa, where cartilage has 1 to 20 MPa and polyethylene about 1000{}", 1e-6 * modulus,
                   meant(item.node->number, kCartilage / modulus)));
}

void warn_thickness(ReadContext& context, const Item& item, double thickness) {
  if (!(thickness > 0) || (thickness >= kLikelyMinThickness && thickness <= kLikelyMaxThickness)) return;
  warn(context, item, fmt::format("is {:.3g} mm, where cartilage has 1 to 6 mm", to::kMillimetre * thickness));
}

}  // namespace

void warn_unlikely(ReadContext& context, Section& section, const LayerDef& layer) {
  if (section.has("modulus")) warn_modulus(context, section.find("modulus"), layer.modulus);
  if (section.has("thickness")) warn_thickness(context, section.find("thickness"), layer.thickness);
}

}  // namespace genu
