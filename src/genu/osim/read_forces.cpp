#include "genu/osim/frames.h"
#include "genu/osim/read_parts.h"

namespace genu::osim {
namespace {

/// Strain at which Blankevoort1991Ligament becomes linear, where the file does not say it.
constexpr double kTransitionStrain = 0.06;

Ligament named(const XmlElement& e, const PropertyReader& p) {
  Ligament l;
  l.type = e.tag;
  l.name = e.name();
  l.applies = p.flag("appliesForce", true);
  l.where = e.where;
  return l;
}

void read_blankevoort(const FileReader& reader, const XmlElement& e, Model& model) {
  const PropertyReader p(reader, e);
  Ligament l = named(e, p);
  l.path = read_path(reader, e, model);
  l.stiffness = p.positive("linear_stiffness");
  l.slack_length = p.positive("slack_length");
  l.transition_strain = p.positive("transition_strain", kTransitionStrain);
  l.damping = p.number("damping_coefficient", 0);
  model.ligaments.push_back(std::move(l));
}

/// k (L - L0) where it is stretched: K = k L0 of a strain.
void read_path_spring(const FileReader& reader, const XmlElement& e, Model& model) {
  const PropertyReader p(reader, e);
  Ligament l = named(e, p);
  l.law = Ligament::Law::linear;
  l.path = read_path(reader, e, model);
  l.slack_length = p.positive("resting_length");
  l.stiffness = p.positive("stiffness") * l.slack_length;
  l.damping = p.number("dissipation", 0);
  model.ligaments.push_back(std::move(l));
}

void read_point_spring(const FileReader& reader, const XmlElement& e, Model& model) {
  const PropertyReader p(reader, e);
  Ligament l = named(e, p);
  l.law = Ligament::Law::spring;
  l.stiffness = p.positive("stiffness");
  l.slack_length = p.number("rest_length", 0);
  if (l.slack_length < 0)
    p.refuse(Code::out_of_range, p.where("rest_length"), "rest_length", p.word("rest_length"), "must be >= 0 m");
  for (const char* end : {"1", "2"})
    l.path.points.push_back({end,
                             frame_path(model, p.socket((std::string("body") + end).c_str()), "/forceset/" + l.name),
                             p.vector((std::string("point") + end).c_str(), Vec3::Zero()),
                             {},
                             {},
                             e.where});
  model.ligaments.push_back(std::move(l));
}

void read_articular_contact(const FileReader& reader, const XmlElement& e, Model& model) {
  const PropertyReader p(reader, e);
  const std::string formulation = p.word("elastic_foundation_formulation", "linear");
  if (formulation != "linear" && formulation != "nonlinear")
    p.refuse(Code::unknown_name, p.where("elastic_foundation_formulation"), "elastic_foundation_formulation",
             formulation, "must be linear or nonlinear");
  ContactForce c;
  c.name = e.name();
  c.applies = p.flag("appliesForce", true);
  c.target = p.socket("target_mesh");
  c.casting = p.socket("casting_mesh");
  c.least_depth = p.number("min_proximity", 0);
  c.most_depth = p.positive("max_proximity", 0.01);
  c.logarithmic = formulation == "nonlinear";
  c.lumped = p.flag("use_lumped_contact_model", true);
  c.where = e.where;
  model.contact_forces.push_back(std::move(c));
}

void read_coordinate_spring(const FileReader& reader, const XmlElement& e, Model& model) {
  const PropertyReader p(reader, e);
  model.springs.push_back({e.name(), p.coordinate(), p.flag("appliesForce", true), p.number("stiffness", 0),
                           p.number("rest_length", 0), p.number("viscosity", 0), e.where});
}

void read_muscle(const FileReader& reader, const XmlElement& e, Model& model) {
  const PropertyReader p(reader, e);
  model.muscles.push_back({e.tag, e.name(), p.flag("appliesForce", true), read_path(reader, e, model),
                           p.number("max_isometric_force", 0), e.where});
}

/// A layer of a mesh: modulus, thickness and the bone under it.
void read_layer(const PropertyReader& p, ContactMesh& m) {
  m.modulus = p.positive("elastic_modulus", 1e6);
  m.poisson = p.number("poissons_ratio", 0.5);
  if (!(m.poisson >= 0 && m.poisson < 0.5))
    p.refuse(Code::out_of_range, p.where("poissons_ratio"), "poissons_ratio", p.word("poissons_ratio", "0.5"),
             "must be >= 0 and < 0.5: the layer would be incompressible, and infinitely stiff");
  m.thickness = p.positive("thickness", 0.005);
  m.measured = p.flag("use_variable_thickness", false);
  m.back_file = p.word("mesh_back_file");
  m.back_where = p.where("mesh_back_file");
  m.least = p.number("min_thickness", 0.001);
  m.most = p.number("max_thickness", 0.01);
  if (m.measured && !(m.least > 0 && m.most > m.least))
    p.refuse(Code::out_of_range, p.where("min_thickness"), "min_thickness", p.word("min_thickness"),
             "must be > 0 and < max_thickness");
}

}  // namespace

void read_force(const FileReader& reader, const XmlElement& e, Model& model) {
  if (e.tag == "Blankevoort1991Ligament") return read_blankevoort(reader, e, model);
  if (e.tag == "PathSpring") return read_path_spring(reader, e, model);
  if (e.tag == "PointToPointSpring") return read_point_spring(reader, e, model);
  if (e.tag == "Smith2018ArticularContactForce") return read_articular_contact(reader, e, model);
  if (e.tag == "SpringGeneralizedForce") return read_coordinate_spring(reader, e, model);
  const bool pulls = e.tag.find("Muscle") != std::string::npos || e.tag == "PathActuator";
  if (pulls && e.child("GeometryPath") != nullptr) read_muscle(reader, e, model);
}

void read_contact_geometry(const FileReader& reader, const XmlElement& e, Model& model) {
  if (e.tag != "Smith2018ContactMesh") return;
  const PropertyReader p(reader, e);
  ContactMesh m;
  m.name = e.name();
  m.frame = frame_path(model, p.socket("frame"), "/contactgeometryset/" + m.name);
  m.X_frame_mesh = p.placement("orientation", "location");
  m.file = p.word("mesh_file");
  m.file_where = p.where("mesh_file");
  m.scale = p.vector("scale_factors", Vec3::Ones());
  m.where = e.where;
  if (m.file.empty()) p.refuse(Code::missing_key, e.where, "mesh_file", {}, "is missing");
  read_layer(p, m);
  model.contact_meshes.push_back(std::move(m));
}

}  // namespace genu::osim
