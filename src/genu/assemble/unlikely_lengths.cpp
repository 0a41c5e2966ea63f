#include "genu/assemble/unlikely_lengths.h"

#include <algorithm>

#include <fmt/format.h>

#include "genu/assemble/tolerances.h"
#include "genu/core/units.h"
#include "genu/law/laws.h"
#include "genu/scene/tolerances.h"

namespace genu {
namespace {

/// m: across the largest closed form that is no dish of metres; 0 where there is none.
double size_of_shapes(const SceneTables& scene) {
  double size = 0;
  for (const SurfaceDef& s : scene.surfaces)
    for (const double radius : {s.radius, s.radii.maxCoeff(), s.major_radius})
      if (radius < kLikelyMaxRadius) size = std::max(size, 2 * radius);
  return size;
}

class LengthChecker {
 public:
  LengthChecker(const PlacedScene& scene, const std::vector<Pose>& poses, double meshes, Diagnostics& out)
      : scene_(scene), out_(out), meshes_(meshes) {
    for (const LigamentDef& ligament : scene_.ligaments) lengths_.push_back(path_length(ligament, poses));
  }

  void check() {
    if (meshes_ > 0 && warn_unit_of_scene()) return;
    const bool meshes = meshes_ > 0;
    const double size = meshes ? meshes_ : size_of_shapes(scene_), wider = meshes ? 1 : kShapesWider;
    if (size <= 0) return;
    for (std::size_t k = 0; k < lengths_.size(); ++k) {
      const bool is_long = lengths_[k] > wider * kMostLengthRatio * size;
      const LawKind* law = find_law(scene_.ligaments[k].law);
      const bool may_be_short = law != nullptr && law->both_ways;
      if (is_long || (!may_be_short && wider * lengths_[k] < kLeastLengthRatio * size)) warn_ligament(k, size, is_long);
    }
  }

 private:
  /// The largest length of the scene apart from its meshes: ligaments, translations, points of loads.
  double largest_length() const {
    double largest = lengths_.empty() ? 0 : *std::max_element(lengths_.begin(), lengths_.end());
    for (const JointDef& joint : scene_.joints)
      for (int i = 3; i < 6; ++i) largest = std::max(largest, std::abs(joint.reference[at(i)]));
    for (const LoadDef& load : scene_.loads) largest = std::max(largest, load.point.norm());
    return largest;
  }

  bool warn_unit_of_scene() {
    const double largest = largest_length();
    const bool metres = scene_.length_unit == units::kMetre;
    const bool too_large = metres && largest > kOtherUnitRatio * meshes_;
    const bool too_small = !metres && !lengths_.empty() && largest > 0 && largest < meshes_ / kOtherUnitRatio;
    if (!too_large && !too_small) return false;
    out_.add(
        warning_at({scene_.file, scene_.units_where}, Code::unlikely, "units.length", metres ? "\"m\"" : "\"mm\"",
                   fmt::format("the lengths of the scene reach {:.4g} mm, and its meshes are {:.4g} mm across: was "
                               "\"{}\" meant (then they reach {:.4g} mm)?",
                               to::kMillimetre * largest, to::kMillimetre * meshes_, metres ? "mm" : "m",
                               to::kMillimetre * largest * (metres ? 1e-3 : 1e3))));
    return true;
  }

  void warn_ligament(std::size_t k, double size, bool is_long) {
    const LigamentDef& ligament = scene_.ligaments[k];
    const double length = to::kMillimetre * lengths_[k];
    out_.add(warning_at({scene_.file, ligament.where}, Code::unlikely, "ligament." + ligament.name, {},
                        fmt::format("is {:.4g} mm long at the reference pose, beside surfaces {:.4g} mm across: was "
                                    "{:.4g} mm meant? Check its points, units.length and the joint's reference",
                                    length, to::kMillimetre * size, is_long ? length / 1000 : length * 1000)));
  }

  const PlacedScene& scene_;
  Diagnostics& out_;
  double meshes_;
  std::vector<double> lengths_;  ///< m, of each ligament at the reference pose
};

}  // namespace

void warn_unlikely_lengths(const PlacedScene& scene, const std::vector<Pose>& poses, double meshes, Diagnostics& out) {
  LengthChecker(scene, poses, meshes, out).check();
}

}  // namespace genu
