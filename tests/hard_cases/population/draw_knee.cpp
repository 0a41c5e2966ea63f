#include "hard_cases/population/draw_knee.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "hard_cases/population/measured_knee.h"
#include "hard_cases/population/random_source.h"

namespace genu::population {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Vec3 scatter(RandomSource& random, double spread) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return spread * Vec3(x, y, z);
}

Mat3 tilt(RandomSource& random, double degrees) {
  const Vec3 turn = scatter(random, degrees * kDegree);
  const double angle = turn.norm();
  return angle > 0 ? Mat3(Eigen::AngleAxisd(angle, turn / angle)) : Mat3::Identity();
}

/// Columns y, z, x of the body: a shape of revolution whose axis is the body's x.
Mat3 across() {
  Mat3 axes;
  axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  return axes;
}

/// Where ligaments of a knee run, per unit of its size (Dortmans' reconstructed ones): femur, tibia, stiffness,
/// reference strain.
struct Course {
  Vec3 femur, tibia;
  double stiffness, strain;
};

const std::vector<Course>& courses() {
  static const std::vector<Course> list = {{{12.25, -7.84, 0}, {-6.04, 4, -3}, 37200, -0.0175},
                                           {{2, -9, -5}, {1.93, -0.59, -3}, 27000, 0.0597},
                                           {{-8.43, 14, -6.75}, {-0.4, -18.19, -15}, 18900, -0.008},
                                           {{-8.42, 1.85, 2.08}, {-1.63, -23.73, -8.99}, 11800, 0.015},
                                           {{40.04, 2.73, 6.64}, {34.89, -11, -43.7}, 19400, 0.0589},
                                           {{-37.75, 5, 2.12}, {-23.55, 6.43, -61.78}, 43100, -0.0239},
                                           {{-35.48, 0.29, 8.28}, {-30.86, -11.48, -58.06}, 23000, 0.0625}};
  return list;
}

Ligament draw_ligament(RandomSource& random, const Course& course, double size, bool any_law) {
  Ligament out;
  out.femur = size * course.femur + scatter(random, 2 * size);
  out.tibia = size * course.tibia + scatter(random, 2 * size);
  out.stiffness = course.stiffness * random.log_uniform(0.4, 2.5);
  out.reference_strain = course.strain + 0.015 * random.normal();
  if (!any_law) return out;
  out.law = static_cast<Ligament::Law>(random.integer(0, 4));
  if (out.law == Ligament::Law::linear) out.stiffness *= 0.1;
  if (out.law == Ligament::Law::blankevoort) out.stiffness *= 0.1, out.transition = random.uniform(0.02, 0.08);
  if (out.law == Ligament::Law::spring) {
    out.stiffness = random.log_uniform(0.5, 20);
    const double most = 0.3 * out.stiffness * (out.femur - out.tibia).norm();
    out.reference_strain = random.unit() * std::min(60.0, most);  // N
  }
  return out;
}

void draw_ligaments(RandomSource& random, double size, Knee& knee) {
  const bool any_law = random.chance(0.5);
  for (const Course& course : courses()) {
    if (random.chance(0.08)) continue;  // torn
    for (int strands = random.chance(0.15) ? 2 : 1; strands > 0; --strands)
      knee.ligaments.push_back(draw_ligament(random, course, size, any_law));
  }
}

void draw_forces(RandomSource& random, double size, Knee& knee) {
  const auto slanted = [&](double force) { return Vec3(tilt(random, 4) * Vec3(0, 0, -force)); };
  if (random.chance(0.75)) {
    Force body;
    body.point = scatter(random, 3 * size);
    body.force = slanted(random.log_uniform(20, 800) * size * size);
    knee.forces.push_back(body);
  }
  if (random.chance(0.3)) {
    Force drawer;
    drawer.point = scatter(random, 5 * size);
    drawer.force = Vec3(0, random.uniform(-80, 80), 0) * size;
    drawer.begins = 0;
    knee.forces.push_back(drawer);
  }
  if (random.chance(0.25)) {
    Force twist;
    twist.point = twist.force = Vec3::Zero();
    const double axial = random.uniform(-3, 3);
    twist.moment = Vec3(0, random.uniform(-3, 3), axial) * size;
    twist.begins = 0;
    knee.forces.push_back(twist);
  }
}

/// A femoral condyle that touches the height 0 with its centre at `height`.
Shape draw_condyle(RandomSource& random, double x, double size, int which, double& height) {
  Shape out;
  out.frame.origin = Vec3(x, random.uniform(-1, 1) * size, 0);
  if (which == 0) {
    out.kind = Shape::Kind::torus;
    const double minor = random.uniform(3, 8);
    out.radii = Vec3(random.uniform(11, 19), minor, 0) * size;
    out.frame.axes = tilt(random, 4) * across();
    height = out.radii.x() + out.radii.y();
  } else if (which == 1) {
    out.kind = Shape::Kind::ellipsoid;
    const double height_radius = random.uniform(15, 24), depth_radius = random.uniform(16, 26);
    out.radii = Vec3(random.uniform(8, 16), depth_radius, height_radius) * size;
    out.frame.axes = tilt(random, 4);
    height = out.radii.z();
  } else if (which == 2) {
    out.kind = Shape::Kind::sphere;
    out.radii = Vec3::Constant(random.uniform(12, 24) * size);
    height = out.radii.x();
  } else {
    out.kind = Shape::Kind::cylindrical;
    const double r = random.uniform(17, 23) * size;
    out.frame.axes << 0, 0, 1, 0, 1, 0, -1, 0, 0;  // theta from distal toward anterior, z along the body's x
    out.terms = {{0, 0, r},
                 {1, 0, random.uniform(-1, 1.5) * size},
                 {2, 0, random.uniform(-0.6, 0.2) * size},
                 {0, 1, random.uniform(-0.03, 0.03)},
                 {0, 2, -random.uniform(0.012, 0.03) / size}};
    out.patch = "{ theta = [-130, 40], z = [-" + std::to_string(13 * size) + ", " + std::to_string(13 * size) + "] }";
    height = r;
  }
  return out;
}

Shape draw_plateau(RandomSource& random, double x, double size, int which, double condyle) {
  Shape out;
  out.frame.origin = Vec3(x, 0, random.uniform(-0.5, 0.5) * size);
  out.frame.axes = tilt(random, 3);
  if (which == 1) {
    out.kind = Shape::Kind::socket;
    const double radius = condyle * random.log_uniform(1.15, 6);
    out.radii = Vec3::Constant(radius);
    out.frame.origin.z() += radius;
    out.frame.axes = Mat3::Identity();
  } else if (which == 2) {
    out.kind = Shape::Kind::polynomial;
    out.terms = {{1, 0, random.uniform(-0.03, 0.03)},
                 {2, 0, random.uniform(-0.002, 0.012) / size},
                 {1, 1, random.uniform(-0.001, 0.001) / size},
                 {0, 2, random.uniform(-0.008, 0.012) / size},
                 {0, 3, random.uniform(-4e-5, 4e-5) / (size * size)}};
    const std::string half_x = std::to_string(15 * size), half_y = std::to_string(26 * size);
    out.patch = "{ x = [-" + half_x + ", " + half_x + "], y = [-" + half_y + ", " + half_y + "] }";
  }
  return out;
}

void cut_into_triangles(RandomSource& random, double size, Knee& knee) {
  const double edge = random.log_uniform(1, 3) * size;
  const double noise = random.chance(0.4) ? random.log_uniform(1e-4, 0.03) * edge : 0;
  for (Contact& contact : knee.contacts) {
    contact.femur.mesh_edge = edge;
    contact.femur.noise = noise;
    if (contact.tibia.kind == Shape::Kind::polynomial && random.chance(0.5)) contact.tibia.mesh_edge = edge;
  }
}

void draw_course(RandomSource& random, Knee& knee) {
  knee.flexion_last = random.chance(0.3);
  knee.flexion_to = random.uniform(15, 80);
  knee.increments = static_cast<int>(knee.flexion_to / random.uniform(1, 6)) + 1;
  const double what = random.unit();
  if (what < 0.1) {
    knee.prescribed = false;
  } else if (what < 0.3) {
    knee.hold_rotation = true;
  }
}

}  // namespace

bool Knee::comparable() const {
  if (!prescribed || hold_rotation || cartilage.soft || contacts.empty()) return false;
  for (const Contact& c : contacts) {
    const bool convex = c.femur.kind == Shape::Kind::torus || c.femur.kind == Shape::Kind::ellipsoid ||
                        c.femur.kind == Shape::Kind::sphere;
    if (!convex || c.tibia.kind != Shape::Kind::plane || c.femur.mesh_edge > 0) return false;
  }
  for (const Ligament& l : ligaments)
    if (l.law == Ligament::Law::table) return false;
  for (const Force& f : forces)
    if (!f.moment.isZero(0)) return false;
  return true;
}

bool Knee::meshed() const {
  return std::any_of(contacts.begin(), contacts.end(),
                     [](const Contact& c) { return c.femur.mesh_edge > 0 || c.tibia.mesh_edge > 0; });
}

Knee draw_knee(std::uint64_t seed, int index, const std::string& data) {
  RandomSource random(seed, index);
  Knee knee;
  const double size = random.log_uniform(0.5, 1.8);
  const double kind = random.unit();
  const bool hip = kind < 0.06;
  if (kind > 0.99 && !data.empty()) return draw_measured_knee(random);
  const bool meshed = random.chance(0.3);
  knee.cartilage.soft = random.chance(0.06);
  const int condyle = random.integer(0, 3), plateau = random.integer(0, 2);
  static const char* const kCondyles[] = {"torus", "ellipsoid", "sphere", "polynomial"};
  static const char* const kPlateaus[] = {"plane", "socket", "polynomial"};
  knee.kind = std::string(kCondyles[condyle]) + " on " + kPlateaus[plateau];
  double height = 0;
  const double apart = random.uniform(17, 27) * size;
  for (const double side : {-1.0, 1.0}) {
    if (hip && side > 0) break;
    Contact contact;
    double at = 0;
    contact.name = side < 0 ? "medial" : "lateral";
    contact.femur = draw_condyle(random, hip ? 0 : side * apart, size, condyle, at);
    contact.tibia = draw_plateau(random, hip ? 0 : side * apart, size, plateau, at);
    height = std::max(height, at);
    knee.contacts.push_back(contact);
  }
  if (hip) knee.kind += ", one";
  if (meshed) {
    cut_into_triangles(random, size, knee);
    knee.kind += ", meshed";
  }
  if (knee.cartilage.soft) {
    knee.cartilage.modulus = random.log_uniform(1, 50);
    knee.cartilage.poisson = random.uniform(0.3, 0.47);
    knee.cartilage.thickness = random.uniform(2, 6) * size;
    knee.cartilage.logarithmic = random.chance(0.3);
    knee.kind += ", layers";
  }
  knee.size = size;
  knee.reference = Vec3(0, 2 * size, height);
  draw_ligaments(random, size, knee);
  draw_forces(random, size, knee);
  draw_course(random, knee);
  if (knee.cartilage.soft) {  // sums over smooth layers take long
    knee.flexion_to = std::min(knee.flexion_to, 15.0);
    knee.increments = std::min(knee.increments, 3);
  }
  return knee;
}

}  // namespace genu::population
