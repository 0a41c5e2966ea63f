#include "genu/new_scene/new_landmarks.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "genu/atlas/fitted_knee.h"
#include "genu/landmarks/landmark_file.h"
#include "genu/landmarks/landmark_frame.h"
#include "genu/landmarks/landmark_names.h"
#include "genu/mesh/nearest_point.h"
#include "genu/new_scene/fit_doubts.h"
#include "genu/new_scene/new_numbers.h"
#include "genu/new_scene/tolerances.h"
#include "genu/scene/words.h"

namespace genu {
namespace {

struct NamedPoint {
  Landmark point;
  LandmarkMeaning meaning;
};

bool is_numbered(const std::string& name) {
  return std::any_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// Those that mean something; a warning for each other one, the first with what is known.
std::vector<NamedPoint> understood(const std::vector<Landmark>& points, Diagnostics& out) {
  std::vector<NamedPoint> found;
  std::vector<const Landmark*> unknown;
  for (const Landmark& point : points)
    if (auto meaning = meaning_of(point.name))
      found.push_back({point, std::move(*meaning)});
    else
      unknown.push_back(&point);
  for (const Landmark* point : unknown) {
    const std::string known = point == unknown.front() ? ". Known are " + known_landmarks() : "";
    const std::string rule = "is no landmark that is known, and is not used" + known;
    const std::string name = with_quotes(point->name);
    out.add(found.empty() ? error_at(point->place, Code::unknown_name, "name", name, rule)
                          : warning_at(point->place, Code::unknown_name, "name", name, rule));
  }
  return found;
}

/// Points of one landmark have a number each; two of one meaning without are a mistake.
void refuse_contradictions(const std::vector<NamedPoint>& points, KneeLandmarks& landmarks, Diagnostics& out) {
  std::map<std::string, const NamedPoint*> first, of_bundle;
  for (const NamedPoint& p : points) {
    const auto refuse_it = [&](Code code, const std::string& rule) {
      out.add(error_at(p.point.place, code, "name", with_quotes(p.point.name), rule));
    };
    const auto [known, is_new] = first.emplace(p.meaning.name, &p);
    if (!is_new && !(is_numbered(p.point.name) && is_numbered(known->second->point.name)))
      refuse_it(Code::duplicate, fmt::format("means the same as {}: number several points of one landmark",
                                             with_quotes(known->second->point.name)));
    for (const std::string& bundle : p.meaning.bundles) {
      const auto [other, alone] = of_bundle.emplace(bundle + (p.meaning.femur ? " femur" : " tibia"), &p);
      if (!alone && is_new && other->second->meaning.name != p.meaning.name)
        refuse_it(Code::conflict, "places a bundle that " + with_quotes(other->second->point.name) + " places, too");
    }
    if (p.meaning.left && landmarks.left && *p.meaning.left != *landmarks.left)
      refuse_it(Code::conflict, fmt::format("is of a {} knee, and names before it are of a {} one",
                                            *p.meaning.left ? "left" : "right", *landmarks.left ? "left" : "right"));
    if (p.meaning.left) landmarks.left = p.meaning.left;
  }
}

double distance_to(const Mesh& mesh, const Vec3& x) { return (nearest_on_mesh(mesh, x) - x).norm(); }

bool lies_on_bone(const LandmarkMeaning& meaning) {
  using Kind = LandmarkMeaning::Kind;
  return meaning.kind == Kind::ligament_end
             ? !meaning.fibula
             : meaning.kind == Kind::medial_epicondyle || meaning.kind == Kind::lateral_epicondyle;
}

/// How far the points that are on a bone are off both, turned so: the mean. m
double off_bones(const std::vector<NamedPoint>& points, const Mat3& turn, const Mesh& femur, const Mesh& tibia) {
  double sum = 0;
  int count = 0;
  for (const NamedPoint& p : points)
    if (lies_on_bone(p.meaning)) {
      const Vec3 x = turn * p.point.at;
      sum += std::min(distance_to(femur, x), distance_to(tibia, x));
      ++count;
    }
  return count > 0 ? sum / count : 0;
}

/// What takes the points into the frame of the meshes. Where both files name theirs, that is known; else points are
/// taken as they are, unless they are near the bones the other way alone.
Mat3 turn_into(const std::string& meshes, const std::string& space, const std::vector<NamedPoint>& points,
               const Mesh& femur, const Mesh& tibia, std::string& how) {
  if (space.empty() || space == meshes) return Mat3::Identity();
  if (!meshes.empty()) {
    how = fmt::format("turned from {} to {}, which the meshes name", space, meshes);
    return turn_between(space, meshes);
  }
  const std::string other = space == "LPS" ? "RAS" : "LPS";
  Mat3 turn = turn_between(space, other);
  const double as_is = off_bones(points, Mat3::Identity(), femur, tibia),
               turned = off_bones(points, turn, femur, tibia);
  if (!(turned < kFrameFits * as_is)) return Mat3::Identity();
  how = fmt::format("turned from {} to {}: the meshes name no frame, and so they are {} mm off the bones, else {}",
                    space, other, tenths(turned), tenths(as_is));
  return turn;
}

/// The mean of the points of each landmark.
void gather(const std::vector<NamedPoint>& points, const Mat3& turn, double chosen_error, KneeLandmarks& landmarks) {
  struct Sum {
    Vec3 at = Vec3::Zero();
    double error = 0;
    int count = 0;
    const NamedPoint* first = nullptr;
  };
  std::map<std::string, Sum> sums;
  for (const NamedPoint& p : points) {
    Sum& sum = sums[p.meaning.name];
    sum.at += turn * p.point.at;
    sum.error += p.point.error.value_or(chosen_error);
    ++sum.count;
    if (!sum.first) sum.first = &p;
  }
  for (const auto& [name, sum] : sums) {
    landmarks.where[name] = sum.first->point.place;
    const Vec3 middle = sum.at / sum.count;
    const LandmarkMeaning& meaning = sum.first->meaning;
    if (meaning.kind == LandmarkMeaning::Kind::ligament_end)
      landmarks.ends.push_back({name, meaning.bundles, meaning.femur, middle, sum.error / sum.count});
    else
      landmarks.places[name] = middle;
  }
}

/// The axis of the files that is nearest to a direction.
Vec3 axis_near(const Vec3& direction) {
  Eigen::Index most = 0;
  direction.cwiseAbs().maxCoeff(&most);
  return (direction[most] < 0 ? -1.0 : 1.0) * Vec3::Unit(most);
}

void doubt_end(const GivenEnd& end, const FilePlace& where, const Mesh& femur, const Mesh& tibia,
               const FittedKnee& fitted, Diagnostics& out) {
  const auto doubt = [&](const std::string& rule) {
    out.add(warning_at(where, Code::layout, "name", with_quotes(end.name), rule));
  };
  const FittedBone& bone = end.femur ? fitted.femur : fitted.tibia;
  const double off = distance_to(end.femur ? femur : tibia, end.at);
  const bool fibula = end.name.ends_with("fibula");
  if (!fibula && !bone.articular && off > kLandmarkOff) {
    const double other = distance_to(end.femur ? tibia : femur, end.at);
    return doubt(fmt::format("lies {} mm off the {}, and {} mm off the {}. Look at its name, unit and frame",
                             tenths(off), end.femur ? "femur" : "tibia", tenths(other), end.femur ? "tibia" : "femur"));
  }
  if (bone.poor()) return;
  const double aside = (middle_of(bone, end.bundles) - end.at).norm();
  double error = 0;
  for (std::size_t i = 0; i < bone.insertions.size(); ++i)
    if (reference_knee().fibres[i].bundle == end.bundles.front()) error = bone.insertions[i].error;
  if (aside > kLandmarkDoubt * std::hypot(error, end.error))
    doubt(fmt::format("lies {} mm from where the reference knee has it. Is it this ligament's?", tenths(aside)));
}

}  // namespace

const Vec3* KneeLandmarks::place(const std::string& name) const {
  const auto found = places.find(name);
  return found == places.end() ? nullptr : &found->second;
}

std::optional<Vec3> KneeLandmarks::across() const {
  const Vec3 *medial = place("medial epicondyle"), *lateral = place("lateral epicondyle");
  if (!medial || !lateral) return std::nullopt;
  return Vec3(*lateral - *medial);
}

std::optional<Vec3> KneeLandmarks::proximal() const {
  const Vec3 *hip = place("hip centre"), *knee = place("knee centre"), *ankle = place("ankle centre");
  const Vec3 *up = hip ? hip : knee, *down = ankle ? ankle : knee;
  if (!up || !down || up == down) return std::nullopt;
  return axis_near(*up - *down);
}

std::optional<bool> KneeLandmarks::left_by_epicondyles(const KneeLayout& knee) const {
  const auto line = across();
  if (!line) return std::nullopt;
  return line->dot(knee.right) < 0;
}

std::optional<KneeLandmarks> read_knee_landmarks(const AskedLandmarks& asked, const Mesh& femur, const Mesh& tibia,
                                                 Diagnostics& out) {
  const auto file = read_landmarks(asked.file, asked.unit, out);
  if (!file) return std::nullopt;
  KneeLandmarks landmarks;
  const std::vector<NamedPoint> points = understood(file->points, out);
  refuse_contradictions(points, landmarks, out);
  if (out.has_errors()) return std::nullopt;
  const Mat3 turn = turn_into(asked.space, file->space, points, femur, tibia, landmarks.turned);
  gather(points, turn, asked.error > 0 ? asked.error : kLandmarkError, landmarks);
  return landmarks;
}

void doubt_landmarks(const KneeLandmarks& landmarks, const Mesh& femur, const Mesh& tibia, const KneeLayout& knee,
                     bool left, Diagnostics& out) {
  for (const char* name : {"medial epicondyle", "lateral epicondyle"})
    if (const Vec3* at = landmarks.place(name); at && distance_to(femur, *at) > kLandmarkOff)
      out.add(warning_at(
          landmarks.where.at(name), Code::layout, "name", with_quotes(name),
          fmt::format("lies {} mm off the femur. Look at its unit and frame", tenths(distance_to(femur, *at)))));
  if (const auto line = landmarks.across(); line && std::abs(line->normalized().dot(knee.right)) < kEpicondylesAside)
    out.add(warning_at(landmarks.where.at("lateral epicondyle"), Code::layout, "name", "\"lateral epicondyle\"",
                       fmt::format("is not beside the medial one: proximal is {}, anterior {}",
                                   axis_word(knee.proximal), axis_word(knee.anterior))));
  if (landmarks.ends.empty()) return;
  KneeLayout alone = knee;
  alone.given.clear();
  const FittedKnee fitted = fit_reference_knee(femur, tibia, axes_of(alone, left));
  for (const GivenEnd& end : landmarks.ends) doubt_end(end, landmarks.where.at(end.name), femur, tibia, fitted, out);
  if (fitted.femur.poor() || fitted.tibia.poor())
    out.add(
        warning_at(landmarks.where.begin()->second, Code::no_effect, {}, {},
                   "the ends of ligaments are not used: they move fibres of the reference knee, which does not fit"));
}

std::map<std::string, std::string> clinical_words(const KneeLandmarks& landmarks, const KneeLayout& knee,
                                                  const KneeFrames& frames, bool left) {
  const auto line = landmarks.across();
  const Vec3 *hip = landmarks.place("hip centre"), *ankle = landmarks.place("ankle centre");
  const Vec3* centre = landmarks.place("knee centre");
  Vec3 middle = centre ? *centre : knee.centre;
  if (line && !centre) middle = *landmarks.place("medial epicondyle") + 0.5 * *line;
  KneeFrames known = frames;
  if (hip) known.femur_proximal = (*hip - middle).normalized();
  if (line) known.femur_anterior = known.femur_proximal.cross(left ? Vec3(-*line) : *line).normalized();
  if (ankle) known.tibia_proximal = (middle - *ankle).normalized();
  std::map<std::string, std::string> out = frame_words(known, left);
  out["femur_origin"] = point_text(centre || line ? middle : Vec3(knee.centre + knee.gap * knee.proximal));
  out["tibia_origin"] = point_text(centre ? middle : knee.centre);
  return out;
}

std::string landmarks_choice(const KneeLandmarks& landmarks, const std::string& file) {
  std::string names;
  double low = 1, high = 0;
  for (const GivenEnd& end : landmarks.ends) {
    names += (names.empty() ? "" : ", ") + end.name;
    low = std::min(low, end.error);
    high = std::max(high, end.error);
  }
  if (!names.empty())
    names += low == high ? fmt::format(" (known to {} mm)", tenths(low))
                         : fmt::format(" (known to {} to {} mm)", tenths(low), tenths(high));
  for (const auto& [name, at] : landmarks.places) names += (names.empty() ? "" : ", ") + name;
  return fmt::format("landmarks   {}: {}{}", printable(file), names,
                     landmarks.turned.empty() ? "" : "; " + landmarks.turned);
}

}  // namespace genu
