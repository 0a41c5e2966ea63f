#include "genu/appraise/patella.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/appraise/groove.h"
#include "genu/appraise/place.h"
#include "genu/appraise/tolerances.h"
#include "genu/core/units.h"
#include "genu/model/grood_suntay.h"

namespace genu {
namespace {

using Events = std::vector<PathEvent>;

class Patella {
 public:
  Patella(const Prepared& prepared, std::size_t joint)
      : prepared_(prepared),
        joint_(joint),
        axes_(*prepared.scene.joints[joint].grood_suntay),
        lateral_((axes_.right ? 1 : -1) * axes_.femur.anterior.cross(axes_.femur.proximal)) {
    femur_ = points_of(axes_.femur.body, {});
    const Pose X_FP = in_femur(start_state(prepared.model).coordinates);
    patella_ = points_of(axes_.tibia.body, X_FP);
  }

  /// Where the path ends, or jumps, because the patella leaves its groove; empty elsewhere.
  /// `before`: coordinates of the row before it; null where it precedes all rows.
  std::string leaving(const Events& events, const PathEvent& event, const std::vector<JointValues>* before) const {
    const auto next = std::find_if(events.begin() + (&event - events.data()), events.end(),
                                   [](const PathEvent& e) { return e.kind == PathEvent::Kind::new_branch; });
    const bool rests = event.kind == PathEvent::Kind::snapped && next != events.end();
    std::optional<double> shift;
    if (before != nullptr) shift = sideways(*before, rests ? next->coordinates : event.coordinates, kLeastSubluxation);
    if (!shift) shift = slides(events, event);
    const auto there = motion(event.coordinates), rest = rests ? motion(next->coordinates) : std::nullopt;
    if (!shift || !there) return {};
    std::string out = fmt::format(
        "the patella subluxates at {}: it leaves its groove {}ly, at a lateral shift of {:.1f} mm and a lateral tilt "
        "of {:.1f} deg",
        place(prepared_, event.step, event.target), *shift > 0 ? "lateral" : "medial", to::kMillimetre * there->lateral,
        to::kDegree * there->external_rotation);
    if (rest)
      out += fmt::format(", and comes to rest at {:.1f} mm and {:.1f} deg", to::kMillimetre * rest->lateral,
                         to::kDegree * rest->external_rotation);
    return out;
  }

  /// In how many poses the patella's middle lies off the groove by more than kMostOffGroove of its width.
  std::string off_groove(const std::vector<PoseRecord>& records) const {
    const PosePoint* first = nullptr;
    PatellaAcross worst{0, 1, 0, 0};
    int poses = 0, solved = 0;
    for (const PoseRecord& record : records) {
      if (!record.point.solved()) continue;
      ++solved;
      const auto there = patella_across(femur_, patella_, in_femur(record.point.pose.state.coordinates), lateral_,
                                        axes_.tibia.anterior);
      if (!there || !(std::abs(there->offset()) > kMostOffGroove)) continue;
      if (poses++ == 0) first = &record.point;
      if (std::abs(there->offset()) > std::abs(worst.offset())) worst = *there;
    }
    if (first == nullptr) return {};
    return fmt::format(
        "the patella is out of its groove in {} of {} poses, first at {}: its middle lies up to {:.1f} mm {} of the "
        "groove, {:.0f} % of its width (limit {:g} %)",
        poses, solved, place(prepared_, first->step, first->target),
        to::kMillimetre * std::abs(worst.middle - worst.groove), worst.offset() > 0 ? "lateral" : "medial",
        100 * std::abs(worst.offset()), 100 * kMostOffGroove);
  }

  /// Where the patella's contact surface does not lie in front of the femur's.
  std::string wrong_side(const std::vector<JointValues>& coordinates, const char* verb) const {
    const std::vector<Pose> poses = poses_from_coordinates(prepared_.model, coordinates);
    const Pose& X_F = poses[at(axes_.femur.body)];
    const Pose X_FP = X_F.inverse() * poses[at(axes_.tibia.body)];
    const Vec3 lateral = (axes_.right ? 1 : -1) * axes_.femur.anterior.cross(axes_.femur.proximal);
    const Extent femur = extent(axes_.femur.body, {}, lateral), patella = extent(axes_.tibia.body, X_FP, lateral);
    if (!femur.known() || !patella.known()) return {};
    const double behind = femur.middle[0] - patella.middle[0];
    const double outside = std::abs(patella.middle[1] - femur.middle[1]) - femur.half_width;
    std::string where;
    if (behind > kSideEdge)
      where = fmt::format("{:.0f} mm behind the middle of the femur's contact surface", to::kMillimetre * behind);
    else if (outside > kSideEdge)
      where = fmt::format("{:.0f} mm {} of the femur's contact surface", to::kMillimetre * outside,
                          patella.middle[1] > femur.middle[1] ? "lateral" : "medial");
    if (where.empty()) return {};
    return fmt::format(
        "the patella {} on the wrong side: {}. The trochlea is in front of the femur: correct `start` of joint.{}, or "
        "`anterior` in its grood_suntay",
        verb, where, prepared_.scene.joints[joint_].name);
  }

 private:
  std::optional<KneeMotion> motion(const std::vector<JointValues>& coordinates) const {
    if (coordinates.empty()) return std::nullopt;
    const std::vector<Pose> poses = poses_from_coordinates(prepared_.model, coordinates);
    return grood_suntay(axes_, poses[at(axes_.femur.body)], poses[at(axes_.tibia.body)]);
  }

  /// m: how far the patella goes laterally, where its joint moves farther than `least` and than all others, and
  /// sideways above all.
  std::optional<double> sideways(const std::vector<JointValues>& from, const std::vector<JointValues>& to,
                                 double least) const {
    const auto way = [&](std::size_t j) {
      return Vec3(to[j][3] - from[j][3], to[j][4] - from[j][4], to[j][5] - from[j][5]);
    };
    const auto a = motion(from), b = motion(to);
    if (!a || !b) return std::nullopt;
    const double own = way(joint_).norm();
    if (!(own > least)) return std::nullopt;
    for (std::size_t j = 0; j < from.size(); ++j)
      if (j != joint_ && way(j).norm() >= own) return std::nullopt;
    const double shift = b->lateral - a->lateral;
    return std::abs(shift) >= kSidewaysShare * own ? std::optional(shift) : std::nullopt;
  }

  /// The same from the last pose before a limit point to the limit point, where the joint moves as it would snap.
  std::optional<double> slides(const Events& events, const PathEvent& limit) const {
    if (limit.kind != PathEvent::Kind::turns_back) return std::nullopt;
    const auto stop = std::find_if(events.begin() + (&limit - events.data()), events.end(),
                                   [](const PathEvent& e) { return e.kind == PathEvent::Kind::stopped; });
    if (stop == events.end() || stop->coordinates.empty()) return std::nullopt;
    return sideways(stop->coordinates, limit.coordinates, kLeastSlide);
  }

  /// Of the surfaces of a body in contact between the two, along anterior and lateral of the femur (m).
  struct Extent {
    double middle[2] = {0, 0};
    double half_width = -1;
    bool known() const { return half_width >= 0; }
  };

  Extent extent(int body, const Pose& X_FB, const Vec3& lateral) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double low[2] = {infinity, infinity}, high[2] = {-infinity, -infinity};
    for (const int surface : surfaces_of(body))
      for (const Vec3& p :
           prepared_.surfaces[at(surface)]->triangles(kSideEdge, X_FB.inverse().p, kSideReach).vertices) {
        const Vec3 x = X_FB * p;
        const double along[2] = {axes_.femur.anterior.dot(x), lateral.dot(x)};
        for (int i = 0; i < 2; ++i) {
          low[i] = std::min(low[i], along[i]);
          high[i] = std::max(high[i], along[i]);
        }
      }
    Extent out;
    if (!(low[0] <= high[0])) return out;
    for (int i = 0; i < 2; ++i) out.middle[i] = (low[i] + high[i]) / 2;
    out.half_width = (high[1] - low[1]) / 2;
    return out;
  }

  Pose in_femur(const std::vector<JointValues>& coordinates) const {
    const std::vector<Pose> poses = poses_from_coordinates(prepared_.model, coordinates);
    return poses[at(axes_.femur.body)].inverse() * poses[at(axes_.tibia.body)];
  }

  /// On the contact surfaces of a body, at most about kSideEdge apart.
  std::vector<Vec3> points_of(int body, const Pose& X_FB) const {
    std::vector<Vec3> out;
    for (const int surface : surfaces_of(body)) {
      const Mesh mesh = prepared_.surfaces[at(surface)]->triangles(kSideEdge, X_FB.inverse().p, kSideReach);
      out.insert(out.end(), mesh.vertices.begin(), mesh.vertices.end());
      for (const auto& t : mesh.triangles) {
        const Vec3 &a = mesh.vertices[at(t[0])], b = mesh.vertices[at(t[1])] - a, c = mesh.vertices[at(t[2])] - a;
        const double longest = std::max({b.norm(), c.norm(), (b - c).norm()});
        const int pieces = std::clamp(static_cast<int>(std::ceil(longest / kSideEdge)), 1, kMostSidePieces);
        for (int i = 0; pieces > 1 && i <= pieces; ++i)
          for (int k = 0; i + k <= pieces; ++k) out.push_back(a + (i * b + k * c) / pieces);
      }
    }
    return out;
  }

  std::vector<int> surfaces_of(int body) const {
    std::vector<int> out;
    const auto add = [&](const ContactDef& contact) {
      const int a = contact.surface_a, b = contact.surface_b;
      const int body_a = prepared_.scene.surfaces[at(a)].body, body_b = prepared_.scene.surfaces[at(b)].body;
      const int femur = axes_.femur.body, patella = axes_.tibia.body;
      if ((body_a != femur || body_b != patella) && (body_b != femur || body_a != patella)) return;
      out.push_back(body_a == body ? a : b);
    };
    for (const ContactDef& contact : prepared_.scene.contacts) add(contact);
    for (const LayerDef& layer : prepared_.scene.layers) add(layer.pair);
    return out;
  }

  const Prepared& prepared_;
  std::size_t joint_;
  const GroodSuntayDef& axes_;
  Vec3 lateral_;  ///< in the femur
  std::vector<Vec3> femur_, patella_;
};

bool ends_a_branch(const PathEvent& e) {
  return e.kind == PathEvent::Kind::turns_back || e.kind == PathEvent::Kind::snaps ||
         e.kind == PathEvent::Kind::snapped || e.kind == PathEvent::Kind::limit_point;
}

}  // namespace

std::vector<std::string> patella_sentences(const Prepared& prepared, const std::vector<PoseRecord>& records,
                                           const Events& events) {
  std::vector<std::string> out;
  const auto add = [&](std::string sentence) {
    if (!sentence.empty()) out.push_back(std::move(sentence));
  };
  for (std::size_t j = 0; j < prepared.scene.joints.size(); ++j) {
    const auto& axes = prepared.scene.joints[j].grood_suntay;
    if (!axes || !axes->patella || records.empty()) continue;
    const Patella patella(prepared, j);
    const PosePoint& first = records.front().point;
    std::string wrong = first.solved() ? patella.wrong_side(first.pose.state.coordinates, "lies")
                                       : patella.wrong_side(start_state(prepared.model).coordinates, "starts");
    if (wrong.empty()) add(patella.off_groove(records));
    add(std::move(wrong));
    for (const PathEvent& e : events) {
      const std::size_t rows = static_cast<std::size_t>(std::max(0, e.rows_before));
      if (!ends_a_branch(e) || rows > records.size() || (rows > 0 && !records[rows - 1].point.solved())) continue;
      add(patella.leaving(events, e, rows > 0 ? &records[rows - 1].point.pose.state.coordinates : nullptr));
    }
  }
  return out;
}

}  // namespace genu
