// The numbers of a scene that can be varied, with a standard change for each, so that parameters of different kinds can
// be ranked.
#pragma once

#include <string>
#include <vector>

#include "genu/scene/scene.h"

namespace genu {

/// One number, named by its keys in the scene: "AAC.stiffness", "AAC.from.x", "AAC.via.1.x" (first via point),
/// "condyle.radii.z", "plateau.terms.2.0" (x^2 y^0), "femur_cartilage.offset", "push.force.z", "knee.flexion" (the
/// prescribed value). Where two names are equal, the prefix "ligament.", "surface.", "load.", "body.", "joint." or
/// "bushing." distinguishes them.
struct Parameter {
  enum class Kind {
    // of a ligament
    law_number,  ///< a row of the law's table (law/law_kind.h)
    slack_length,
    reference_strain,
    reference_force,
    damping,  ///< in motion
    from_point,
    to_point,
    via_point,  ///< component: 3 times the point's index + axis
    // of a surface
    surface_number,  ///< a row of the table of its shape (scene/surface_def.h)
    term,            ///< component: its index
    offset,          ///< the whole surface moved along its outward normal; no key of a scene
    // of a load
    load_number,     ///< a row of the table of its kind (scene/load_def.h)
    factor,          ///< the step's factor
    body_number,     ///< a row of scene/body_def.h
    joint_number,    ///< a row of the table of its type (scene/joint_def.h)
    bushing_number,  ///< a row of scene/bushing_def.h
    // of the steps
    prescribed
  };

  std::string name;
  Kind kind = Kind::law_number;
  int object = -1;       ///< index of the ligament, surface, load, body, joint or bushing
  int number = 0;        ///< row of the table
  int component = 0;     ///< 0 x, 1 y, 2 z; index of the term
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
  bool of_surface() const { return kind >= Kind::surface_number && kind <= Kind::offset; }
  bool of_load() const { return kind == Kind::load_number || kind == Kind::factor; }
  bool of_body() const { return kind == Kind::body_number; }
  bool of_joint() const { return kind == Kind::joint_number; }
  bool of_bushing() const { return kind == Kind::bushing_number; }
  /// The group of tables that has its object: "ligament"; empty for a prescribed value.
  const char* group() const;
};

/// All parameters of a scene in order: ligaments, surfaces, loads, weights, joints, bushings, prescribed values.
/// Numbers that the scene does not give are omitted, such as a slack length where a reference strain is given.
std::vector<Parameter> parameters_of(const SceneTables& scene);

/// The number (SI) in the scene; null where it is none: an offset, a load's factor in steps, a prescribed value.
double* parameter_number(SceneTables& scene, const Parameter& parameter);
/// The row of the table that a parameter names; null where it names none.
const NumberRow* parameter_row(const SceneTables& scene, const Parameter& parameter);

}  // namespace genu
