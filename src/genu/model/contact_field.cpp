#include "genu/model/contact_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/contact/elastic_layer.h"
#include "genu/model/tolerances.h"

namespace genu {
namespace {

/// How far (m) what is missing may stand out of the points that stand for it: they lie on chords, and what bends about
/// as a condyle does stands out of a chord by this. 0 where the smooth surface reaches across: contact is found there.
double stands_out(const DoubtfulPlace& place) {
  Vec3 low = place.points[0], high = low;
  for (const Vec3& p : place.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double half = 0.5 * (high - low).norm();
  return half < place.reach ? 0 : half * half / (2 * kSaggingRadius);
}

/// Whether the contact at `feet`, each with its `size`, or the surface `other` itself, reaches a doubtful place. X_OS:
/// pose of the place's body in the frame of the other.
bool leans_on(const DoubtfulPlace& place, const std::vector<Vec3>& feet, const std::vector<double>& size,
              const Surface& other, const Pose& X_OS) {
  for (const Vec3& p : place.points)
    for (std::size_t k = 0; k < feet.size(); ++k)
      if ((p - feet[k]).norm() < place.reach + size[k]) return true;
  if (!place.missing) return false;
  const double out = stands_out(place);
  if (out == 0) return false;
  return std::any_of(place.points.begin(), place.points.end(), [&](const Vec3& p) {
    const Vec3 x = X_OS * p;
    const auto gap = other.gap(x);
    SurfacePoint foot;
    return gap && *gap<out&& * gap> - place.reach && other.project(x, foot) && other.edge_distance(foot.p) >= 0;
  });
}

}  // namespace

double sample_spacing(const JointModel& model) {
  double spacing = model.scales.length / 30;
  for (const auto& pair : model.pairs)
    for (const auto& surface : {pair.a, pair.b})
      if (!surface->is_unbounded()) spacing = std::min(spacing, box_diagonal(*surface, model.scales.length) / 60);
  return spacing;
}

ContactField::ContactField(const JointModel& model) : ContactField(model, nullptr) {}

ContactField::ContactField(const JointModel& model, const ContactField& prepared) : ContactField(model, &prepared) {}

ContactField::ContactField(const JointModel& model, const ContactField* prepared)
    : model_(&model),
      length_(model.scales.length),
      spacing_(spacing_of(model, prepared)),
      layers_(std::make_shared<LayerMemories>()) {
  pairs_.reserve(model.pairs.size());
  for (std::size_t k = 0; k < model.pairs.size(); ++k) {
    const auto& pair = model.pairs[k];
    const bool known = prepared != nullptr && k < prepared->pairs_.size();
    pairs_.push_back(proximity_of(pair, known ? &prepared->pairs_[k] : nullptr));
    any_doubtful_ = any_doubtful_ || !pair.a->doubtful().empty() || !pair.b->doubtful().empty();
  }
  layer_pairs_.resize(model.layers.size());
  for (const auto& layer : model.layers)
    any_doubtful_ = any_doubtful_ || !layer.a->doubtful().empty() || !layer.b->doubtful().empty();
}

/// sample_spacing(), which looks at every surface, unless that of `prepared` is known to be the same.
double ContactField::spacing_of(const JointModel& model, const ContactField* prepared) const {
  const bool alike =
      prepared != nullptr && prepared->length_ == length_ && prepared->pairs_.size() == model.pairs.size() &&
      std::equal(model.pairs.begin(), model.pairs.end(), prepared->pairs_.begin(),
                 [](const JointModel::Pair& pair, const Proximity& of) { return of.is_between(*pair.a, *pair.b); });
  return alike ? prepared->spacing_ : sample_spacing(model);
}

template <typename Meeting>
Proximity ContactField::proximity_of(const Meeting& surfaces, const Proximity* prepared) const {
  const Vec3 centre = joint_centre(*model_);
  Proximity::Options options;
  options.spacing = spacing_;
  options.reach = kSamplingReach * model_->scales.length;
  options.centre_a = model_->reference_poses[at(surfaces.body_a)].inverse() * centre;
  options.centre_b = model_->reference_poses[at(surfaces.body_b)].inverse() * centre;
  if (prepared == nullptr || !prepared->is_of(*surfaces.a, *surfaces.b, options))
    return {*surfaces.a, *surfaces.b, options};
  Proximity shared = *prepared;
  shared.forget();
  return shared;
}

void ContactField::forget() {
  for (Proximity& pair : pairs_) pair.forget();
  for (auto& pair : layer_pairs_)
    if (pair) pair->forget();
  layers_->each.clear();
  layers_->buried.clear();
}

std::optional<ContactField::BuriedLayer> ContactField::buried(const State& state) {
  for (int layer = 0; layer < static_cast<int>(model_->layers.size()); ++layer) {
    const auto& l = model_->layers[at(layer)];
    const Pose X_ab = state.poses[at(l.body_a)].inverse() * state.poses[at(l.body_b)];
    layers_->buried.resize(model_->layers.size());
    if (l.layer->buried() == nullptr || l.layer->buried()->deepest(X_ab, layers_->buried[at(layer)]) == 0) continue;
    // The back of an open sheet is not its inside; the search for rigid contacts makes that distinction.
    auto& pair = layer_pairs_[at(layer)];
    if (!pair) pair.emplace(proximity_of(l));
    ProximityScan scan;
    pair->scan(X_ab, window(), scan);
    const double depth = -std::min(scan.smallest_sample_gap, scan.swallowed);
    if (depth > l.search_depth) return BuriedLayer{layer, depth};
  }
  return std::nullopt;
}

Pose ContactField::relative(const State& state, int pair) const {
  const auto& p = model_->pairs[at(pair)];
  return state.poses[at(p.body_a)].inverse() * state.poses[at(p.body_b)];
}

void ContactField::survey(const State& state, Survey& out) {
  out.minima.clear();
  out.edges.clear();
  out.smallest_gap.assign(pairs_.size(), std::numeric_limits<double>::infinity());
  evaluate_effect(model_->meter.get(), Effect::contact_search, pairs_.size(), [&] { scan_pairs(state, out); });
}

void ContactField::scan_pairs(const State& state, Survey& out) {
  for (int pair = 0; pair < static_cast<int>(pairs_.size()); ++pair) {
    pairs_[at(pair)].scan(relative(state, pair), window(), scan_);
    double& smallest = out.smallest_gap[at(pair)];
    smallest = scan_.smallest_sample_gap;
    if (scan_.swallowed < 0) smallest = std::min(smallest, scan_.swallowed);
    for (const LocalMinimum& m : scan_.minima) {
      out.minima.push_back({pair, m});
      smallest = std::min(smallest, m.gap);
    }
    for (const LocalMinimum& m : scan_.edge) out.edges.push_back({pair, m});
  }
}

std::optional<Descent> ContactField::follow(const State& state, int pair, const ContactGeometry& contact) const {
  return pairs_[at(pair)].follow(relative(state, pair), contact);
}

void ContactField::probe_around(const State& state, int pair, const ContactGeometry& contact, double radius,
                                double steep, std::vector<LocalMinimum>& out) const {
  pairs_[at(pair)].probe_around(relative(state, pair), contact, radius, steep, out);
}

double ContactField::edge_distance(int pair, const ContactGeometry& contact) const {
  return pairs_[at(pair)].edge_distance(contact);
}

ContactField::Feet ContactField::feet_of_pair(const State& state, const std::vector<Candidate>& also, int pair) const {
  Feet feet;
  const auto add = [&](const ContactGeometry& contact) {
    feet.on_a.push_back(contact.a.p);
    feet.on_b.push_back(contact.b.p);
    feet.size.push_back(0);
  };
  for (const ActiveContact& c : state.contacts)
    if (c.pair == pair) add(c.geometry);
  for (const Candidate& c : also)
    if (c.pair == pair) add(c.minimum.contact);
  return feet;
}

ContactField::Feet ContactField::feet_of_layer(const State& state, int layer) {
  const auto& l = model_->layers[at(layer)];
  const Pose &X_Wa = state.poses[at(l.body_a)], &X_Wb = state.poses[at(l.body_b)];
  const Pose X_ab = X_Wa.inverse() * X_Wb, X_ba = X_ab.inverse();
  Feet feet;
  layers_->each.resize(model_->layers.size());
  for (std::size_t i = 0; i < l.layer->sides().size(); ++i) {
    const bool from_a = l.layer->sides()[i].a;
    const auto add = [&](const LayerPoint& point) {
      const Vec3 across = point.x - point.depth * point.n;
      feet.on_a.push_back(from_a ? point.x : X_ab * across);
      feet.on_b.push_back(from_a ? X_ba * across : point.x);
      feet.size.push_back(std::sqrt(point.area));
    };
    l.layer->visit(X_Wa, X_Wb, i, layers_->each[at(layer)], add, state.layer_level(at(layer)));
  }
  return feet;
}

template <typename Meeting>
const DoubtfulPlace* ContactField::doubtful_between(const Meeting& surfaces, const Pose& X_ab, const Feet& feet) {
  for (const DoubtfulPlace& place : surfaces.a->doubtful())
    if (leans_on(place, feet.on_a, feet.size, *surfaces.b, X_ab.inverse())) return &place;
  for (const DoubtfulPlace& place : surfaces.b->doubtful())
    if (leans_on(place, feet.on_b, feet.size, *surfaces.a, X_ab)) return &place;
  return nullptr;
}

const DoubtfulPlace* ContactField::doubtful(const State& state, const std::vector<Candidate>& also) {
  const auto flawed = [](const auto& meeting) {
    return !meeting.a->doubtful().empty() || !meeting.b->doubtful().empty();
  };
  for (int pair = 0; pair < static_cast<int>(model_->pairs.size()); ++pair) {
    const auto& p = model_->pairs[at(pair)];
    if (!flawed(p)) continue;
    if (const auto* place = doubtful_between(p, relative(state, pair), feet_of_pair(state, also, pair))) return place;
  }
  for (int layer = 0; layer < static_cast<int>(model_->layers.size()); ++layer) {
    const auto& l = model_->layers[at(layer)];
    if (!flawed(l)) continue;
    const Pose X_ab = state.poses[at(l.body_a)].inverse() * state.poses[at(l.body_b)];
    if (const auto* place = doubtful_between(l, X_ab, feet_of_layer(state, layer))) return place;
  }
  return nullptr;
}

double ContactField::smallest_gap(const State& state, int pair) {
  for (double within = window(); within < 100 * model_->scales.length; within *= 8) {
    pairs_[at(pair)].scan(relative(state, pair), within, scan_);
    double smallest = scan_.smallest_sample_gap;
    if (scan_.swallowed < 0) smallest = std::min(smallest, scan_.swallowed);
    for (const LocalMinimum& m : scan_.minima) smallest = std::min(smallest, m.gap);
    if (smallest < within) return smallest;
  }
  return std::numeric_limits<double>::infinity();
}

std::optional<LocalMinimum> ContactField::nearest(const State& state, int pair) {
  const double gap = smallest_gap(state, pair);
  const auto lowest = std::min_element(scan_.minima.begin(), scan_.minima.end(),
                                       [](const LocalMinimum& x, const LocalMinimum& y) { return x.gap < y.gap; });
  if (!std::isfinite(gap) || lowest == scan_.minima.end() || lowest->gap > gap) return std::nullopt;
  return *lowest;
}

bool ContactField::is_clear(const State& state, int pair, double gap) {
  pairs_[at(pair)].near_samples(relative(state, pair), gap, near_);
  return near_.empty();
}

double ContactField::motion(const State& from, const State& to, int pair) const {
  return pairs_[at(pair)].motion(relative(from, pair), relative(to, pair));
}

double ContactField::overlap(const State& state, int pair) {
  return std::max(0.0, -pairs_[at(pair)].smallest_sample_gap(relative(state, pair)));
}

double ContactField::add_foundation(const State& state, double modulus, Linearization& out) {
  double deepest = 0;
  for (int pair = 0; pair < static_cast<int>(pairs_.size()); ++pair) {
    const auto& p = model_->pairs[at(pair)];
    const bool b = pairs_[at(pair)].samples_b();
    const int sampled = b ? p.body_b : p.body_a, queried = b ? p.body_a : p.body_b;
    const Pose &X_s = state.poses[at(sampled)], &X_q = state.poses[at(queried)];
    pairs_[at(pair)].near_samples(relative(state, pair), 0, near_);
    Vec12 total = Vec12::Zero();
    Mat12 stiffness = Mat12::Zero();
    for (const NearSample& sample : near_) {
      deepest = std::max(deepest, -sample.gap);
      const Vec3 n = X_q.R * sample.direction;
      const Vec3 x = X_s * sample.point;
      Vec12 row;  // d gap / d [twist of queried; twist of sampled]
      row << -n, -(x - X_q.p).cross(n), n, (x - X_s.p).cross(n);
      total += modulus * sample.area * -sample.gap * row;
      stiffness -= modulus * sample.area * row * row.transpose();
    }
    const int moving[2] = {model_->bodies[at(queried)].moving, model_->bodies[at(sampled)].moving};
    for (int i = 0; i < 2; ++i) {
      if (moving[i] < 0) continue;
      out.wrench.segment<6>(6 * moving[i]) += total.segment<6>(6 * i);
      for (int j = 0; j < 2; ++j)
        if (moving[j] >= 0)
          out.stiffness.block<6, 6>(6 * moving[i], 6 * moving[j]) += stiffness.block<6, 6>(6 * i, 6 * j);
    }
  }
  return deepest;
}

}  // namespace genu
