#include "genu/osim/path_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace genu::osim {
namespace {

/// How near a point is to an obstacle, in its frame: 1 on its surface, less inside.
double nearness(const WrapObject& w, const Vec3& p) {
  switch (w.kind) {
    case WrapObject::Kind::ellipsoid:
      return p.cwiseQuotient(w.radii).norm();
    case WrapObject::Kind::cylinder:
      return std::hypot(std::hypot(p.x(), p.y()) / w.radius, std::max(0.0, std::abs(p.z()) - w.length / 2) / w.radius);
    case WrapObject::Kind::sphere:
      return p.norm() / w.radius;
    case WrapObject::Kind::torus:
      return std::hypot(std::hypot(p.x(), p.y()) - w.ring, p.z()) / w.radius;
  }
  return 0;
}

/// The least nearness along a straight line.
double nearness_of_line(const WrapObject& w, const Vec3& from, const Vec3& to) {
  constexpr int kSamples = 64;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= kSamples; ++k) least = std::min(least, nearness(w, from + (to - from) * k / kSamples));
  return least;
}

class Planner {
 public:
  Planner(const Model& model, const Skeleton& skeleton) : model_(model), skeleton_(skeleton) {}

  PathPlan plan(const GeometryPath& path) {
    for (std::size_t k = 0; k < path.points.size() && plan_.problem.empty(); ++k) add_point(path.points[k], k);
    if (plan_.problem.empty() && plan_.points.size() < 2) plan_.problem = "has fewer than two points at this pose";
    for (std::size_t k = 0; k < path.wraps.size() && plan_.problem.empty(); ++k) add_wrap(path.wraps[k]);
    std::stable_sort(plan_.wraps.begin(), plan_.wraps.end(),
                     [](const PathPlan::Wrap& a, const PathPlan::Wrap& b) { return a.after < b.after; });
    return std::move(plan_);
  }

 private:
  void add_point(const PathPoint& point, std::size_t number) {
    const PlacedFrame placed = skeleton_.frame(point.frame);
    if (point.condition) {
      const double q = skeleton_.value(point.condition->coordinate);
      if (skeleton_.moves(point.condition->coordinate))
        plan_.remarks.push_back(
            fmt::format("its point {} comes and goes with {} in the model, here it is as at the pose of the import",
                        point.name, point.condition->coordinate));
      if (q < point.condition->from || q > point.condition->to) return;
    }
    Vec3 location = point.location;
    if (point.moving)
      for (int i = 0; i < 3; ++i) {
        const std::string& c = point.moving->coordinates[at(i)];
        location[i] = point.moving->functions[at(i)](skeleton_.value(c));
        if (i == 0 && skeleton_.moves(c))
          plan_.remarks.push_back(fmt::format(
              "its point {} moves with {} in the model, here it is fixed as at the pose of the import", point.name, c));
      }
    plan_.points.push_back({skeleton_.rigid_body(placed.body), skeleton_.in_rigid(placed) * location});
    numbers_.push_back(static_cast<int>(number) + 1);
  }

  void add_wrap(const PathWrap& wrap) {
    const auto object = std::find_if(model_.wraps.begin(), model_.wraps.end(),
                                     [&](const WrapObject& w) { return w.name == last_name(wrap.object); });
    if (object == model_.wraps.end()) {
      plan_.problem = "wraps round " + wrap.object + ", which is no wrap object that genu has";
      return;
    }
    if (!object->active) {
      plan_.remarks.push_back("its wrap object " + object->name + " is not active in the model");
      return;
    }
    std::vector<std::size_t> allowed;
    for (std::size_t k = 0; k + 1 < plan_.points.size(); ++k)
      if ((wrap.first < 1 || numbers_[k] >= wrap.first) && (wrap.last < 1 || numbers_[k + 1] <= wrap.last))
        allowed.push_back(k);
    if (allowed.empty()) {
      plan_.remarks.push_back("its wrap object " + object->name + " counts between none of its points");
      return;
    }
    const auto nearest = std::min_element(allowed.begin(), allowed.end(), [&](std::size_t a, std::size_t b) {
      return nearness_between(*object, a) < nearness_between(*object, b);
    });
    plan_.wraps.push_back({&*object, *nearest});
  }

  double nearness_between(const WrapObject& w, std::size_t k) const {
    const PlacedWrap placed = place_wrap(skeleton_, w);
    const Pose X_wrap_ground = (skeleton_.rigid_in_ground(placed.rigid) * placed.X_rigid_wrap).inverse();
    const auto in_wrap = [&](const PathPlan::Point& p) {
      return Vec3(X_wrap_ground * (skeleton_.rigid_in_ground(p.rigid) * p.point));
    };
    return nearness_of_line(w, in_wrap(plan_.points[k]), in_wrap(plan_.points[k + 1]));
  }

  const Model& model_;
  const Skeleton& skeleton_;
  PathPlan plan_;
  std::vector<int> numbers_;  ///< of the points, as the file counts them
};

}  // namespace

bool PathPlan::crosses() const {
  return std::any_of(points.begin(), points.end(), [&](const Point& p) { return p.rigid != points.front().rigid; });
}

PathPlan plan_path(const Model& model, const Skeleton& skeleton, const GeometryPath& path) {
  return Planner(model, skeleton).plan(path);
}

PlacedWrap place_wrap(const Skeleton& skeleton, const WrapObject& object) {
  const PlacedFrame placed = skeleton.frame(object.frame);
  return {skeleton.rigid_body(placed.body), skeleton.in_rigid(placed) * object.X_body_wrap};
}

}  // namespace genu::osim
