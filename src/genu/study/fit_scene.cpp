#include "genu/study/fit_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "genu/appraise/contact_zones.h"
#include "genu/assemble/scene_edit.h"
#include "genu/shape_fit/chart_choice.h"
#include "genu/shape_fit/fit_zone.h"
#include "genu/study/run_motion.h"
#include "genu/study/tolerances.h"

namespace genu {
namespace {

/// The axis that a surface turns about as its contacts travel; none where they hardly turn.
std::optional<Vec3> axis_of(const std::vector<Vec3>& points, const std::vector<Vec3>& normals) {
  double least = 1;
  for (const Vec3& n : normals) least = std::min(least, n.dot(normals.front()));
  if (least > kTurnedCosine) return std::nullopt;
  std::vector<OrientedPoint> path;
  for (std::size_t k = 0; k < points.size(); ++k) path.push_back({points[k], normals[k], 1});
  return normal_axes(path).front();
}

class SceneFitter {
 public:
  SceneFitter(const Prepared& prepared, const FitSceneRequest& request, Diagnostics& out)
      : prepared_(prepared), request_(request), out_(out) {}

  bool run(const Solution& solution, SceneFits& result) {
    const std::vector<ContactZone> zones = contact_zones(prepared_, solution, kSurfacesApart);
    for (const ContactZone& zone : zones) add(zone, zones, result);
    if (result.fits.empty() && !out_.has_errors())
      out_.error(Code::not_applicable, request_.file, "has no contact on a mesh: there is nothing to fit");
    return !out_.has_errors();
  }

  const std::vector<FittedPair>& pairs() const { return pairs_; }

 private:
  void add(const ContactZone& zone, const std::vector<ContactZone>& zones, SceneFits& result) {
    const ContactDef& contact = prepared_.scene.contacts[at(zone.contact)];
    const auto same_pair = [&](const ContactZone& z) { return z.contact == zone.contact; };
    const bool alone = std::count_if(zones.begin(), zones.end(), same_pair) == 1;
    FittedPair pair{zone.contact, alone ? contact.name : zone.name, {}, {}};
    while (!names_.insert(pair.name).second) pair.name = contact.name + "_" + pair.name;
    pair.surface_a = fit(contact.surface_a, pair.name, alone, zone.points_a, zone.normals_a, result);
    pair.surface_b = fit(contact.surface_b, pair.name, alone, zone.points_b, zone.normals_b, result);
    pairs_.push_back(std::move(pair));
  }

  /// The name of the surface that takes the place of surface `index` in a pair: its own where it has a formula.
  std::string fit(int index, const std::string& pair, bool alone, const std::vector<Vec3>& points,
                  const std::vector<Vec3>& normals, SceneFits& result) {
    const SurfaceDef& def = prepared_.scene.surfaces[at(index)];
    if (def.shape != SurfaceDef::Shape::mesh) return def.name;
    // One contact alone keeps the surface's name, unless another contact has the surface too.
    const auto has_it = [&](const ContactDef& c) { return c.surface_a == index || c.surface_b == index; };
    const auto& contacts = prepared_.scene.contacts;
    const bool own = alone && std::count_if(contacts.begin(), contacts.end(), has_it) == 1;
    NamedFit named;
    named.name = own ? def.name : def.name + "_" + pair;
    named.body = prepared_.scene.bodies[at(def.body)].name;
    for (const std::string& file : def.file.paths)
      named.source += (named.source.empty() ? "" : ", ") + std::filesystem::path(file).filename().string();

    // The box round a path that winds reaches farther from it than the margin.
    const Mesh mesh = prepared_.surfaces[at(index)]->triangles(0, Vec3::Zero(), 0);
    const Mesh piece = zone_round(mesh, points, normals, 2 * request_.margin);
    SurfaceFitOptions options;
    options.degree = request_.degree;
    options.axis = axis_of(points, normals);
    options.one_face = true;  // zone_round() looks at normals
    options.keep = points;
    options.margin = request_.margin;
    auto fit = fit_surface(piece, options, "surface." + named.name, out_);
    if (!fit) return named.name;
    to_file_frame(prepared_.scene.origins[at(def.body)], *fit);
    named.fit = std::move(*fit);
    for (const Vec3& p : points) named.contacts.push_back(p + prepared_.scene.origins[at(def.body)]);
    result.fits.push_back(std::move(named));
    return result.fits.back().name;
  }

  /// From the origin the solver chose for the body to the file's.
  static void to_file_frame(const Vec3& centre, SurfaceFit& fit) {
    fit.chart.X_BS.p += centre;
    fit.residual.where += centre;
    for (Vec3& v : fit.zone.vertices) v += centre;
  }

  const Prepared& prepared_;
  const FitSceneRequest& request_;
  Diagnostics& out_;
  std::vector<FittedPair> pairs_;
  std::set<std::string> names_;  ///< of pairs
};

}  // namespace

std::optional<SceneFits> fit_scene(const FitSceneRequest& request, const std::string& folder, Diagnostics& out) {
  const auto prepared = prepare_run(request.file, folder, out);
  if (!prepared || refuse_motion(*prepared, "fit", out)) return std::nullopt;
  ContactField field(prepared->model);
  if (!check_start(*prepared, field, out)) return std::nullopt;
  SceneFits result;
  result.solution = solve(*prepared, field, {});
  if (result.solution.summary.poses_solved == 0) {
    out.error(Code::not_solved, request.file, "has no pose that is solved: where its surfaces touch is not known");
    return std::nullopt;
  }
  SceneFitter fitter(*prepared, request, out);
  if (!fitter.run(result.solution, result)) return std::nullopt;
  result.scene = with_fitted_surfaces(request.file, prepared->scene, fitter.pairs(), result.fits, folder, out);
  if (out.has_errors()) return std::nullopt;
  return result;
}

std::vector<std::pair<std::string, double>> pose_differences(const SceneTables& scene, const ResultTable& a,
                                                             const ResultTable& b) {
  std::vector<std::pair<std::string, double>> out;
  const std::size_t rows = std::min(a.rows(), b.rows());
  for (const JointDef& joint : scene.joints) {
    for (int i = 0; i < 6; ++i) {
      if (!joint.leaves(i)) continue;
      const auto k = static_cast<std::size_t>(i % 3);
      const std::string name =
          joint.name + "." + (i < 3 ? joint.rotations[k].name + "_deg" : joint.translations[k] + "_mm");
      double worst = 0;
      for (std::size_t row = 0; row < rows; ++row) {
        const double off = std::abs(a.number(row, name) - b.number(row, name));
        if (std::isfinite(off)) worst = std::max(worst, off);
      }
      out.emplace_back(name, worst);
    }
  }
  return out;
}

}  // namespace genu
