#include "genu/study/segments_text.h"

#include <cmath>

#include <fmt/format.h>

#include "genu/core/units.h"

namespace genu {
namespace {

constexpr double kShearFactor = 5.0 / 6;

std::string numbers(const Vec3& v) { return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", v.x(), v.y(), v.z()); }

std::string in_mm(const Vec3& p) { return numbers(1e3 * p); }

/// The side of a piece that touches a bone's surface.
std::string side_text(const std::string& piece, const std::string& side, const std::string& bone) {
  std::string out = fmt::format(
      "\n[surface.{0}_{1}]\nbody = \"{0}\"\nshape = \"mesh\"\nfile = \"{0}_{1}.stl\"\nunits = \"mm\"\n", piece, side);
  if (bone.empty()) return out;
  return out + fmt::format(
                   "\n[contact.{0}_{1}]\nsurfaces = [\"{2}\", \"{0}_{1}\"]\nmodel = \"cartilage\"\nmodulus = 3\n"
                   "poisson = 0.45\nthickness = 6\nlaw = \"linear\"\nquadrature = \"triangles\"\n"
                   "cast_from = \"{0}_{1}\"\n",
                   piece, side, bone);
}

std::string piece_text(const MeshSegments& segments, int piece, const SegmentsText& of) {
  const MeshPiece& p = segments.pieces[at(piece)];
  const std::string name = piece_name(of.name, piece, static_cast<int>(segments.pieces.size()));
  const Vec3 c = 1e3 * p.centroid;
  return fmt::format(
             "\n[body.{0}]  # {1:.4g} mm3, {2:.4g} g\n\n[joint.{0}]\ntype = \"free\"\nparent = \"{3}\"\nchild = "
             "\"{0}\"\n"
             "rotations = [\"about_z -z\", \"about_x x\", \"about_y y\"]\ntranslations = [\"x\", \"y\", \"z\"]\n"
             "reference = {{ x = {4:.9g}, y = {5:.9g}, z = {6:.9g} }}\n",
             name, 1e9 * p.volume, 1e3 * of.density * p.volume, of.parent, c.x(), c.y(), c.z()) +
         side_text(name, "above", of.above) + side_text(name, "below", of.below);
}

std::string bushing_text(const MeshSegments& segments, int section, const SegmentsText& of) {
  const int count = static_cast<int>(segments.pieces.size());
  const MeshSection& s = segments.sections[at(section)];
  const Vec3 origin = s.centre - segments.pieces[at(section)].centroid;
  const Vec6 k = section_stiffness(segments, section, of);
  const Vec3 along = 1e-3 * k.head<3>(), about = units::kDegree * k.tail<3>();
  return fmt::format(
      "\n[bushing.{0}_hoop_{1:02}]  # section {2:.4g} mm2\n"
      "from = {{ body = \"{3}\", origin = {4}, x_axis = {5}, z_axis = {6} }}\nto = {{ body = \"{7}\" }}\n"
      "stiffness = {8}\nrotation_stiffness = {9}\n",
      of.name, section + 1, 1e6 * s.area, piece_name(of.name, section, count), in_mm(origin), numbers(s.tangent),
      numbers(s.z), piece_name(of.name, (section + 1) % count, count), numbers(along), numbers(about));
}

}  // namespace

std::string piece_name(const std::string& name, int piece, int pieces) {
  return fmt::format("{}_{:0{}}", name, piece + 1, pieces > 99 ? 3 : 2);
}

Vec6 section_stiffness(const MeshSegments& segments, int section, const SegmentsText& of) {
  const auto n = segments.pieces.size();
  const MeshSection& s = segments.sections[at(section)];
  const double length = (segments.pieces[at(section)].length + segments.pieces[(at(section) + 1) % n].length) / 2;
  const double E = of.modulus / length, G = of.shear_modulus / length;
  const double twist = 4 * s.about_y * s.about_z / (s.about_y + s.about_z);
  Vec6 out;
  out << E * s.area, kShearFactor * G * s.area, kShearFactor * G * s.area, G * twist, E * s.about_y, E * s.about_z;
  return out;
}

std::string segments_text(const MeshSegments& segments, const SegmentsText& of) {
  std::string out = fmt::format(
      "{}{} in {} pieces, E = {:.4g} MPa, G = {:.4g} MPa\n"
      "# For a scene in mm and deg with a body \"{}\", in whose frame the mesh was given. What ties the meniscus to "
      "bone\n"
      "# (horns, coronary ligaments) is to be added.\n"
      "# {}_hoop_NN.force_x_N in the results is minus the tension in a section: the pull on the next piece.\n",
      kSegmentsTitle, of.name, segments.pieces.size(), 1e-6 * of.modulus, 1e-6 * of.shear_modulus, of.parent, of.name);
  for (int k = 0; k < static_cast<int>(segments.pieces.size()); ++k) out += piece_text(segments, k, of);
  for (int k = 0; k < static_cast<int>(segments.sections.size()); ++k) out += bushing_text(segments, k, of);
  return out;
}

}  // namespace genu
