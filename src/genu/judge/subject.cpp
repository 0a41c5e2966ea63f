#include "genu/judge/subject.h"

#include <algorithm>
#include <cmath>

#include "genu/judge/tolerances.h"
#include "genu/mesh_files/mesh_reader.h"

namespace genu::judge {
namespace {

/// The largest distance between points that the scene names on its bodies and the mean of those on the same body.
double size_of(const Scene& scene, const std::vector<Side>& sides) {
  std::map<int, std::vector<Vec3>> points;
  for (const Side& side : sides) {
    const SurfaceDef& def = scene.surfaces[at(side.index)];
    if (!side.facets) points[def.body].push_back(def.placement.p);
    for (std::size_t v = 0; side.facets && v < side.facets->vertices().size(); v += 50)
      points[def.body].push_back(side.facets->vertices()[v]);
  }
  for (const LigamentDef& l : scene.ligaments)
    for (const auto& end : {l.from, l.to}) points[end.body].push_back(end.point);
  for (const BushingDef& b : scene.bushings)
    for (const auto& frame : {b.from, b.to}) points[frame.body].push_back(frame.placement.p);
  double size = 0.005;
  for (const auto& [body, all] : points) {
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : all) mean += p / static_cast<double>(all.size());
    for (const Vec3& p : all) size = std::max(size, (p - mean).norm());
  }
  return size;
}

bool read_meshes(const Scene& scene, std::vector<Side>& sides, Diagnostics& out) {
  bool good = true;
  for (int k = 0; k < static_cast<int>(scene.surfaces.size()); ++k) {
    const SurfaceDef& def = scene.surfaces[at(k)];
    Side side;
    side.index = k;
    if (def.shape == SurfaceDef::Shape::mesh) {
      Diagnostics found;
      const auto mesh = read_mesh(def.file, def.file_unit, found);
      for (const Diagnostic& d : found.items())
        if (d.severity == Diagnostic::Severity::error) out.add(d);
      good = good && mesh;
      if (mesh) side.facets = std::make_shared<const Facets>(*mesh, def);
    } else {
      side.shape.emplace(def);
    }
    sides.push_back(std::move(side));
  }
  return good;
}

/// The smooth surfaces that layers are between.
void bend_facets(const Scene& scene, std::vector<Side>& sides) {
  for (const LayerDef& layer : scene.layers) {
    if (layer.quadrature == LayerDef::Quadrature::triangles) continue;
    for (const int surface : {layer.pair.surface_a, layer.pair.surface_b}) {
      Side& side = sides[at(surface)];
      if (!side.facets || side.bent) continue;
      side.bent = std::make_shared<const BentFacets>(*side.facets, scene.surfaces[at(surface)].fit_radius.value_or(0));
    }
  }
}

/// N: moments divided by `size` (m); without the scale.
double largest_force(const LoadDef& load, double size) {
  switch (load.kind) {
    case LoadDef::Kind::wrench:
      return std::max(load.force.norm(), load.moment.norm() / size);
    case LoadDef::Kind::toward:
    case LoadDef::Kind::cable:
      return std::abs(load.activation * load.value);
    case LoadDef::Kind::coordinate:
      return std::abs(load.value) / (QuantityRef(load.coordinate).is_rotation() ? size : 1);
  }
  return 0;
}

void scale_forces(Subject& subject) {
  const Scene& s = subject.scene;
  subject.least_force = kStrainRounding;
  for (std::size_t i = 0; i < s.ligaments.size(); ++i) {
    const LigamentDef& l = s.ligaments[i];
    const bool per_length = l.law == "spring" || l.law == "abdel-rahman";
    const double number =
        l.law == "exponential" ? l.number("force_scale") * l.number("exponent") : l.number("stiffness");
    const double stiffness = per_length ? number * subject.size : number;
    subject.force_scale = std::max(subject.force_scale, 0.01 * stiffness);
    subject.least_force += kStrainRounding * stiffness;
    subject.springs += per_length ? number : number / subject.laws[i].slack_length();
  }
  for (const BushingDef& b : s.bushings) {
    const double along = b.matrix ? b.matrix->diagonal().head<3>().maxCoeff() : b.stiffness.maxCoeff();
    const double about = b.matrix ? b.matrix->diagonal().tail<3>().maxCoeff() : b.rotation_stiffness.maxCoeff();
    const double stiffness = std::max(along, about / (subject.size * subject.size));
    subject.force_scale = std::max(subject.force_scale, 0.01 * stiffness * subject.size);
    subject.springs += stiffness;
  }
  for (const LoadDef& load : s.loads)
    subject.force_scale = std::max(subject.force_scale, largest_force(load, subject.size));
  for (const Mass& mass : subject.masses)
    if (s.gravity) subject.force_scale = std::max(subject.force_scale, mass.m * s.gravity->norm());
}

}  // namespace

Mass mass_of(const Mesh& mesh, const Pose& placement, double density) {
  std::vector<Vec3> v;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : mesh.vertices) middle += placement * p / static_cast<double>(mesh.vertices.size());
  for (const Vec3& p : mesh.vertices) v.emplace_back(placement * p - middle);
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();  // integral of x x^T
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = v[at(t[0])], &b = v[at(t[1])], &c = v[at(t[2])];
    const double six = a.cross(b).dot(c);
    const Vec3 sum = a + b + c;
    volume += six / 6;
    first += six / 24 * sum;
    second += six / 120 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }
  Mass mass;
  const double sign = volume < 0 ? -1 : 1;
  mass.m = density * sign * volume;
  const Vec3 centre = first / volume;
  const Mat3 about = density * sign * (second - volume * centre * centre.transpose());
  mass.inertia = about.trace() * Mat3::Identity() - about;
  mass.centre = centre + middle;
  return mass;
}

std::shared_ptr<const Subject> make_subject(const Scene& scene, int samples, Diagnostics& out) {
  auto made = std::make_shared<Subject>();
  made->scene = scene;  // the pointers below refer to this copy
  const Scene& s = made->scene;
  bool good = read_meshes(s, made->sides, out);
  bend_facets(s, made->sides);
  const std::vector<Pose> reference = poses_at(s, reference_coordinates(s));
  for (const LigamentDef& l : s.ligaments) made->laws.emplace_back(l, length_of(path_of(l, reference)));
  for (const BodyDef& body : s.bodies) {
    Mass mass{body.mass, body.centre_of_mass, body.inertia};
    if (body.solid) {
      const auto mesh = read_mesh(body.solid->file, body.solid->file_unit, out);
      good = good && mesh;
      if (mesh) mass = mass_of(*mesh, body.solid->placement, body.solid->density);
    }
    made->masses.push_back(mass);
  }
  if (!good) return nullptr;
  made->sampled = samples;
  for (const Side& side : made->sides) {
    const bool sampled = side.shape && side.shape->bounded();
    made->samples.push_back(sampled ? side.shape->samples(samples) : std::vector<Sample>());
    made->pieces.push_back(sampled ? side.shape->pieces(samples) : std::vector<Sample>());
  }
  made->size = size_of(s, made->sides);
  scale_forces(*made);
  return made;
}

}  // namespace genu::judge
