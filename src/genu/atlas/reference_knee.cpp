#include "genu/atlas/reference_knee.h"

#include <numbers>
#include <sstream>

#include "genu/atlas/reference_knee_text.h"

namespace genu {
namespace {

constexpr double kMillimetre = 1e-3;

void read_points(std::istream& in, ReferenceKnee& knee) {
  std::string bone, kind;
  std::size_t count = 0;
  in >> bone >> kind >> count;
  ReferenceKnee::Bone& of = bone == "femur" ? knee.femur : knee.tibia;
  std::vector<FacingPoint>& points =
      bone == "patella" ? knee.patella.cartilage : (kind == "bone" ? of.bone : of.cartilage);
  points.resize(count);
  for (FacingPoint& p : points) {
    for (double& x : p.at) in >> x;
    for (double& x : p.normal) in >> x;
    p.at *= kMillimetre / 100;
    p.normal.normalize();
  }
}

void read_plateau(std::istream& in, ReferenceKnee& knee) {
  std::string kind;
  in >> kind;
  ReferenceKnee::Plateau& plateau = kind == "bone" ? knee.bone : knee.cartilage;
  in >> plateau.width;
  for (double& x : plateau.centre) in >> x;
  plateau.width *= kMillimetre;
  plateau.centre *= kMillimetre;
}

void read_fibre(std::istream& in, ReferenceKnee& knee) {
  ReferenceFibre f;
  in >> f.name >> f.bundle >> f.stiffness >> f.transition >> f.strain >> f.slack;
  for (double& x : f.femur) in >> x;
  for (double& x : f.tibia) in >> x;
  f.slack *= kMillimetre;
  f.femur *= kMillimetre;
  f.tibia *= kMillimetre;
  knee.fibres.push_back(f);
}

Vec3 read_place(std::istream& in) {
  Vec3 place;
  for (double& x : place) in >> x;
  return kMillimetre * place;
}

void read_band(std::istream& in, ReferencePatella& patella) {
  PatellaFibre f;
  std::string from, to;
  in >> from >> to >> f.name >> f.bundle >> f.stiffness >> f.transition >> f.strain;
  f.to_tibia = to == "tibia";
  (from == "patella" ? f.patella : f.bone) = read_place(in);
  (from == "patella" ? f.bone : f.patella) = read_place(in);
  patella.fibres.push_back(f);
}

void read_cable(std::istream& in, ReferencePatella& patella) {
  QuadricepsCable c;
  in >> c.name >> c.tension;
  c.femur = read_place(in);
  c.patella = read_place(in);
  in >> c.radius;
  c.radius *= kMillimetre;
  c.centre = read_place(in);
  patella.quadriceps.push_back(c);
}

void read_pose(std::istream& in, ReferenceKnee& knee) {
  double angle[3];
  Vec3 shift;
  for (double& x : angle) in >> x;
  for (double& x : shift) in >> x;
  const auto turn = [&](int i, const Vec3& axis) { return Eigen::AngleAxisd(angle[i] * std::numbers::pi / 180, axis); };
  knee.flexion.emplace_back(Eigen::Translation3d(kMillimetre * shift) * turn(0, -Vec3::UnitZ()) *
                            turn(1, Vec3::UnitX()) * turn(2, Vec3::UnitY()));
}

ReferenceKnee read() {
  ReferenceKnee knee;
  std::istringstream in(reference_knee_text());
  for (std::string word; in >> word;) {
    if (word == "points") read_points(in, knee);
    if (word == "plateau") read_plateau(in, knee);
    if (word == "pose") read_pose(in, knee);
    if (word == "fibre") read_fibre(in, knee);
    if (word == "band") read_band(in, knee.patella);
    if (word == "cable") read_cable(in, knee.patella);
    if (word == "#") std::getline(in, word);
  }
  return knee;
}

}  // namespace

const ReferenceKnee& reference_knee() {
  static const ReferenceKnee knee = read();
  return knee;
}

}  // namespace genu
