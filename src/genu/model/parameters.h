// The numbers of a scene that can be varied, with a standard change for each, so that parameters of different kinds can
// be ranked.
#pragma once

#include <string>
#include <vector>

#include "genu/scene/scene.h"

namespace genu {

/// One number, named by its keys in the scene: "AAC.stiffness", "AAC.from.x", "AAC.via.1.x" (first via point),
/// "condyle.radii.z", "plateau.terms.2.0" (x^2 y^0), "femur_cartilage.offset", "push.force.z", "knee.flexion" (the
/// prescribed value). Where two names are equal, the prefix "ligament.", "surface.", "load.", "body." or "joint."
/// distinguishes them.
struct Parameter {
  enum class Kind {
    // of a ligament
    law_number,  ///< component: its index in the table of the law's numbers (law/law_kind.h)
    slack_length,
    reference_strain,
    reference_force,
    damping,  ///< in motion
    from_point,
    to_point,
    via_point,  ///< component: 3 times the point's index + axis
    // of a surface
    radius,
    radii,
    major_radius,
    minor_radius,
    term,
    origin,
    offset,  ///< the whole surface moved along its outward normal; no key of a scene
    // of a load
    force,
    moment,
    point,
    toward_point,
    magnitude,  ///< toward: `magnitude`; on a coordinate: `value`
    factor,     ///< the step's factor
    // of a body with weight, or in motion
    mass,
    centre_of_mass,
    // of a revolute joint
    joint_stiffness,
    joint_damping,  ///< in motion
    // of the steps
    prescribed
  };

  std::string name;
  Kind kind = Kind::law_number;
  int object = -1;       ///< index of the ligament, surface, load, body or joint
  int component = 0;     ///< 0 x, 1 y, 2 z; index of the number or term
  QuantityRef quantity;  ///< prescribed
  std::string unit;      ///< unit in results: mm, deg, N, Nm, 1 ..., whatever the scene's units are
  double si = 1;         ///< SI per unit
  /// The standard change (SI): 1 % of a stiffness, slack length, mass or load factor; 1 mm of any other length; 0.01 of
  /// a strain; 1 N; 0.01 N m; 1 deg. For a term of a polynomial: the change that moves the surface by 1 mm at 10 mm
  /// from its origin (and theta = 1 rad).
  double change = 0;
  std::string change_text;  ///< "1 %", "1 mm", ...
  bool positive = false;    ///< a stiffness, damping, mass, ...: > 0, with a relative `change`

  bool of_ligament() const { return kind <= Kind::via_point; }
  bool of_surface() const { return kind >= Kind::radius && kind <= Kind::offset; }
  bool of_joint() const { return kind == Kind::joint_stiffness || kind == Kind::joint_damping; }
  bool of_load() const { return kind >= Kind::force && kind <= Kind::factor; }
};

/// All parameters of a scene in order: ligaments, surfaces, loads, weights, joints, prescribed values. Numbers that the
/// scene does not give are omitted, such as a slack length where a reference strain is given.
std::vector<Parameter> parameters_of(const SceneTables& scene);

}  // namespace genu
