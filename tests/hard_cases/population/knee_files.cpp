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

/// Which of its own axes a mirrored shape is turned round along, so that the other two stay right-handed: one along
/// which its patch reaches as far both ways.
Eigen::Index flipped_axis(const Shape& shape) { return shape.kind == Shape::Kind::cylindrical ? 2 : 1; }

void mirror(Triangles& mesh, Eigen::Index axis) {
  for (Vec3& v : mesh.vertices) v[axis] = -v[axis];
  for (auto& face : mesh.faces) std::swap(face[1], face[2]);
}

void write_formula(const Shape& shape, const View& view, std::ostream& out) {
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
  for (const Shape::Term& t : shape.terms)  // j is of y, or of z about an axis: of the axis that is turned round
    out << '[' << t.i << ", " << t.j << ", " << (view.mirrored && t.j % 2 == 1 ? -t.c : t.c) << "], ";
  out << "]\n";
}

/// A plateau's half sides where it has a patch, a condyle's half width.
constexpr double kHalfX = 15, kHalfY = 26, kHalfWidth = 13;

void write_surface(const std::string& name, const std::string& body, const Shape& shape, double size,
                   const std::string& folder, std::uint64_t noise_seed, const View& view, std::ostream& out) {
  const Eigen::Index flipped = flipped_axis(shape);
  const Vec3 z = shape.frame.axes.col(2);
  out << "[surface." << name << "]\nbody = \"" << body << "\"\norigin = " << list(view.place(shape.frame.origin))
      << "\nx_axis = " << list(view.place(shape.frame.axes.col(0)))
      << "\nz_axis = " << list(view.place(view.mirrored && flipped == 2 ? Vec3(-z) : z)) << '\n';
  if (shape.mesh_edge > 0) {
    const bool sheet = shape.kind == Shape::Kind::polynomial;
    Triangles mesh = shape_mesh(shape, (sheet ? kHalfX : kHalfWidth) * size, kHalfY * size, noise_seed);
    if (view.mirrored) mirror(mesh, flipped);
    write_binary_stl(mesh, folder + "/" + name + ".stl");
    out << "shape = \"mesh\"\nfile = \"" << name << ".stl\"\nunits = \"mm\"\n\n";
    return;
  }
  write_formula(shape, view, out);
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

void write_ligament(const Ligament& l, std::size_t index, const View& view, std::ostream& out) {
  static const char* const kLaws[] = {"quadratic", "linear", "blankevoort", "spring", "table"};
  out << "[ligament.l" << index << "]\nfrom = { body = \"femur\", point = " << list(view.place(l.femur))
      << " }\nto = { body = \"tibia\", point = " << list(view.place(l.tibia)) << " }\nlaw = \""
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

void write_joint(const Knee& knee, const View& view, std::ostream& out) {
  const char* const flexion = view.mirrored ? "flexion y" : "flexion x";
  const char* const adduction = view.mirrored ? "adduction -z" : "adduction y";
  const char* const rotation = view.mirrored ? "rotation -x" : "rotation z";
  out << "[joint.knee]\ntype = \"free\"\nparent = \"tibia\"\nchild = \"femur\"\nrotations = [\""
      << (knee.flexion_last ? rotation : flexion) << "\", \"" << adduction << "\", \""
      << (knee.flexion_last ? flexion : rotation)
      << "\"]\ntranslations = " << (view.mirrored ? "[\"z\", \"x\", \"y\"]" : "[\"x\", \"y\", \"z\"]")
      << "\nreference = { x = " << (view.mirrored ? -1 : 1) * knee.reference.x() << ", y = " << knee.reference.y()
      << ", z = " << knee.reference.z() << " }\n\n";
}

}  // namespace

std::string write_knee(const Knee& knee, const std::string& folder, std::uint64_t noise_seed, const View& view) {
  const std::string path = folder + "/scene.toml";
  std::ofstream out(path);
  out.precision(17);
  if (!knee.text.empty()) {
    out << knee.text;
    return path;
  }
  const double size = knee.size;
  out << "format = 1\ntitle = \"random knee: " << knee.kind << "\"\nunits = { length = \"mm\", angle = \"deg\" }\n\n"
      << "[body.tibia]\nfixed = true\n\n[body.femur]\n\n";
  write_joint(knee, view, out);
  for (const Contact& contact : knee.contacts) {
    write_surface("femur_" + contact.name, "femur", contact.femur, size, folder, noise_seed, view, out);
    write_surface("tibia_" + contact.name, "tibia", contact.tibia, size, folder, noise_seed + 1, view, out);
    write_contact(knee, contact, out);
  }
  for (std::size_t i = 0; i < knee.ligaments.size(); ++i) write_ligament(knee.ligaments[i], i, view, out);
  for (std::size_t i = 0; i < knee.forces.size(); ++i) {
    const Force& f = knee.forces[i];
    out << "[load.push" << i << "]\nbody = \"femur\"\n";
    if (f.moment.isZero(0))
      out << "point = " << list(view.place(f.point)) << "\nforce = " << list(view.place(f.force)) << "\n\n";
    else
      out << "moment = " << list(view.turn(f.moment)) << "\n\n";
  }
  write_steps(knee, out);
  return path;
}

}  // namespace genu::population
