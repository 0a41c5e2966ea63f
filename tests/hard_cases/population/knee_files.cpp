#include "hard_cases/population/knee_files.h"

#include <fstream>
#include <sstream>

#include "hard_cases/population/shape_mesh.h"

namespace genu::population {
namespace {

std::string list(const Vec3& v) {
  std::ostringstream out;
  out.precision(17);
  out << '[' << v.x() << ", " << v.y() << ", " << v.z() << ']';
  return out.str();
}

const char* shape_name(Shape::Kind kind) {
  switch (kind) {
    case Shape::Kind::plane:
      return "plane";
    case Shape::Kind::sphere:
    case Shape::Kind::socket:
      return "sphere";
    case Shape::Kind::ellipsoid:
      return "ellipsoid";
    case Shape::Kind::torus:
      return "torus";
    case Shape::Kind::polynomial:
    case Shape::Kind::cylindrical:
      return "polynomial";
  }
  return "";
}

void write_formula(const Shape& shape, std::ostream& out) {
  out << "shape = \"" << shape_name(shape.kind) << "\"\n";
  if (shape.kind == Shape::Kind::sphere || shape.kind == Shape::Kind::socket)
    out << "radius = " << shape.radii.x() << '\n';
  if (shape.kind == Shape::Kind::socket) out << "inside = true\n";
  if (shape.kind == Shape::Kind::ellipsoid) out << "radii = " << list(shape.radii) << '\n';
  if (shape.kind == Shape::Kind::torus)
    out << "major_radius = " << shape.radii.x() << "\nminor_radius = " << shape.radii.y() << '\n';
  if (shape.kind == Shape::Kind::cylindrical) out << "chart = \"cylindrical\"\n";
  if (shape.terms.empty()) return;
  out << "terms = [";
  for (const Shape::Term& t : shape.terms) out << '[' << t.i << ", " << t.j << ", " << t.c << "], ";
  out << "]\n";
}

/// A plateau's half sides where it has a patch, a condyle's half width.
constexpr double kHalfX = 15, kHalfY = 26, kHalfWidth = 13;

void write_surface(const std::string& name, const std::string& body, const Shape& shape, double size,
                   const std::string& folder, std::uint64_t noise_seed, std::ostream& out) {
  out << "[surface." << name << "]\nbody = \"" << body << "\"\norigin = " << list(shape.frame.origin)
      << "\nx_axis = " << list(shape.frame.axes.col(0)) << "\nz_axis = " << list(shape.frame.axes.col(2)) << '\n';
  if (shape.mesh_edge > 0) {
    const bool sheet = shape.kind == Shape::Kind::polynomial;
    const Triangles mesh = shape_mesh(shape, (sheet ? kHalfX : kHalfWidth) * size, kHalfY * size, noise_seed);
    write_binary_stl(mesh, folder + "/" + name + ".stl");
    out << "shape = \"mesh\"\nfile = \"" << name << ".stl\"\nunits = \"mm\"\n\n";
    return;
  }
  write_formula(shape, out);
  if (!shape.patch.empty()) out << "patch = " << shape.patch << '\n';
  out << '\n';
}

void write_contact(const Knee& knee, const Contact& contact, std::ostream& out) {
  out << "[contact." << contact.name << "]\nsurfaces = [\"femur_" << contact.name << "\", \"tibia_" << contact.name
      << "\"]\n";
  const Cartilage& c = knee.cartilage;
  if (!c.soft) {
    out << "model = \"rigid\"\n\n";
    return;
  }
  out << "model = \"cartilage\"\nmodulus = " << c.modulus << "\npoisson = " << c.poisson
      << "\nthickness = " << c.thickness << "\nlaw = \"" << (c.logarithmic ? "logarithmic" : "linear") << "\"\n";
  if (contact.femur.mesh_edge > 0 && contact.tibia.mesh_edge > 0)
    out << "quadrature = \"triangles\"\ncast_from = \"tibia_" << contact.name
        << "\"\nsearch_depth = " << 1.5 * c.thickness << '\n';
  else
    out << "quadrature = \"smooth\"\n";
  out << '\n';
}

void write_ligament(const Ligament& l, std::size_t index, std::ostream& out) {
  static const char* const kLaws[] = {"quadratic", "linear", "blankevoort", "spring", "table"};
  out << "[ligament.l" << index << "]\nfrom = { body = \"femur\", point = " << list(l.femur)
      << " }\nto = { body = \"tibia\", point = " << list(l.tibia) << " }\nlaw = \""
      << kLaws[static_cast<std::size_t>(l.law)] << "\"\n";
  if (l.law == Ligament::Law::table) {
    const double k = 0.1 * l.stiffness;
    out << "points = [[0, 0], [0.02, " << 0.006 * k << "], [0.05, " << 0.035 * k << "], [0.2, " << 0.2 * k << "]]\n";
  } else {
    out << "stiffness = " << l.stiffness << '\n';
  }
  if (l.law == Ligament::Law::blankevoort) out << "transition_strain = " << l.transition << '\n';
  out << (l.law == Ligament::Law::spring ? "reference_force = " : "reference_strain = ") << l.reference_strain
      << "\n\n";
}

void write_steps(const Knee& knee, std::ostream& out) {
  const auto loads = [&](bool end) {
    std::string text;
    for (std::size_t i = 0; i < knee.forces.size(); ++i) {
      const Force& f = knee.forces[i];
      if (f.begins == f.ends) continue;
      text += (text.empty() ? "" : ", ") + ("push" + std::to_string(i)) + (end ? " = [0, 1]" : " = 0");
    }
    return text.empty() ? std::string() : "load = { " + text + " }\n";
  };
  const std::string rotation = knee.hold_rotation ? ", \"knee.rotation\" = 0" : "";
  if (knee.prescribed) {
    out << "[[step]]\nprescribe = { \"knee.flexion\" = [" << knee.flexion_from << ", " << knee.flexion_to << "]"
        << rotation << " }\n"
        << loads(false) << "increments = " << knee.increments << "\n\n";
    if (loads(true).empty()) return;
    out << "[[step]]\nprescribe = { \"knee.flexion\" = " << knee.flexion_to << rotation << " }\n"
        << loads(true) << "increments = 5\n";
  } else {
    out << "[[step]]\n" << loads(true) << "increments = 5\n";
  }
}

}  // namespace

std::string write_knee(const Knee& knee, const std::string& folder, std::uint64_t noise_seed) {
  const std::string path = folder + "/scene.toml";
  std::ofstream out(path);
  out.precision(17);
  if (!knee.text.empty()) {
    out << knee.text;
    return path;
  }
  const double size = knee.size;
  out << "format = 1\ntitle = \"random knee: " << knee.kind << "\"\nunits = { length = \"mm\", angle = \"deg\" }\n\n"
      << "[body.tibia]\nfixed = true\n\n[body.femur]\n\n[joint.knee]\ntype = \"free\"\nparent = \"tibia\"\nchild = "
         "\"femur\"\n"
      << (knee.flexion_last ? "rotations = [\"rotation z\", \"adduction y\", \"flexion x\"]\n"
                            : "rotations = [\"flexion x\", \"adduction y\", \"rotation z\"]\n")
      << "translations = [\"x\", \"y\", \"z\"]\nreference = { x = " << knee.reference.x()
      << ", y = " << knee.reference.y() << ", z = " << knee.reference.z() << " }\n\n";
  for (const Contact& contact : knee.contacts) {
    write_surface("femur_" + contact.name, "femur", contact.femur, size, folder, noise_seed, out);
    write_surface("tibia_" + contact.name, "tibia", contact.tibia, size, folder, noise_seed + 1, out);
    write_contact(knee, contact, out);
  }
  for (std::size_t i = 0; i < knee.ligaments.size(); ++i) write_ligament(knee.ligaments[i], i, out);
  for (std::size_t i = 0; i < knee.forces.size(); ++i) {
    const Force& f = knee.forces[i];
    out << "[load.push" << i << "]\nbody = \"femur\"\n";
    if (f.moment.isZero(0))
      out << "point = " << list(f.point) << "\nforce = " << list(f.force) << "\n\n";
    else
      out << "moment = " << list(f.moment) << "\n\n";
  }
  write_steps(knee, out);
  return path;
}

}  // namespace genu::population
