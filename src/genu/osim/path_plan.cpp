#include "genu/osim/path_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

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

/// Where a straight line comes nearest to an obstacle.
struct NearestOnLine {
  double nearness = std::numeric_limits<double>::infinity();
  double along = 0;  ///< 0 at its first point, 1 at its second
};

NearestOnLine nearest_on_line(const WrapObject& w, const Vec3& from, const Vec3& to) {
  constexpr int kSamples = 64, kThirds = 40;
  const auto there = [&](double along) { return nearness(w, from + (to - from) * along); };
  NearestOnLine found;
  for (int k = 0; k <= kSamples; ++k) {
    const double along = static_cast<double>(k) / kSamples, here = there(along);
    if (here < found.nearness) found = {here, along};
  }
  double low = std::max(0.0, found.along - 1.0 / kSamples), high = std::min(1.0, found.along + 1.0 / kSamples);
  for (int k = 0; k < kThirds; ++k) {
    const double third = (high - low) / 3;
    const bool below = there(low + third) < there(high - third);
    (below ? high : low) += below ? -third : third;
  }
  found.along = (low + high) / 2;
  return found;
}

class Planner {
 public:
  Planner(const Model& model, const Skeleton& skeleton) : model_(model), skeleton_(skeleton) {}

  PathPlan plan(const GeometryPath& path) {
    for (std::size_t k = 0; k < path.points.size() && plan_.problem.empty(); ++k) add_point(path.points[k], k);
    if (plan_.problem.empty() && plan_.points.size() < 2) plan_.problem = "has fewer than two points at this pose";
    for (std::size_t k = 0; k < path.wraps.size() && plan_.problem.empty(); ++k) add_wrap(path.wraps[k]);
    std::stable_sort(plan_.wraps.begin(), plan_.wraps.end(), [](const PathPlan::Wrap& a, const PathPlan::Wrap& b) {
      return a.after != b.after ? a.after < b.after : a.along < b.along;
    });
    tell_order();
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
    if (point.moving) location = moved(point);
    plan_.points.push_back({skeleton_.rigid_body(placed.body), skeleton_.in_rigid(placed) * location});
    numbers_.push_back(static_cast<int>(number) + 1);
  }

  Vec3 moved(const PathPoint& point) {
    Vec3 location;
    std::set<std::string> movers;
    for (int i = 0; i < 3; ++i) {
      const std::string& c = point.moving->coordinates[at(i)];
      location[i] = point.moving->functions[at(i)](skeleton_.value(c));
      if (skeleton_.moves(c) && point.moving->functions[at(i)].kind != Function::Kind::constant) movers.insert(c);
    }
    for (const std::string& c : movers)
      plan_.remarks.push_back(
          fmt::format("WARNING: its point {} moves with {} in the model, here it is fixed as at the pose of the import",
                      point.name, c));
    return location;
  }

  /// Says so where the order of wraps is not the model's to give.
  void tell_order() {
    std::map<std::size_t, std::string> names;
    std::set<std::size_t> several;
    for (const PathPlan::Wrap& w : plan_.wraps) {
      std::string& text = names[w.after];
      if (!text.empty()) several.insert(w.after);
      text += (text.empty() ? "" : ", ") + w.object->name;
    }
    for (const std::size_t after : several)
      plan_.remarks.push_back("wraps round " + names[after] +
                              " in the order in which the straight line between its points comes nearest to them");
  }

  void add_wrap(const PathWrap& wrap) {
    const auto called = [&](const WrapObject& w) { return w.name == last_name(wrap.object); };
    const auto object = std::find_if(model_.wraps.begin(), model_.wraps.end(), called);
    if (object == model_.wraps.end()) {
      plan_.problem = "wraps round " + wrap.object + ", which is no wrap object that genu has";
      return;
    }
    if (std::any_of(object + 1, model_.wraps.end(), called))
      plan_.remarks.push_back("WARNING: several wrap objects are called " + object->name + ": the first is taken, of " +
                              object->frame);
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
    const int rigid = place_wrap(skeleton_, *object).rigid;
    NearestOnLine nearest;
    PathPlan::Wrap planned{&*object, allowed.front(), 0, rigid};
    for (const std::size_t k : allowed)
      if (const NearestOnLine here = nearest_between(*object, k); here.nearness < nearest.nearness) {
        nearest = here;
        planned.after = k;
      }
    planned.along = nearest.along;
    plan_.wraps.push_back(planned);
  }

  NearestOnLine nearest_between(const WrapObject& w, std::size_t k) const {
    const PlacedWrap placed = place_wrap(skeleton_, w);
    const Pose X_wrap_ground = (skeleton_.rigid_in_ground(placed.rigid) * placed.X_rigid_wrap).inverse();
    const auto in_wrap = [&](const PathPlan::Point& p) {
      return Vec3(X_wrap_ground * (skeleton_.rigid_in_ground(p.rigid) * p.point));
    };
    return nearest_on_line(w, in_wrap(plan_.points[k]), in_wrap(plan_.points[k + 1]));
  }

  const Model& model_;
  const Skeleton& skeleton_;
  PathPlan plan_;
  std::vector<int> numbers_;  ///< of the points, as the file counts them
};

}  // namespace

bool PathPlan::crosses() const {
  const auto elsewhere = [&](const auto& part) { return part.rigid != points.front().rigid; };
  return std::any_of(points.begin(), points.end(), elsewhere) || std::any_of(wraps.begin(), wraps.end(), elsewhere);
}

PathPlan plan_path(const Model& model, const Skeleton& skeleton, const GeometryPath& path) {
  return Planner(model, skeleton).plan(path);
}

PlacedWrap place_wrap(const Skeleton& skeleton, const WrapObject& object) {
  const PlacedFrame placed = skeleton.frame(object.frame);
  return {skeleton.rigid_body(placed.body), skeleton.in_rigid(placed) * object.X_body_wrap};
}

}  // namespace genu::osim
