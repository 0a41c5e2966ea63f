#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/osim/scene_draft.h"
#include "genu/scene/surface_writer.h"

namespace genu::osim {
namespace {

const ContactMesh* mesh_named(const Model& model, const std::string& socket) {
  const std::string name = last_name(socket);
  const auto found = std::find_if(model.contact_meshes.begin(), model.contact_meshes.end(),
                                  [&](const ContactMesh& m) { return m.name == name; });
  return found == model.contact_meshes.end() ? nullptr : &*found;
}

int rigid_of(const Skeleton& skeleton, const ContactMesh& mesh) {
  return skeleton.rigid_body(skeleton.frame(mesh.frame).body);
}

/// A contact force that acts between different rigid bodies, with its meshes.
struct Pair {
  const ContactMesh* target = nullptr;
  const ContactMesh* casting = nullptr;
  const char* why_not = nullptr;
};

Pair pair_of(const Model& model, const Skeleton& skeleton, const ContactForce& force) {
  Pair pair{mesh_named(model, force.target), mesh_named(model, force.casting), nullptr};
  if (!force.applies)
    pair.why_not = "its appliesForce is false in the model";
  else if (rigid_of(skeleton, *pair.target) == rigid_of(skeleton, *pair.casting))
    pair.why_not = "presses two parts of one rigid body together: no effect while they are frozen";
  return pair;
}

/// M = E (1 - nu) / ((1 + nu) (1 - 2 nu)) over E
double layer_factor(double poisson) { return (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)); }

/// One modulus for both layers. Lumped, OpenSim takes the mean of both; else the layers are springs in series, with
/// (h1 + h2) / M = h1 / M1 + h2 / M2.
double modulus_of(const ContactForce& force, const Pair& pair) {
  const ContactMesh &a = *pair.target, &b = *pair.casting;
  if (force.lumped) return (a.modulus + b.modulus) / 2;
  const double h = a.thickness + b.thickness;
  const double soft =
      a.thickness / (a.modulus * layer_factor(a.poisson)) + b.thickness / (b.modulus * layer_factor(b.poisson));
  return h / soft / layer_factor((a.poisson + b.poisson) / 2);
}

std::string remark_on(const ContactForce& force, const Pair& pair) {
  const ContactMesh &a = *pair.target, &b = *pair.casting;
  const bool alike = a.modulus == b.modulus && a.poisson == b.poisson;
  std::string remark;
  if (!alike && !force.lumped && (force.logarithmic || a.measured || b.measured))
    remark = "WARNING: approximated: two layers of different stiffness are given one modulus";
  if (force.least_depth > 0) remark += (remark.empty() ? "" : "; ") + std::string("its min_proximity is left out");
  return remark;
}

std::string file_of(const SceneDraft& draft, const std::string& file) {
  const auto known = draft.request.meshes.find(file);
  return toml_string(known == draft.request.meshes.end() ? file : known->second);
}

void write_surface(SceneDraft& draft, const ContactMesh& mesh) {
  const PlacedFrame placed = draft.skeleton.frame(mesh.frame);
  const Pose X = draft.skeleton.in_rigid(placed) * mesh.X_frame_mesh;
  const std::string name = draft.surfaces.of(mesh.where, mesh.name);
  draft.text += fmt::format("{}\n[surface.{}]\nbody = \"{}\"\nshape = \"mesh\"\nfile = {}\nunits = \"m\"\n",
                            source_comment("Smith2018ContactMesh", mesh.name, mesh.where), name,
                            draft.body_name(draft.skeleton.rigid_body(placed.body)), file_of(draft, mesh.file));
  const bool turned = !X.R.isApprox(Mat3::Identity(), 1e-12);
  if (turned || point_text(X.p) != point_text(Vec3::Zero())) draft.text += "origin = " + point_text(X.p) + "\n";
  if (turned) {
    draft.text += "x_axis = " + vector_text(X.R.col(0)) + "\n";
    draft.text += "z_axis = " + vector_text(X.R.col(2)) + "\n";
  }
  if (mesh.measured)
    draft.text += fmt::format("thickness = {{ bone = {}, units = \"m\", minimum = {}, maximum = {} }}\n",
                              file_of(draft, mesh.back_file), number_text(mesh.least * to::kMillimetre),
                              number_text(mesh.most * to::kMillimetre));
  else
    draft.text += fmt::format("thickness = {}\n", number_text(mesh.thickness * to::kMillimetre));
  draft.text += "\n";
  draft.outcomes.kept(mesh.where, "surface." + name);
}

void write_contact(SceneDraft& draft, const ContactForce& force, const Pair& pair) {
  const std::string name = draft.contacts.of(force.where, force.name),
                    casting = draft.surfaces.of(pair.casting->where, pair.casting->name);
  const double modulus = modulus_of(force, pair) / units::kMegapascal;
  draft.text += fmt::format(
      "{}\n[contact.{}]\nsurfaces = [\"{}\", \"{}\"]\nmodel = \"cartilage\"\nmodulus = {}\npoisson = {}\nlaw = \"{}\"\n"
      "quadrature = \"triangles\"\ncast_from = \"{}\"\nrim = \"cut\"\nsearch_depth = {}\n\n",
      source_comment("Smith2018ArticularContactForce", force.name, force.where), name,
      draft.surfaces.of(pair.target->where, pair.target->name), casting, number_text(modulus),
      number_text((pair.target->poisson + pair.casting->poisson) / 2), force.logarithmic ? "logarithmic" : "linear",
      casting, number_text(force.most_depth * to::kMillimetre));
  draft.outcomes.kept(force.where, "contact." + name, remark_on(force, pair));
}

}  // namespace

std::vector<NeededMesh> needed_meshes(const Model& model, const Skeleton& skeleton) {
  std::vector<NeededMesh> needed;
  std::set<const ContactMesh*> seen;
  for (const ContactForce& force : model.contact_forces) {
    const Pair pair = pair_of(model, skeleton, force);
    if (pair.why_not != nullptr) continue;
    for (const ContactMesh* mesh : {pair.target, pair.casting}) {
      if (!seen.insert(mesh).second) continue;
      const bool scaled = mesh->scale != Vec3::Ones();
      needed.push_back({mesh->file, mesh->file_where, scaled});
      if (mesh->measured) needed.push_back({mesh->back_file, mesh->back_where, scaled});
    }
  }
  return needed;
}

void write_contacts(SceneDraft& draft) {
  std::string contacts;
  std::set<const ContactMesh*> written;
  draft.text +=
      "# --- Cartilage: meshes of the model, and contact on each triangle of the casting one, as OpenSim-JAM computes "
      "it\n"
      "# (rim = \"cut\"; \"weighted\" is continuous where contact slides over the rim, which `genu run` likes better) "
      "---\n";
  for (const ContactForce& force : draft.model.contact_forces) {
    const Pair pair = pair_of(draft.model, draft.skeleton, force);
    if (pair.why_not != nullptr) {
      draft.outcomes.left_out(force.where, pair.why_not);
      continue;
    }
    for (const ContactMesh* mesh : {pair.target, pair.casting})
      if (written.insert(mesh).second) write_surface(draft, *mesh);
    std::swap(contacts, draft.text);
    write_contact(draft, force, pair);
    std::swap(contacts, draft.text);
  }
  draft.text += contacts;
  for (const ContactMesh& mesh : draft.model.contact_meshes)
    if (written.count(&mesh) == 0) draft.outcomes.left_out(mesh.where, "no contact that is imported needs it");
}

}  // namespace genu::osim
