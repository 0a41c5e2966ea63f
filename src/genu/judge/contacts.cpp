#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/judge/pose.h"
#include "genu/judge/tolerances.h"

namespace genu::judge {
namespace {

/// m, rad: what a mesh implies about the smooth surface near a point.
struct Seen {
  Vec3 normal = Vec3::UnitZ();  ///< world, outward
  double turn = 0, distance = 0;
};

/// A contact in the table: one of several of a pair, or the only one.
struct Written {
  std::string name;
  double force = 0, gap = 0;
  Vec3 a, b;  ///< m, in the bodies

  bool there() const { return a.allFinite() && b.allFinite() && std::isfinite(gap); }
  /// Whether only a part of its point's numbers is present.
  bool torn() const { return !there() && (a.array().isFinite().any() || b.array().isFinite().any()); }
};

class Contacts {
 public:
  Contacts(const PoseCase& pose, PoseForces& forces) : pose_(pose), scene_(pose.scene()), forces_(forces) {}

  void judge_pair(const ContactDef& pair) {
    pair_ = &pair;
    std::vector<Written> all;
    const Written total = written(pair.name);
    int k = 1;
    for (; pose_.row.has(fmt::format("{}.{}.force_N", pair.name, k)); ++k)
      if (const Written c = written(fmt::format("{}.{}", pair.name, k)); c.there())
        all.push_back(c);
      else
        expect_empty(c);
    const bool single = k == 1;
    if (single && total.there()) all.push_back(total);
    if (total.torn()) pose_.out->expect("contact points", "mm", std::nan(""), 0, total.name + " has empty cells");
    for (const Written& c : all) judge(c);
    if (!single && total.there() && total.force == 0) judge(total);  // open: the nearest points of the surfaces
    judge_total(total, all);
    for (const RegionDef& region : pair.regions) judge_region(region, all);
  }

 private:
  Written written(const std::string& name) const {
    Written w;
    w.name = name;
    w.force = pose_.row(name + ".force_N");
    w.gap = units::kMillimetre * pose_.row(name + ".gap_mm");
    for (const bool second : {false, true})
      for (Eigen::Index i = 0; i < 3; ++i) {
        const SurfaceDef& s = scene_.surfaces[at(second ? pair_->surface_b : pair_->surface_a)];
        (second ? w.b : w.a)[i] = units::kMillimetre * pose_.row(fmt::format("{}.{}.{}_mm", name, s.name, "xyz"[i]));
      }
    return w;
  }

  void expect_empty(const Written& c) {
    const bool empty = !std::isfinite(c.force) && !std::isfinite(c.gap) && !c.a.allFinite() && !c.b.allFinite();
    if (!empty) pose_.out->expect("contact points", "mm", std::nan(""), 0, c.name + " has empty cells");
  }

  /// The surface at a written point; checks the distance of the point from it.
  Seen look(const Written& c, bool second, bool closed) {
    const int k = second ? pair_->surface_b : pair_->surface_a;
    const SurfaceDef& def = scene_.surfaces[at(k)];
    const Side& side = pose_.subject->sides[at(k)];
    const Vec3& p = second ? c.b : c.a;
    const Mat3& R = pose_.poses[at(def.body)].R;
    // An open contact ends a search that is only as accurate as gaps are.
    const double sure = pose_.length_tolerance() + (closed ? 0 : 1e-8);
    const std::string name = c.name + " on " + def.name;
    Seen seen;
    if (side.shape) {
      const Vec3 local = def.placement.R.transpose() * (p - def.placement.p);
      seen.normal = R * (def.placement.R * side.shape->normal(local));
      pose_.out->expect("contact points on surfaces", "mm",
                        to::kMillimetre * std::abs(side.shape->value(local)) / side.shape->gradient(local).norm(),
                        to::kMillimetre * sure, name);
      pose_.out->expect("contact points in patches", "mm", to::kMillimetre * side.shape->beyond_patch(local),
                        to::kMillimetre * (1e-6 + sure), name);
      return seen;
    }
    const Facets::Lean lean = side.facets->lean(p, kLeanReach * side.facets->edge());
    const auto nearest = side.facets->nearest(p, 10 * side.facets->edge());
    seen = {R * lean.normal, lean.turn, lean.distance};
    pose_.out->expect("contact points near triangles", "mm",
                      nearest ? to::kMillimetre * std::abs(nearest->distance) : std::nan(""),
                      to::kMillimetre * (lean.distance + sure), name);
    return seen;
  }

  void judge(const Written& c) {
    const bool closed = c.force != 0;
    const Seen a = look(c, false, closed), b = look(c, true, closed);
    const Pose& X_a = pose_.poses[at(body(false))];
    const Pose& X_b = pose_.poses[at(body(true))];
    const Vec3 at_a = X_a * c.a, at_b = X_b * c.b;
    const double sure = pose_.length_tolerance();
    pose_.out->expect("contact forces press", "N", std::isfinite(c.force) ? std::max(0.0, -c.force) : c.force,
                      pose_.subject->least_force, c.name);
    if (closed) {
      pose_.out->expect("closed contacts coincide", "mm", to::kMillimetre * (at_a - at_b).norm(),
                        to::kMillimetre * sure, c.name);
      pose_.out->expect("closed contacts coincide", "mm", to::kMillimetre * std::abs(c.gap), to::kMillimetre * sure,
                        c.name);
    } else {
      pose_.out->expect("gaps of open contacts", "mm",
                        to::kMillimetre * std::abs((at_a - at_b).norm() - std::abs(c.gap)),
                        to::kMillimetre * (1e-9 + sure), c.name);
    }
    const double apart = std::atan2(a.normal.cross(-b.normal).norm(), a.normal.dot(-b.normal));
    // A contact of two rounded points turns by their rounding over the radii; 1e-7 rad covers the smallest radius.
    const double straight = closed ? 1e-7 + 10 * pose_.slack : 1e-4;
    pose_.out->expect("normals oppose", "deg", to::kDegree * apart, to::kDegree * (straight + a.turn + b.turn), c.name);
    if (closed) add_force(c, 0.5 * (at_a + at_b), a, b);
  }

  void add_force(const Written& c, const Vec3& point, const Seen& a, const Seen& b) {
    const bool exact_a = shape(false), exact_b = shape(true);
    if (!exact_a && !exact_b) {
      forces_.loose.push_back({body(false), body(true), point, c.force, a.normal, b.normal, a.turn, b.turn, c.name});
      return;
    }
    const Vec3 n = exact_a && exact_b ? Vec3((b.normal - a.normal).normalized()) : exact_b ? b.normal : Vec3(-a.normal);
    forces_.forces.push_back({body(false), point, c.force * n, Vec3::Zero()});
    forces_.forces.push_back({body(true), point, -c.force * n, Vec3::Zero()});
  }

  /// The pair's own columns: sums, and the mean of the points by force.
  void judge_total(const Written& total, const std::vector<Written>& all) {
    double force = 0;
    Vec3 a = Vec3::Zero(), b = Vec3::Zero();
    double reach = 0;
    for (const Written& c : all) {
      force += c.force;
      a += c.force * c.a;
      b += c.force * c.b;
      reach = std::max({reach, c.a.norm(), c.b.norm()});
    }
    pose_.out->expect("sums over contacts", "N", std::abs(total.force - force), 1e-11 * (1 + force), pair_->name);
    if (!(force > 0)) return;
    const double off = std::max((a / force - total.a).norm(), (b / force - total.b).norm());
    pose_.out->expect("centres of contact", "mm", to::kMillimetre * off, to::kMillimetre * 1e-11 * (1 + reach),
                      pair_->name);
  }

  void judge_region(const RegionDef& region, const std::vector<Written>& all) {
    double force = 0, points = 0;
    Vec3 centre = Vec3::Zero();
    for (const Written& c : all) {
      if (!(c.force > 0) || !region.contains(c.b)) continue;
      force += c.force;
      centre += c.force * c.b;
      ++points;
    }
    const std::string name = pair_->name + "." + region.name;
    pose_.out->expect("sums over contacts", "N", std::abs(pose_.row(name + ".force_N") - force), 1e-11 * (1 + force),
                      name);
    pose_.out->expect("sums over contacts", "N", std::abs(pose_.row(name + ".points") - points), 0, name + ".points");
    if (!(force > 0)) return;
    Vec3 written;
    for (Eigen::Index i = 0; i < 3; ++i)
      written[i] = units::kMillimetre * pose_.row(fmt::format("{}.{}_mm", name, "xyz"[i]));
    pose_.out->expect("centres of contact", "mm", to::kMillimetre * (written - centre / force).norm(),
                      to::kMillimetre * 1e-11 * (1 + centre.norm() / force), name);
  }

  int body(bool second) const { return scene_.surfaces[at(second ? pair_->surface_b : pair_->surface_a)].body; }
  bool shape(bool second) const {
    return pose_.subject->sides[at(second ? pair_->surface_b : pair_->surface_a)].shape.has_value();
  }

  const PoseCase& pose_;
  const Scene& scene_;
  PoseForces& forces_;
  const ContactDef* pair_ = nullptr;
};

}  // namespace

void check_contacts(const PoseCase& pose, PoseForces& forces) {
  Contacts contacts(pose, forces);
  for (const ContactDef& pair : pose.scene().contacts) contacts.judge_pair(pair);
}

}  // namespace genu::judge
