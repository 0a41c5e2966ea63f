#include "genu/assemble/surface_fits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "genu/assemble/tolerances.h"
#include "genu/core/atomic_output.h"
#include "genu/core/units.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/results/coverage_picture.h"
#include "genu/scene/surface_writer.h"
#include "genu/scene/utf8.h"

namespace genu {
namespace {

std::string point_text(const Vec3& p) {
  return fmt::format("[{:.1f}, {:.1f}, {:.1f}] mm", to::kMillimetre * p.x(), to::kMillimetre * p.y(),
                     to::kMillimetre * p.z());
}

CoverageMap coverage_map(const NamedFit& named) {
  const SurfaceFit& fit = named.fit;
  CoverageMap map;
  map.title = fmt::format("{}: degree {}, rms {:.3f} mm", named.name, fit.degree, to::kMillimetre * fit.residual.rms);
  double radius = 0;
  for (const PolynomialTerm& t : fit.terms)
    if (t.i == 0 && t.j == 0) radius = t.c;
  const double stretch = to::kMillimetre * (fit.chart.cylindrical ? radius : 1);  // mm per unit of u
  map.u_title = fit.chart.cylindrical ? fmt::format("theta times {:.1f} mm", to::kMillimetre * radius) : "x, mm";
  map.v_title = fit.chart.cylindrical ? "z, mm" : "y, mm";
  map.low = Vec2(stretch * fit.patch.u0, to::kMillimetre * fit.patch.v0);
  map.high = Vec2(stretch * fit.patch.u1, to::kMillimetre * fit.patch.v1);
  map.spacing = to::kMillimetre * median_edge_length(fit.zone, mesh_edges(fit.zone));
  const auto at = [&](const Vec3& p) {
    const ChartPoint c = fit.chart.coordinates(p);
    return Vec2(stretch * c.u, to::kMillimetre * c.v);
  };
  for (std::size_t v = 0; v < fit.zone.vertices.size(); ++v) {
    CoverageMap::Sample sample{at(fit.zone.vertices[v]), std::nullopt};
    if (std::isfinite(fit.distance[v])) sample.distance = to::kMillimetre * fit.distance[v];
    map.samples.push_back(sample);
  }
  for (const Vec3& p : named.contacts) map.contacts.push_back(at(p));
  return map;
}

std::string to_json(const NamedFit& named) {
  std::string doubtful;
  for (const std::string& doubt : doubts(named.fit)) doubtful += (doubtful.empty() ? "" : ", ") + toml_string(doubt);
  const SurfaceFit& f = named.fit;
  const Vec3 where = to::kMillimetre * f.residual.where;
  std::string scores;
  for (const DegreeScore& s : f.scores)
    scores +=
        fmt::format("{}{{\"degree\": {}, \"left_out_rms_mm\": {}, \"fitted_rms_mm\": {}}}", scores.empty() ? "" : ", ",
                    s.degree, to::kMillimetre * s.left_out_rms, to::kMillimetre * s.fitted_rms);
  return fmt::format(
      "    {{\"name\": \"{}\", \"source\": {}, \"chart\": \"{}\", \"degree\": {}, \"coefficients\": {},\n"
      "     \"rms_mm\": {}, \"largest_mm\": {}, \"largest_at_mm\": [{}, {}, {}], \"vertices\": {}, \"covered\": {},\n"
      "     \"noise_mm\": {}, \"degrees_tried\": [{}], \"doubts\": [{}]}}",
      named.name, toml_string(named.source), f.chart.cylindrical ? "cylindrical" : "cartesian", f.degree,
      f.terms.size(), to::kMillimetre * f.residual.rms, to::kMillimetre * f.residual.largest, where.x(), where.y(),
      where.z(), f.residual.count, f.covered, to::kMillimetre * f.noise, scores, doubtful);
}

}  // namespace

SurfaceDef surface_def(const NamedFit& named) {
  const SurfaceFit& fit = named.fit;
  SurfaceDef def;
  def.name = named.name;
  def.shape = fit.chart.cylindrical ? SurfaceDef::Shape::cylindrical_polynomial : SurfaceDef::Shape::polynomial;
  def.placement = fit.chart.X_BS;
  def.inside = fit.inside;
  for (const PolynomialTerm& t : fit.terms) def.terms.push_back({t.i, t.j, t.c});
  SurfaceDef::Patch patch;
  const std::pair u(fit.patch.u0, fit.patch.u1), v(fit.patch.v0, fit.patch.v1);
  if (fit.chart.cylindrical) {
    patch.theta = u;
    patch.box[2] = v;
  } else {
    patch.box[0] = u;
    patch.box[1] = v;
  }
  def.patch = patch;
  return def;
}

std::optional<KnownPatch> known_patch(const SurfaceDef& def) {
  const bool cylindrical = def.shape == SurfaceDef::Shape::cylindrical_polynomial;
  if (!cylindrical && def.shape != SurfaceDef::Shape::polynomial) return std::nullopt;
  if (!def.patch) return std::nullopt;
  const SurfaceDef::Patch& p = *def.patch;
  const auto &u = cylindrical ? p.theta : p.box[0], &v = cylindrical ? p.box[2] : p.box[1];
  const bool others = cylindrical ? p.box[0] || p.box[1] : p.theta || p.box[2];
  if (!u || !v || others) return std::nullopt;
  KnownPatch known{{cylindrical, def.placement}, def.inside, {u->first, u->second, v->first, v->second}, 0};
  for (const SurfaceDef::Term& t : def.terms) known.degree = std::max(known.degree, t.i + t.j);
  return known;
}

std::string describe(const SurfaceFit& fit) {
  const double u = fit.patch.width(), v = to::kMillimetre * fit.patch.height();
  const std::string patch = fit.chart.cylindrical ? fmt::format("{:.0f} deg x {:.1f} mm", u / units::kDegree, v)
                                                  : fmt::format("{:.1f} x {:.1f} mm", to::kMillimetre * u, v);
  return fmt::format(
      "{}, degree {}, patch {} ({:.0f} % over mesh), rms {:.3g} mm along its normal, largest {:.3g} mm at {}, {} "
      "vertices",
      fit.chart.cylindrical ? "cylindrical" : "cartesian", fit.degree, patch, 100 * fit.covered,
      to::kMillimetre * fit.residual.rms, to::kMillimetre * fit.residual.largest, point_text(fit.residual.where),
      fit.residual.count);
}

std::vector<std::string> doubts(const SurfaceFit& fit) {
  // What measured cartilage leaves over a good fit is 1 to 3 times its noise; less than 0.1 mm no scan resolves.
  std::vector<std::string> out;
  const FitResidual& r = fit.residual;
  if (r.rms > std::max(kFitRmsOfNoise * fit.noise, kFitRmsUnseen))
    out.push_back(
        fmt::format("the vertices lie {:.3g} mm rms off it, but their own noise is {:.2g} mm: it does not "
                    "follow the shape; a smaller region or another degree may",
                    to::kMillimetre * r.rms, to::kMillimetre * fit.noise));
  const double largest = std::abs(r.largest);
  if (largest > std::max({kFitPeakOfNoise * fit.noise, kFitPeakOfNoise * r.rms, kFitPeakUnseen}))
    out.push_back(fmt::format("one vertex lies {:.3g} mm off it, far more than the others: look at {}",
                              to::kMillimetre * largest, point_text(r.where)));
  if (fit.wanted_degree > fit.degree)
    out.push_back(fmt::format("the degree was lowered from {} to {}: higher ones fold or swing out over the patch",
                              fit.wanted_degree, fit.degree));
  return out;
}

std::string surface_tables(const std::vector<NamedFit>& fits, double length_unit, double angle_unit) {
  std::string out;
  for (const NamedFit& named : fits) {
    if (!out.empty()) out += "\n";
    out += fmt::format("# Fitted to {}:\n# {}.\n", printable(valid_utf8(named.source)), describe(named.fit));
    for (const std::string& doubt : doubts(named.fit)) out += "# DOUBTFUL: " + doubt + ".\n";
    out += polynomial_table(surface_def(named), named.body, length_unit, angle_unit);
  }
  return out;
}

std::vector<std::pair<std::string, std::string>> fit_files(const std::vector<NamedFit>& fits) {
  std::vector<CoverageMap> maps;
  std::string json = "{\n  \"genu\": \"fit\",\n  \"surfaces\": [\n";
  for (const NamedFit& named : fits) {
    maps.push_back(coverage_map(named));
    json += to_json(named) + (&named == &fits.back() ? "\n" : ",\n");
  }
  return {{"coverage.svg", coverage_svg(maps)}, {"summary.json", json + "  ]\n}\n"}};
}

std::string write_folder(const std::string& folder, const std::vector<std::pair<std::string, std::string>>& files) {
  StagedFolder out("results");
  std::string error = text_of(out.open(folder));
  for (const auto& [name, content] : files)
    if (error.empty()) error = write_file_atomically(out.path() / name, content);
  return error.empty() ? out.commit() : error;
}

}  // namespace genu
