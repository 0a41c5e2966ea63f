#include "genu/shape_fit/surface_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/mesh/mesh_part.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/shape_fit/chart_choice.h"
#include "genu/shape_fit/covered_box.h"
#include "genu/shape_fit/patch_border.h"
#include "genu/shape_fit/tame_degree.h"
#include "genu/shape_fit/tolerances.h"
#include "genu/surface/creases.h"
#include "genu/surface/mesh_noise.h"
#include "genu/surface/polynomial_surface.h"

namespace genu {
namespace {

/// A chart with what the zone is in it.
struct PlacedFit {
  SurfaceChart chart;
  ChartBox patch;
  double covered = 0;
  Mesh part;  ///< the zone's facets that face the chart's way
  std::vector<HeightSample> samples;
  ChartBox sampled;
};

class Fitter {
 public:
  Fitter(const Mesh& zone, const SurfaceFitOptions& options) : zone_(zone), options_(options) {}

  std::optional<SurfaceFit> run(std::string& why);

 private:
  bool start(std::string& why);
  std::optional<SurfaceFit> from_border(std::string& why);
  std::optional<SurfaceFit> cut_from(PlacedFit& at, std::string& why) const;
  bool choose_chart(const std::vector<OrientedPoint>& points, const std::vector<SurfaceChart>& charts,
                    std::string& why);
  bool place(PlacedFit& at, std::string& why) const;
  void gather(PlacedFit& at) const;
  bool settle(PlacedFit& at, int degree) const;
  void settle_if_possible(PlacedFit& at, int degree) const;
  void fix_patch(PlacedFit& at) const;
  bool opposed(const PlacedFit& at) const;
  int choose(const PlacedFit& at, std::vector<DegreeScore>& scores) const;
  int tame_degree(const PlacedFit& at, const PolynomialFit& fit, int degree) const;
  std::optional<SurfaceFit> checked(const PlacedFit& at, int degree, std::vector<DegreeScore> scores,
                                    std::string& why) const;
  SurfaceFit finish(const PlacedFit& at, int degree, std::vector<DegreeScore> scores) const;
  ChartBox keep_box(const SurfaceChart& chart, double beyond) const;

  const Mesh& zone_;
  const SurfaceFitOptions& options_;
  SurfaceChart first_;
  bool inside_ = false;
  bool patch_is_fixed_ = false;  ///< else it follows the chart
};

bool Fitter::start(std::string& why) {
  const std::vector<OrientedPoint> points = oriented_points(zone_);
  double area = 0;
  for (const OrientedPoint& q : points) area += q.area;
  const double size = bounding_box(zone_).diagonal();
  if (zone_.triangles.empty() || !(area > 1e-9 * size * size)) {
    why = "holds no surface";
    return false;
  }
  first_.X_BS = plane_frame(points);
  double height = 0;
  for (const OrientedPoint& q : points) height = std::max(height, std::abs(first_.to_own(q.p).z()));
  if (!(height > 1e-6 * size)) {
    why = "is flat: write it as shape = \"plane\"";
    return false;
  }
  if (options_.like) {
    first_ = options_.like->chart;
    inside_ = options_.like->inside;
    return true;
  }
  const bool wraps = options_.cylindrical.value_or(wraps_round(points));
  std::vector<SurfaceChart> charts;
  if (!options_.cylindrical.value_or(false)) charts.push_back(first_);
  if (wraps) {
    if (options_.axis) charts.clear();  // what is known about the piece goes before what it looks like
    for (const Vec3& axis : options_.axis ? std::vector<Vec3>{*options_.axis} : normal_axes(points))
      charts.push_back({true, axis_frame(points, axis)});
  }
  return choose_chart(points, charts, why);
}

/// The polynomial that the zone was cut from, where its border tells the chart and it has one there.
std::optional<SurfaceFit> Fitter::from_border(std::string& why) {
  if (options_.like || !options_.keep.empty()) return std::nullopt;
  const auto border = chart_of_border(zone_);
  if (!border || options_.cylindrical.value_or(border->chart.cylindrical) != border->chart.cylindrical)
    return std::nullopt;
  inside_ = faces_inward(border->chart, oriented_points(zone_));
  patch_is_fixed_ = true;
  PlacedFit at{border->chart, border->patch, 1, {}, {}, {}};
  auto exact = place(at, why) ? cut_from(at, why) : std::nullopt;
  if (!exact) {  // another chart may do
    patch_is_fixed_ = false;
    why.clear();
  }
  return exact;
}

/// The polynomial that all samples lie on to the file's rounding.
std::optional<SurfaceFit> Fitter::cut_from(PlacedFit& at, std::string& why) const {
  const PolynomialFit fit(at.samples, at.sampled, kHighestFitDegree);
  const int exact = exact_degree(fit, file_resolution(zone_)), degree = options_.degree.value_or(exact);
  if (exact < kLowestFitDegree || fit.highest() < degree) return std::nullopt;
  if (!at.chart.cylindrical) {  // its origin is on the surface
    at.chart.X_BS.p = at.chart.position({0, 0, Polynomial(fit.terms(degree)).value(0, 0)});
    gather(at);
  }
  return checked(at, degree, {}, why);
}

/// Of some charts the one that sees most of the zone with least left over.
bool Fitter::choose_chart(const std::vector<OrientedPoint>& points, const std::vector<SurfaceChart>& charts,
                          std::string& why) {
  const SurfaceChart* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const SurfaceChart& chart : charts) {
    inside_ = faces_inward(chart, points);
    PlacedFit at{chart, {}, 0, {}, {}, {}};
    std::vector<DegreeScore> scores;
    if (!place(at, why)) continue;
    if (const int degree = choose(at, scores); degree >= kLowestFitDegree) {
      const PolynomialFit fit(at.samples, at.sampled, degree);
      double seen = 0, area = 0;
      for (const OrientedPoint& q : points) {
        const ChartPoint c = at.chart.coordinates(q.p);
        area += q.area;
        if (at.patch.contains(c.u, c.v)) seen += q.area;
      }
      const double cost = (fit.rms(degree) + kGoodEnoughRms) * area * area / (seen * seen);
      if (!best || cost < least) best = &chart, least = cost;
    } else {
      why = fmt::format("has too few vertices ({}) for degree {}", at.samples.size(),
                        options_.degree.value_or(kLowestChosen));
    }
  }
  if (!best) return false;
  why.clear();
  first_ = *best;
  inside_ = faces_inward(first_, points);
  return true;
}

/// The box of the points to keep, `beyond` (m) larger.
ChartBox Fitter::keep_box(const SurfaceChart& chart, double beyond) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  ChartBox box{kInfinity, -kInfinity, kInfinity, -kInfinity};
  double radius = 0;
  for (const Vec3& p : options_.keep) {
    const ChartPoint q = chart.coordinates(p);
    box.u0 = std::min(box.u0, q.u), box.u1 = std::max(box.u1, q.u);
    box.v0 = std::min(box.v0, q.v), box.v1 = std::max(box.v1, q.v);
    radius += q.h / static_cast<double>(options_.keep.size());
  }
  return box.grown(chart.cylindrical ? beyond / radius : beyond, beyond);
}

/// Finds the facets that face the chart's way and the patch that they fill, centres the chart on it.
bool Fitter::place(PlacedFit& at, std::string& why) const {
  const double side = inside_ ? -1 : 1;
  at.part = largest_sheet(part_of(zone_, [&](const Vec3& centre, const Vec3& normal) {
    return side * normal.dot(at.chart.upward(centre)) > kMinFacetCosine;
  }));
  if (!patch_is_fixed_) {
    if (!at.chart.cylindrical) align_with_zone(at.part, at.chart);
    std::optional<ChartBox> limits, keep;
    if (!options_.keep.empty())
      limits = keep_box(at.chart, options_.margin), keep = keep_box(at.chart, std::min(options_.margin, kKeptBeyond));
    const auto found = covered_box(at.part, at.chart, limits, keep);
    if (!found) {
      why = "holds no surface that one side of a chart sees";
      return false;
    }
    at.patch = found->box;
    at.covered = found->covered;
    centre_on(at.patch, at.chart);
  }
  gather(at);
  return true;
}

void Fitter::gather(PlacedFit& at) const {
  at.sampled = at.patch.grown(kSampledBeyond * at.patch.width(), kSampledBeyond * at.patch.height());
  at.samples.clear();
  const double side = inside_ ? -1 : 1;
  for (const OrientedPoint& q : oriented_points(at.part)) {
    const ChartPoint c = at.chart.coordinates(q.p);
    if (!at.sampled.contains(c.u, c.v)) continue;
    // A height error counts by the distance it makes, which the slope makes shorter.
    const double cosine = std::max(0.1, side * q.n.dot(at.chart.upward(q.p)));
    at.samples.push_back({c.u, c.v, c.h, q.area * cosine * cosine});
  }
}

/// Moves a cartesian chart until it is level, the patch with it, again and again: each time what is left shrinks, until
/// rounding keeps it from doing so. False where it does not: patch and chart may chase each other round a ragged edge.
bool Fitter::settle(PlacedFit& at, int degree) const {
  double before = std::numeric_limits<double>::infinity(), change = 0;
  for (int k = 0; k < kMaxFrameRounds; ++k) {
    const SurfaceChart old = at.chart;
    std::string why;
    if (!place(at, why)) return false;
    const PolynomialFit fit(at.samples, at.sampled, degree);
    if (fit.highest() < kLowestFitDegree) return false;
    at.chart = level_chart(at.chart, fit.terms(std::min(degree, fit.highest())));
    change = chart_difference(old, at.chart, at.patch.width());
    if (!std::isfinite(change)) return false;
    if (change < kFrameSettled || (k >= kPatientRounds && change > kStillFalls * before)) break;
    before = change;
  }
  gather(at);
  return change < kFrameNearlySettled;
}

/// Settles a copy and takes it where that works; an axis stays where it is.
void Fitter::settle_if_possible(PlacedFit& at, int degree) const {
  if (at.chart.cylindrical) return;
  PlacedFit moved = at;
  if (settle(moved, degree)) at = std::move(moved);
}

/// The patch in round numbers, inside what it was; x along the longer side.
void Fitter::fix_patch(PlacedFit& at) const {
  const auto down = [](double half, double step) {
    const double whole = std::floor(half / step + kRoundNumber) * step;
    return whole > 0 ? whole : half;
  };
  double a = 0.5 * at.patch.width(), b = 0.5 * at.patch.height();
  if (at.chart.cylindrical) {
    const Vec3 z = largest_positive(at.chart.X_BS.R.col(2)), x = at.chart.X_BS.R.col(0);
    at.chart.X_BS.R << x, z.cross(x), z;
  } else if (b > a) {
    std::swap(a, b);
    const Vec3 x = largest_positive(at.chart.X_BS.R.col(1)), z = at.chart.X_BS.R.col(2);
    at.chart.X_BS.R << x, z.cross(x), z;
  }
  a = down(a, at.chart.cylindrical ? kRoundAngle : kRoundLength);
  b = down(at.chart.cylindrical ? b : std::min(b, kLongerSide * a), kRoundLength);
  at.patch = {-a, a, -b, b};
}

/// Whether much of the patch is covered twice, by faces that look opposite ways.
bool Fitter::opposed(const PlacedFit& at) const {
  const double side = inside_ ? -1 : 1;
  double with = 0, against = 0;
  for (const OrientedPoint& q : oriented_points(zone_)) {
    const ChartPoint c = at.chart.coordinates(q.p);
    if (!at.patch.contains(c.u, c.v)) continue;
    const double cosine = side * q.n.dot(at.chart.upward(q.p));
    (cosine > kOpposedCosine ? with : against) += q.area;
  }
  return against > kOpposedShare * with;
}

int Fitter::tame_degree(const PlacedFit& at, const PolynomialFit& fit, int degree) const {
  return highest_tame_degree(fit, at.samples, at.patch, at.chart.cylindrical, degree);
}

int Fitter::choose(const PlacedFit& at, std::vector<DegreeScore>& scores) const {
  scores.clear();
  if (at.samples.empty()) return -1;
  const PolynomialFit fit(at.samples, at.sampled, options_.degree.value_or(kHighestChosen));
  if (options_.degree) return fit.highest() < *options_.degree ? -1 : *options_.degree;
  scores =
      fit.scores(kLowestChosen, kValidationBlock / (at.chart.cylindrical ? at.samples.front().h : 1), kValidationBlock);
  const int degree = choose_degree(scores, kFileRounding);
  return degree < 0 ? fit.highest() : tame_degree(at, fit, degree);
}

SurfaceFit Fitter::finish(const PlacedFit& at, int degree, std::vector<DegreeScore> scores) const {
  SurfaceFit fit;
  fit.chart = at.chart;
  fit.inside = inside_;
  fit.patch = at.patch;
  fit.degree = degree;
  fit.wanted_degree = scores.empty() ? 0 : choose_degree(scores, kFileRounding);
  fit.terms = PolynomialFit(at.samples, at.sampled, degree).terms(degree);
  fit.scores = std::move(scores);
  fit.covered = at.covered;
  fit.zone = at.part;
  const auto surface = fit.surface();
  // A mesh cut from a patch ends on its edges: which side rounding puts such a vertex says nothing.
  const double radius = fit.chart.cylindrical ? at.samples.front().h : 1;
  const ChartBox counted = fit.patch.grown(kFileRounding / radius, kFileRounding);
  double area = 0, square = 0;
  for (const OrientedPoint& q : oriented_points(fit.zone)) {
    const ChartPoint c = fit.chart.coordinates(q.p);
    const auto gap = counted.contains(c.u, c.v) ? surface->gap(q.p) : std::nullopt;
    fit.distance.push_back(gap.value_or(std::numeric_limits<double>::quiet_NaN()));
    if (!gap) continue;
    area += q.area;
    square += q.area * *gap * *gap;
    ++fit.residual.count;
    if (std::abs(*gap) > std::abs(fit.residual.largest)) fit.residual.largest = *gap, fit.residual.where = q.p;
  }
  fit.residual.rms = area > 0 ? std::sqrt(square / area) : 0;
  fit.noise = estimate_noise(fit.zone, graph_with_creases(fit.zone)).rms;
  return fit;
}

std::optional<SurfaceFit> Fitter::run(std::string& why) {
  if (auto exact = from_border(why)) return exact;
  if (!start(why)) return std::nullopt;
  PlacedFit at{first_, {}, 0, {}, {}, {}};
  if (options_.like) {
    at.patch = options_.like->patch;
    at.covered = 1;
    patch_is_fixed_ = true;
    const int degree = options_.degree.value_or(options_.like->degree);
    if (!place(at, why)) return std::nullopt;
    return checked(at, degree, {}, why);
  }
  if (!place(at, why)) return std::nullopt;
  settle_if_possible(at, std::min(kFrameDegree, options_.degree.value_or(kFrameDegree)));
  if (!options_.one_face && opposed(at)) {
    why = "holds both faces of a shell: say which one, by the side it faces or by a region";
    return std::nullopt;
  }
  // The chart suits the degree and the degree the chart: they agree after a round or two.
  std::vector<DegreeScore> scores;
  int degree = choose(at, scores);
  for (int round = 0; round < 3 && degree > 0; ++round) {
    settle_if_possible(at, degree);
    const int again = choose(at, scores);
    if (again == degree) break;
    degree = again;
  }
  if (degree < kLowestFitDegree) {
    why = fmt::format("has too few vertices ({}) for degree {}", at.samples.size(), options_.degree.value_or(2));
    return std::nullopt;
  }
  fix_patch(at);
  patch_is_fixed_ = true;
  settle_if_possible(at, degree);
  gather(at);
  return checked(at, degree, std::move(scores), why);
}

/// The fit where it may be written down.
std::optional<SurfaceFit> Fitter::checked(const PlacedFit& at, int degree, std::vector<DegreeScore> scores,
                                          std::string& why) const {
  const PolynomialFit fit(at.samples, at.sampled, degree);
  if (fit.highest() < degree) {
    why = fmt::format("has too few vertices ({}) for degree {}", at.samples.size(), degree);
    return std::nullopt;
  }
  const int tame = tame_degree(at, fit, degree);
  const bool given = options_.degree || options_.like;
  if (!given && tame >= kLowestChosen) return finish(at, tame, std::move(scores));
  if (tame != degree) {
    why = fmt::format(
        "bends so that a polynomial of degree {} folds or swings out over it: a smaller region, another "
        "chart or another degree may do",
        degree);
    return std::nullopt;
  }
  return finish(at, degree, std::move(scores));
}

}  // namespace

std::unique_ptr<Surface> SurfaceFit::surface() const {
  return chart.cylindrical ? make_cylindrical_polynomial(chart.X_BS, terms, inside)
                           : make_polynomial(chart.X_BS, terms, inside);
}

std::optional<SurfaceFit> fit_surface(const Mesh& zone, const SurfaceFitOptions& options, const std::string& name,
                                      Diagnostics& out) {
  std::string why;
  auto fit = Fitter(zone, options).run(why);
  if (!fit) out.error(Code::no_surface, name, why);
  return fit;
}

}  // namespace genu
