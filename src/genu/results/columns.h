// Names of result columns that more than one table has.
#pragma once

#include <array>
#include <string>

#include "genu/core/units.h"
#include "genu/model/grood_suntay.h"
#include "genu/model/layer_report.h"
#include "genu/scene/scene.h"

namespace genu {

/// Of the components of a vector.
inline constexpr const char* kAxisNames[] = {"x", "y", "z"};

/// "knee.flexion_deg", "knee.x_mm", or of a combination
std::string coordinate_column(const SceneTables& scene, const QuantityRef& c);

/// A value (SI) in the unit of its coordinate_column().
double shown_value(const QuantityRef& c, double value);

/// "knee.flexion.reaction_Nm"
std::string reaction_column(const SceneTables& scene, const QuantityRef& c);

/// "elbow.reaction.force_x_N", i from 0 to 5: force, then moment
std::string held_column(const std::string& joint, std::size_t i);

/// "tibia.residual_force_x_N", i from 0 to 5: force, then moment
std::string residual_column(const std::string& body, std::size_t i);

/// Of a joint with `grood_suntay`, angles first: of a tibia as KneeMotion has them, of a patella in the words for it.
inline constexpr std::size_t kClinicalColumns = 6;
/// "flexion_deg"; i from 0 to 5
const char* clinical_name(const JointDef& joint, std::size_t i);
/// "knee.gs.flexion_deg"
std::string clinical_column(const JointDef& joint, std::size_t i);
/// The six numbers (rad, m) of a motion, or of its rate.
std::array<double, kClinicalColumns> clinical_numbers(const JointDef& joint, const KneeMotion& motion);
/// The unit of number i in its column.
constexpr double clinical_unit(std::size_t i) { return i < 3 ? to::kDegree : to::kMillimetre; }

/// "femur_medial.x_mm" of a contact point's place in the body of the pair's first or second surface
std::string point_column(const SceneTables& scene, std::size_t pair, bool second, std::size_t axis);

/// The same of an elastic layer's centre of pressure.
std::string centre_column(const SceneTables& scene, const ContactDef& contact, bool second, std::size_t axis);

/// Columns of an elastic layer as a whole or of one of its regions, after its name.
struct LayerColumn {
  const char* name;  ///< "area_mm2"
  double (*value)(const LayerTotals&);
};
extern const std::array<LayerColumn, 13> kLayerColumns;

/// "knee.adduction" of "knee.adduction_deg"
std::string without_unit(const std::string& column);

}  // namespace genu
