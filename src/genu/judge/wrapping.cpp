#include "genu/judge/wrapping.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/judge/tolerances.h"

namespace genu::judge {
namespace {

/// A surface of the scene in the frame of its body: signed distance, about, foot and normal.
class Skin {
 public:
  Skin(const PoseCase& pose, int surface)
      : side_(pose.subject->sides[at(surface)]), def_(pose.scene().surfaces[at(surface)]) {}

  bool is_mesh() const { return side_.facets != nullptr; }
  double edge() const { return is_mesh() ? side_.facets->edge() : 0; }
  double outward() const { return def_.inside && !is_mesh() ? -1 : 1; }

  /// m, positive outside; empty far from a mesh.
  std::optional<double> gap(const Vec3& x) const {
    if (is_mesh()) {
      const auto near = side_.facets->nearest(x, kSkinReach * edge());
      return near ? std::optional(near->distance) : std::nullopt;
    }
    const Vec3 local = to_shape(x);
    return outward() * side_.shape->value(local) / side_.shape->gradient(local).norm();
  }

  std::optional<Vec3> foot(const Vec3& x) const {
    if (is_mesh()) {
      const auto near = side_.facets->nearest(x, kSkinReach * edge());
      return near ? std::optional(near->p) : std::nullopt;
    }
    const auto found = side_.shape->onto(to_shape(x));
    return found ? std::optional(Vec3(def_.placement * *found)) : std::nullopt;
  }

  /// Outward normal and how far (rad, m) it and the place are unsure.
  struct Lean {
    Vec3 normal;
    double turn = 0, distance = 0;
  };
  Lean lean(const Vec3& x) const {
    if (is_mesh()) {
      const Facets::Lean l = side_.facets->lean(x, kLeanReach * edge());
      return {l.normal, l.turn, l.distance};
    }
    return {def_.placement.R * (outward() * side_.shape->normal(to_shape(x)))};
  }

 private:
  Vec3 to_shape(const Vec3& x) const { return def_.placement.R.transpose() * (x - def_.placement.p); }

  const Side& side_;
  const SurfaceDef& def_;
};

struct Arc {
  double length = 0;
  Vec3 first = Vec3::Zero(), last = Vec3::Zero();  ///< directions at its ends
};

/// The geodesic between two points of a surface that leaves the first along `t0` and arrives along `t1`, about, as a
/// chain of `count` links: each point at the foot of the middle of its neighbours.
std::optional<Arc> chain(const Skin& skin, const Vec3& a, const Vec3& b, const Vec3& t0, const Vec3& t1, double written,
                         int count) {
  std::vector<Vec3> x;
  for (int i = 0; i <= count; ++i) {  // Hermite's cubic
    const double s = static_cast<double>(i) / count, r = 1 - s;
    x.push_back(r * r * (1 + 2 * s) * a + s * s * (1 + 2 * r) * b + s * r * written * (r * t0 - s * t1));
  }
  for (int i = 1; i < count; ++i) {
    const auto foot = skin.foot(x[at(i)]);
    if (!foot) return std::nullopt;
    x[at(i)] = *foot;
  }
  const double relaxation = 2 / (1 + std::sin(EIGEN_PI / count));
  for (int round = 0; round < kShorteningRounds * count; ++round) {
    double moved = 0;
    for (int i = 1; i < count; ++i) {
      const Vec3 old = x[at(i)];
      const auto foot = skin.foot(old + relaxation * (0.5 * (x[at(i - 1)] + x[at(i + 1)]) - old));
      if (!foot) return std::nullopt;
      x[at(i)] = *foot;
      moved = std::max(moved, (x[at(i)] - old).norm());
    }
    if (moved < kChainSettled * written) break;
  }
  Arc arc;
  for (int i = 0; i < count; ++i) arc.length += (x[at(i + 1)] - x[at(i)]).norm();
  // One-sided differences of second order.
  arc.first = (-3 * x[0] + 4 * x[1] - x[2]).normalized();
  arc.last = (3 * x[at(count)] - 4 * x[at(count - 1)] + x[at(count - 2)]).normalized();
  return arc;
}

class PathJudge {
 public:
  PathJudge(const PoseCase& pose, const std::string& name, const std::vector<WrapDef>& wraps)
      : pose_(pose), name_(name), wraps_(wraps), stems_(touch_stems(pose.scene(), name, wraps)) {}

  WrittenPath judge(const std::vector<PathEnd>& points) {
    std::size_t w = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      add(pose_.poses[at(points[k].body)] * points[k].point, points[k].body, false);
      for (; w < wraps_.size() && at(wraps_[w].after) == k; ++w) read_touch(w);
    }
    for (std::size_t k = 0; k + 1 < out_.points.size(); ++k)
      if (!out_.arc[k]) out_.length += (out_.points[k + 1] - out_.points[k]).norm();
    for (std::size_t k = 0; k + 1 < out_.points.size(); ++k)
      if (out_.arc[k]) judge_arc(k);
    judge_free();
    return std::move(out_);
  }

 private:
  void add(const Vec3& place, int body, bool arc) {
    out_.points.push_back(place);
    out_.bodies.push_back(body);
    out_.arc.push_back(arc);
  }

  const SurfaceDef& surface(std::size_t w) const { return pose_.scene().surfaces[at(wraps_[w].surface)]; }

  void read_touch(std::size_t w) {
    const std::string& stem = stems_[w];
    const double touches = pose_.row(stem + ".touches"), arc = pose_.row(stem + ".arc_mm");
    pose_.out->expect("touches are told", "", touches == 0 || touches == 1 ? 0 : 1, 0, stem);
    Vec3 place[2];
    for (const bool last : {false, true})
      for (Eigen::Index i = 0; i < 3; ++i)
        place[last][i] =
            units::kMillimetre * pose_.row(fmt::format("{}.{}.{}_mm", stem, last ? "end" : "begin", "xyz"[i]));
    if (touches != 1) {
      free_.push_back({w, out_.points.size() - 1});
      pose_.out->expect("arcs", "mm", std::abs(arc), 0, stem);
      return;
    }
    const Pose& X = pose_.poses[at(surface(w).body)];
    arcs_.push_back({w, stem, units::kMillimetre * arc});
    add(X * place[0], surface(w).body, true);
    add(X * place[1], surface(w).body, false);
  }

  /// The arc from point k to k + 1.
  void judge_arc(std::size_t k) {
    const Told& told = arcs_[next_++];
    const Skin skin(pose_, wraps_[told.wrap].surface);
    const Pose inverse = pose_.poses[at(surface(told.wrap).body)].inverse();
    const Vec3 a = inverse * out_.points[k], b = inverse * out_.points[k + 1];
    const Vec3 from = inverse * out_.points[k - 1], to = inverse * out_.points[k + 2];
    const Vec3 u = (a - from).normalized(), v = (to - b).normalized();
    out_.length += told.arc;
    const double tolerance = pose_.length_tolerance();
    for (const auto& [p, leg] : {std::pair(a, u), std::pair(b, v)}) {
      const Skin::Lean lean = skin.lean(p);
      const auto gap = skin.gap(p);
      pose_.out->expect("touching points on surfaces", "mm", gap ? to::kMillimetre * std::abs(*gap) : std::nan(""),
                        to::kMillimetre * (tolerance + lean.distance), told.stem);
      pose_.out->expect("legs along tangents", "rad", std::abs(leg.dot(lean.normal)), kLegTangent + lean.turn,
                        told.stem);
    }
    if (skin.is_mesh() && told.arc < 2 * skin.edge()) return void(out_.unsure += told.arc);
    if (told.arc < kShortestCourse * pose_.subject->size) return;  // too short to have a course
    const auto coarse = chain(skin, a, b, u, v, told.arc, kChainLinks);
    const auto fine = chain(skin, a, b, u, v, told.arc, 2 * kChainLinks);
    if (!coarse || !fine) return pose_.out->expect("arcs", "mm", std::nan(""), 0, told.stem);
    // The error of a chain falls with the square of its links.
    const double length = fine->length + (fine->length - coarse->length) / 3;
    const double bent = std::max(std::acos(std::clamp(fine->first.dot(u), -1.0, 1.0)),
                                 std::acos(std::clamp(fine->last.dot(v), -1.0, 1.0)));
    const Skin::Lean lean = skin.lean(a);
    const double unsure = kChainError * std::abs(fine->length - coarse->length) + lean.distance + tolerance;
    pose_.out->expect("arcs", "mm", to::kMillimetre * std::abs(length - told.arc), to::kMillimetre * unsure, told.stem);
    pose_.out->expect("legs continue arcs", "rad", bent, kLegCorner + 2 * lean.turn, told.stem);
    out_.length += length - told.arc;
    out_.unsure += unsure;
  }

  /// Lines between touching points stay out of the surfaces that they do not touch.
  void judge_free() {
    for (const Free& f : free_) {
      if (wraps_[f.wrap].ignore_inside) continue;
      const Skin skin(pose_, wraps_[f.wrap].surface);
      const Pose inverse = pose_.poses[at(surface(f.wrap).body)].inverse();
      const Vec3 a = inverse * out_.points[f.point], b = inverse * out_.points[f.point + 1];
      double least = 0, distance = 0;
      constexpr int kLooks = 200;
      for (int i = 0; i <= kLooks; ++i) {
        const Vec3 x = a + static_cast<double>(i) / kLooks * (b - a);
        const auto gap = skin.gap(x);
        if (!gap || *gap >= least) continue;
        least = *gap;
        distance = skin.lean(x).distance;
      }
      pose_.out->expect("free lines clear surfaces", "mm", to::kMillimetre * -least,
                        to::kMillimetre * (pose_.length_tolerance() + distance), name_ + "." + surface(f.wrap).name);
    }
  }

  struct Told {
    std::size_t wrap;
    std::string stem;
    double arc;  ///< m
  };
  struct Free {
    std::size_t wrap, point;  ///< it lies after this point
  };

  const PoseCase& pose_;
  const std::string& name_;
  const std::vector<WrapDef>& wraps_;
  std::vector<std::string> stems_;
  std::vector<Told> arcs_;
  std::size_t next_ = 0;
  std::vector<Free> free_;
  WrittenPath out_;
};

}  // namespace

std::vector<std::string> touch_stems(const Scene& scene, const std::string& name, const std::vector<WrapDef>& wraps) {
  std::vector<std::string> stems;
  std::map<std::string, int> seen;
  for (const WrapDef& wrap : wraps) {
    std::string stem = name + "." + scene.surfaces[at(wrap.surface)].name;
    if (const int before = seen[stem]++; before > 0) stem += fmt::format(".{}", before + 1);
    stems.push_back(stem);
  }
  return stems;
}

WrittenPath written_path(const PoseCase& pose, const std::string& name, const std::vector<PathEnd>& points,
                         const std::vector<WrapDef>& wraps) {
  return PathJudge(pose, name, wraps).judge(points);
}

void add_pulls(const WrittenPath& path, double force, PoseForces& forces) {
  for (std::size_t k = 0; k + 1 < path.points.size(); ++k) {
    const Vec3 way = path.points[k + 1] - path.points[k];
    if (path.arc[k] || path.bodies[k] == path.bodies[k + 1] || !(way.norm() > 0)) continue;
    const Vec3 pull = force * way.normalized();
    forces.forces.push_back({path.bodies[k], path.points[k], pull, Vec3::Zero()});
    forces.forces.push_back({path.bodies[k + 1], path.points[k + 1], -pull, Vec3::Zero()});
  }
}

}  // namespace genu::judge
