#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "genu/osim/frames.h"
#include "genu/osim/read_parts.h"

namespace genu::osim {
namespace {

/// Joints with fixed axes, as their coordinates move them: "x", "y", "z" rotate, "X", "Y", "Z" translate.
struct PlainJoint {
  const char* type;
  const char* moves;  ///< of its coordinates in order
};
constexpr PlainJoint kPlainJoints[] = {{"WeldJoint", ""},        {"PinJoint", "z"},      {"SliderJoint", "X"},
                                       {"UniversalJoint", "xy"}, {"BallJoint", "xyz"},   {"GimbalJoint", "xyz"},
                                       {"PlanarJoint", "zXY"},   {"FreeJoint", "xyzXYZ"}};

Vec3 unit(int axis) { return Vec3::Unit(axis); }

/// Axes of no motion, in the order of x, y, z.
void rest(Joint& joint) {
  for (int i = 0; i < 3; ++i) joint.rotations[at(i)] = joint.translations[at(i)] = {{}, unit(i), {}, joint.where};
}

void read_coordinates(const FileReader& reader, const XmlElement& e, Joint& joint) {
  const XmlElement* list = e.child("coordinates");
  if (list == nullptr) return;
  for (const XmlElement& c : list->children) {
    if (c.tag != "Coordinate") continue;
    const PropertyReader p(reader, c);
    Coordinate coordinate{c.name(), p.number("default_value", 0), p.flag("locked", false), false, c.where};
    const XmlElement* course = c.child("prescribed_function");
    coordinate.prescribed = !coordinate.locked && p.flag("prescribed", false) && course && !course->children.empty();
    if (coordinate.prescribed) coordinate.default_value = p.function(*course)(0);
    joint.coordinates.push_back(std::move(coordinate));
  }
}

/// Rotations of a plain joint come one after the other as its coordinates do, also where the first is about z.
void move_plainly(const PropertyReader& p, const std::string& moves, Joint& joint) {
  if (joint.coordinates.size() != moves.size()) {
    p.refuse(Code::wrong_form, joint.where, "coordinates", fmt::format("{}", joint.coordinates.size()),
             fmt::format("a {} has {} coordinates", joint.type, moves.size()));
    return;
  }
  std::size_t rotation = 0;
  for (std::size_t k = 0; k < moves.size(); ++k) {
    const bool turns = moves[k] >= 'a';
    const int axis = turns ? moves[k] - 'x' : moves[k] - 'X';
    Function line;
    line.kind = Function::Kind::linear;
    line.coefficients = {1, 0};
    (turns ? joint.rotations[rotation++] : joint.translations[at(axis)]) = {joint.coordinates[k].name, unit(axis), line,
                                                                            joint.where};
  }
}

/// The place of a TransformAxis: rotation1 to translation3; -1 for another name.
int place_of_axis(const std::string& name) {
  constexpr std::array kAxisNames = {"rotation1",    "rotation2",    "rotation3",
                                     "translation1", "translation2", "translation3"};
  const auto found = std::find(kAxisNames.begin(), kAxisNames.end(), name);
  return found == kAxisNames.end() ? -1 : static_cast<int>(found - kAxisNames.begin());
}

Axis read_axis(const FileReader& reader, const XmlElement& e, const Joint& joint) {
  const PropertyReader p(reader, e);
  const XmlElement* function = e.child("function");
  Axis axis{p.word("coordinates"), p.vector("axis", Vec3::UnitX()), p.function(function == nullptr ? e : *function),
            e.where};
  const double length = axis.direction.norm();
  if (!(length > 0))
    p.refuse(Code::out_of_range, p.where("axis"), "axis", p.word("axis"), "must not be zero");
  else
    axis.direction /= length;
  if (axis.coordinate.empty() && axis.function.kind != Function::Kind::constant) {
    axis.function.coefficients = {axis.function(0)};
    axis.function.kind = Function::Kind::constant;
    axis.function.scale = 1;
  }
  if (!axis.coordinate.empty() && joint.coordinate(axis.coordinate) == nullptr)
    p.refuse(axis.coordinate.find(' ') == std::string::npos ? Code::unknown_name : Code::not_built,
             p.where("coordinates"), "coordinates", axis.coordinate,
             "must be one coordinate of the joint " + joint.name);
  return axis;
}

void read_spatial_transform(const FileReader& reader, const XmlElement& e, Joint& joint) {
  const XmlElement* transform = e.child("SpatialTransform");
  if (transform == nullptr) return;
  for (const XmlElement& axis : transform->children) {
    if (axis.tag != "TransformAxis") continue;
    const int place = place_of_axis(axis.name());
    if (place < 0) {
      PropertyReader(reader, axis)
          .refuse(Code::unknown_name, axis.where, {}, axis.name(),
                  "must be rotation1 to rotation3 or translation1 to translation3");
      continue;
    }
    (place < 3 ? joint.rotations[at(place)] : joint.translations[at(place - 3)]) = read_axis(reader, axis, joint);
  }
}

}  // namespace

void read_joint(const FileReader& reader, const XmlElement& e, Model& model) {
  const PropertyReader p(reader, e);
  Joint joint;
  joint.type = e.tag;
  joint.name = e.name();
  joint.where = e.where;
  const std::string path = "/jointset/" + joint.name;
  for (const char* list : {"frames", "components"}) read_offset_frames(reader, e, list, path, model);
  joint.parent = frame_path(model, p.socket("parent_frame"), path);
  joint.child = frame_path(model, p.socket("child_frame"), path);
  rest(joint);
  read_coordinates(reader, e, joint);
  const auto plain = std::find_if(std::begin(kPlainJoints), std::end(kPlainJoints),
                                  [&](const PlainJoint& j) { return joint.type == j.type; });
  if (joint.type == "CustomJoint")
    read_spatial_transform(reader, e, joint);
  else if (plain != std::end(kPlainJoints))
    move_plainly(p, plain->moves, joint);
  else
    p.refuse(Code::not_built, e.where, {}, {},
             "is a kind of joint that genu does not read, so nothing behind it could be placed (it reads CustomJoint, "
             "WeldJoint, PinJoint, SliderJoint, UniversalJoint, BallJoint, GimbalJoint, PlanarJoint, FreeJoint)");
  model.joints.push_back(std::move(joint));
}

void read_coupler(const FileReader& reader, const XmlElement& e, Model& model) {
  if (e.tag != "CoordinateCouplerConstraint") return;
  const PropertyReader p(reader, e);
  const XmlElement* holder = e.child("coupled_coordinates_function");
  Function f = p.function(holder == nullptr ? e : *holder);
  f.scale *= p.number("scale_factor", 1);
  model.couplers.push_back({e.name(), p.word("independent_coordinate_names"), p.word("dependent_coordinate_name"),
                            std::move(f), p.flag("isEnforced", true), e.where});
}

}  // namespace genu::osim
