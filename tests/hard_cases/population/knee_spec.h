// A random knee as plain numbers: what is written as a scene for genu, and what the energy twin computes with.
// Lengths in mm, angles in deg, forces in N; tibia fixed, x lateral, y anterior, z proximal.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace genu::population {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

struct Frame {
  Vec3 origin = Vec3::Zero();
  Mat3 axes = Mat3::Identity();  ///< columns: the frame's x, y, z in the body
};

struct Shape {
  enum class Kind { plane, sphere, ellipsoid, torus, socket, polynomial, cylindrical };
  Kind kind = Kind::plane;
  Frame frame;
  Vec3 radii = Vec3::Zero();  ///< sphere, socket: x; torus: major, minor
  struct Term {
    int i, j;
    double c;
  };
  std::vector<Term> terms;  ///< polynomials
  std::string patch;        ///< as the scene has it, empty for none
  double mesh_edge = 0;     ///< > 0: cut into triangles, as a file
  double noise = 0;         ///< of the mesh's vertices, along the normal
};

struct Contact {
  std::string name;
  Shape femur, tibia;
};

/// What all contacts of the knee are made of: bone on bone, or elastic layers.
struct Cartilage {
  bool soft = false;
  double modulus = 5, poisson = 0.45, thickness = 4;  ///< MPa, 1, mm
  bool logarithmic = false;
};

struct Ligament {
  enum class Law { quadratic, linear, blankevoort, spring, table };
  Law law = Law::quadratic;
  Vec3 femur, tibia;
  double stiffness = 0;         ///< N; of a spring N/mm
  double reference_strain = 0;  ///< of a spring the force in the reference pose, N
  double transition = 0.06;
};

struct Force {
  Vec3 point, force;            ///< on the femur, constant in the world
  Vec3 moment = Vec3::Zero();   ///< N m
  double begins = 1, ends = 1;  ///< its factor over the last step
};

struct Knee {
  std::string kind;
  std::vector<Contact> contacts;
  Cartilage cartilage;
  std::vector<Ligament> ligaments;
  std::vector<Force> forces;
  double size = 1;                ///< of an average knee
  Vec3 reference = Vec3::Zero();  ///< translations of the reference pose
  bool flexion_last = false;      ///< rotations in the order rotation, adduction, flexion instead
  double flexion_from = 0, flexion_to = 60;
  bool prescribed = true;      ///< flexion; else the knee is free
  bool hold_rotation = false;  ///< rotation is prescribed at 0 too
  int increments = 10;
  std::string text;  ///< the whole scene, where it is not made of the above

  /// Whether the energy twin knows all of it: convex closed forms on planes, dead forces, one prescribed flexion.
  bool comparable() const;
  /// Whether a surface of it is cut into triangles.
  bool meshed() const;
};

}  // namespace genu::population
