#include "genu/scene/leave_out_bodies.h"

#include <algorithm>

#include "genu/scene/words.h"

namespace genu {
namespace {

/// Where the elements of a list are once some are gone: -1 for those.
class Renumbered {
 public:
  /// Erases the elements that go(element, index) names.
  template <class Defs, class Go>
  Renumbered(Defs& defs, const Go& go) {
    int next = 0;
    for (std::size_t k = 0; k < defs.size(); ++k) now_.push_back(go(defs[k], static_cast<int>(k)) ? -1 : next++);
    std::size_t k = 0;
    std::erase_if(defs, [&](const auto&) { return now_[k++] < 0; });
  }

  /// References below 0 mean nothing, and keep.
  bool gone(int index) const { return index >= 0 && now_[at(index)] < 0; }
  void renumber(int& index) const {
    if (index >= 0) index = now_[at(index)];
  }

 private:
  std::vector<int> now_;
};

class LeaveOut {
 public:
  LeaveOut(SceneTables& scene, const std::vector<int>& bodies)
      : scene_(scene),
        bodies_(scene.bodies,
                [&](const BodyDef&, int b) { return std::find(bodies.begin(), bodies.end(), b) != bodies.end(); }),
        joints_(scene.joints, [&](const JointDef& j, int) { return bodies_.gone(j.parent) || bodies_.gone(j.child); }),
        surfaces_(scene.surfaces, [&](const SurfaceDef& s, int) { return bodies_.gone(s.body); }),
        combinations_(scene.combinations, [&](const CombinationDef& c, int) {
          return std::any_of(c.terms.begin(), c.terms.end(), [&](const auto& t) { return gone(t.coordinate); });
        }) {}

  void run() {
    joints();
    contacts();
    ligaments();
    std::erase_if(scene_.bushings,
                  [&](const BushingDef& b) { return bodies_.gone(b.from.body) || bodies_.gone(b.to.body); });
    for (BushingDef& b : scene_.bushings)
      for (int* body : {&b.from.body, &b.to.body}) bodies_.renumber(*body);
    loads();
    if (scene_.dynamics) motion(*scene_.dynamics);
  }

  /// A quantity of a step that loses every load that drives it; null where there is none. Before run().
  const QuantityRef* undriven() const {
    for (const StepDef& step : scene_.steps)
      for (const StepDef::Prescribed& p : step.prescribe)
        if (!p.drivers.empty() && !gone(p.coordinate) &&
            std::all_of(p.drivers.begin(), p.drivers.end(), [&](int load) { return gone(scene_.loads[at(load)]); }))
          return &p.coordinate;
    return nullptr;
  }

 private:
  bool gone(const CoordinateRef& c) const { return joints_.gone(c.joint); }
  bool gone(const QuantityRef& q) const {
    return q.combination >= 0 ? combinations_.gone(q.combination) : gone(q.first);
  }
  void renumber(CoordinateRef& c) const { joints_.renumber(c.joint); }
  void renumber(QuantityRef& q) const {
    renumber(q.first);
    combinations_.renumber(q.combination);
  }

  void joints() {
    for (JointDef& j : scene_.joints) {
      bodies_.renumber(j.parent);
      bodies_.renumber(j.child);
      auto& axes = j.grood_suntay;
      if (axes && (bodies_.gone(axes->femur.body) || bodies_.gone(axes->tibia.body))) axes.reset();
      if (!axes) continue;
      bodies_.renumber(axes->femur.body);
      bodies_.renumber(axes->tibia.body);
    }
    for (SurfaceDef& s : scene_.surfaces) bodies_.renumber(s.body);
    for (CombinationDef& c : scene_.combinations)
      for (auto& term : c.terms) renumber(term.coordinate);
    std::erase_if(scene_.moment_arms, [&](const CoordinateRef& c) { return gone(c); });
    for (CoordinateRef& c : scene_.moment_arms) renumber(c);
  }

  bool gone(const ContactDef& c) const { return surfaces_.gone(c.surface_a) || surfaces_.gone(c.surface_b); }
  void renumber(ContactDef& c) const {
    surfaces_.renumber(c.surface_a);
    surfaces_.renumber(c.surface_b);
  }

  void contacts() {
    const auto no_longer = [&](const std::string& name) {
      const std::string contact = name.substr(0, name.find('.'));
      const auto is = [&](const ContactDef& c) { return c.name == contact; };
      return std::none_of(scene_.contacts.begin(), scene_.contacts.end(), is) &&
             std::none_of(scene_.layers.begin(), scene_.layers.end(), [&](const LayerDef& l) { return is(l.pair); });
    };
    std::erase_if(scene_.contacts, [&](const ContactDef& c) { return gone(c); });
    std::erase_if(scene_.layers, [&](const LayerDef& l) { return gone(l.pair); });
    for (ContactDef& c : scene_.contacts) renumber(c);
    for (LayerDef& l : scene_.layers) {
      renumber(l.pair);
      surfaces_.renumber(l.cast_from);
    }
    for (CompartmentDef& c : scene_.compartments)
      for (auto* names : {&c.direct, &c.meniscal}) std::erase_if(*names, no_longer);
  }

  bool gone(const std::vector<WrapDef>& wraps) const {
    return std::any_of(wraps.begin(), wraps.end(), [&](const WrapDef& w) { return surfaces_.gone(w.surface); });
  }
  void renumber(std::vector<WrapDef>& wraps) const {
    for (WrapDef& w : wraps) surfaces_.renumber(w.surface);
  }

  void ligaments() {
    const Renumbered now(scene_.ligaments, [&](const LigamentDef& l, int) {
      bool on = gone(l.wraps);
      LigamentDef::for_each_end(l, [&](const PathEnd& end) { on = on || bodies_.gone(end.body); });
      return on;
    });
    for (LigamentDef& l : scene_.ligaments) {
      LigamentDef::for_each_end(l, [&](PathEnd& end) { bodies_.renumber(end.body); });
      renumber(l.wraps);
    }
    for (BundleDef& bundle : scene_.bundles) {
      std::erase_if(bundle.members, [&](int member) { return now.gone(member); });
      for (int& member : bundle.members) now.renumber(member);
    }
  }

  bool gone(const LoadDef& l) const {
    return bodies_.gone(l.body) || bodies_.gone(l.toward_body) || gone(l.wraps) ||
           (l.kind == LoadDef::Kind::coordinate && gone(l.coordinate)) || (l.scale && gone(l.scale->coordinate)) ||
           std::any_of(l.points.begin(), l.points.end(), [&](const PathEnd& end) { return bodies_.gone(end.body); });
  }

  void loads() {
    const Renumbered now(scene_.loads, [&](const LoadDef& l, int) { return gone(l); });
    for (LoadDef& l : scene_.loads) {
      bodies_.renumber(l.body);
      bodies_.renumber(l.toward_body);
      renumber(l.coordinate);
      if (l.scale) renumber(l.scale->coordinate);
      for (PathEnd& end : l.points) bodies_.renumber(end.body);
      renumber(l.wraps);
    }
    for (StepDef& step : scene_.steps) {
      std::erase_if(step.prescribe, [&](const auto& p) { return gone(p.coordinate); });
      for (auto& p : step.prescribe) {
        renumber(p.coordinate);
        std::erase_if(p.drivers, [&](int load) { return now.gone(load); });
        for (int& load : p.drivers) now.renumber(load);
      }
      std::erase_if(step.factors, [&](const auto& f) { return now.gone(f.load); });
      for (auto& f : step.factors) now.renumber(f.load);
    }
  }

  void motion(DynamicsDef& dynamics) {
    std::erase_if(dynamics.start_rates, [&](const auto& r) { return gone(r.coordinate); });
    for (auto& r : dynamics.start_rates) renumber(r.coordinate);
    std::erase_if(dynamics.prescribe, [&](const auto& d) { return gone(d.quantity); });
    for (auto& d : dynamics.prescribe) {
      renumber(d.quantity);
      renumber(d.course.coordinate);
    }
  }

  SceneTables& scene_;
  Renumbered bodies_, joints_, surfaces_, combinations_;
};

}  // namespace

std::optional<BodyThatStays> cannot_leave_out(const SceneTables& scene, const std::vector<int>& bodies) {
  if (bodies.empty()) return std::nullopt;
  const auto goes = [&](int body) { return std::find(bodies.begin(), bodies.end(), body) != bodies.end(); };
  for (const int body : bodies)
    if (scene.bodies[at(body)].fixed) return BodyThatStays{body, "is fixed: a scene needs its fixed body"};
  for (const JointDef& j : scene.joints)
    if (goes(j.parent) && !goes(j.child))
      return BodyThatStays{j.parent,
                           "carries " + scene.bodies[at(j.child)].name + " by " + j.name + ": leave that out too"};
  const auto moves = [&](std::size_t b) { return !scene.bodies[b].fixed && !goes(static_cast<int>(b)); };
  bool any = false;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) any = any || moves(b);
  if (!any) return BodyThatStays{bodies.front(), "is the last body that moves"};
  SceneTables rest = scene;
  if (const QuantityRef* quantity = LeaveOut(rest, bodies).undriven())
    return BodyThatStays{bodies.front(), "takes all loads that drive " + quantity_name(scene, *quantity) +
                                             ": leave out drive as well, and a reaction holds it"};
  return std::nullopt;
}

bool means_body(const std::string& pattern, const std::string& name) {
  return pattern == name || (pattern.starts_with("body.") && matches(pattern, "body." + name));
}

void leave_out_bodies(SceneTables& scene, const std::vector<int>& bodies) {
  if (!bodies.empty()) LeaveOut(scene, bodies).run();
}

}  // namespace genu
