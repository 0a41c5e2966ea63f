#include <set>

#include "genu/osim/model_draft.h"

namespace genu::osim {
namespace {

/// m: what a surface has of the constant thickness of both layers together.
double share_of(const LayerDef& layer, const SurfaceDef& s) {
  if (!s.thickness) return layer.thickness / 2;
  return s.thickness->measured ? 0 : s.thickness->constant;
}

class ContactExporter {
 public:
  ContactExporter(ModelDraft& draft, XmlWriter& forces, XmlWriter& meshes)
      : draft_(draft), forces_(forces), meshes_(meshes) {}

  void layer(std::size_t index) {
    const LayerDef& l = draft_.scene.layers[index];
    for (const int k : {l.pair.surface_a, l.pair.surface_b}) {
      const SurfaceDef& s = draft_.scene.surfaces[at(k)];
      if (s.shape != SurfaceDef::Shape::mesh)
        return draft_.left_out(
            "contact", l.pair.name,
            "WARNING: contact of OpenSim-JAM is between meshes: surface." + s.name + " is none (genu mesh makes one)");
      if (!s.thickness && !(l.thickness > 0))
        return draft_.left_out("contact", l.pair.name, "WARNING: surface." + s.name + " has no thickness");
    }
    const int casting = l.cast_from >= 0 ? l.cast_from : l.pair.surface_b;
    const int target = casting == l.pair.surface_b ? l.pair.surface_a : l.pair.surface_b;
    forces_.open("Smith2018ArticularContactForce", l.pair.name);
    forces_.text("socket_target_mesh", "/contactgeometryset/" + mesh(l, target));
    forces_.text("socket_casting_mesh", "/contactgeometryset/" + mesh(l, casting));
    forces_.number("min_proximity", 0);
    forces_.number("max_proximity", draft_.request.search_depths[index]);
    forces_.text("elastic_foundation_formulation", l.law == LayerDef::Law::logarithmic ? "nonlinear" : "linear");
    forces_.flag("use_lumped_contact_model", true);
    forces_.close("Smith2018ArticularContactForce");
    draft_.kept("contact", l.pair.name, "/forceset/" + l.pair.name, remarks(l));
  }

 private:
  std::string remarks(const LayerDef& l) const {
    std::string text;
    const auto add = [&](const char* words) { text += (text.empty() ? "" : "; ") + std::string(words); };
    if (l.quadrature == LayerDef::Quadrature::smooth) add("WARNING: in OpenSim a pressure per triangle");
    if (l.rim == LayerDef::Rim::weighted) add("in OpenSim a triangle at the rim counts wholly or not at all");
    if (l.damping != 0) add("its damping is left out");
    if (!l.pair.regions.empty()) add("its regions are left out");
    for (const int k : {l.pair.surface_a, l.pair.surface_b})
      if (draft_.scene.surfaces[at(k)].patch) add("WARNING: the patch of a surface is left out: the whole mesh counts");
    return text;
  }

  /// The name of the surface as a mesh with this layer on it: one for each contact, where it is in several.
  std::string mesh(const LayerDef& l, int surface) {
    const SurfaceDef& s = draft_.scene.surfaces[at(surface)];
    const bool first = written_.insert(surface).second;
    std::string name = first ? s.name : s.name + "_" + l.pair.name;
    meshes_.open("Smith2018ContactMesh", name);
    meshes_.text("socket_frame", draft_.body_path(s.body));
    meshes_.vector("location", Vec3::Zero());
    meshes_.vector("orientation", Vec3::Zero());
    meshes_.text("mesh_file", draft_.request.meshes[at(surface)]);
    meshes_.number("elastic_modulus", l.modulus);
    meshes_.number("poissons_ratio", l.poisson);
    const bool measured = s.thickness && s.thickness->measured;
    if (!measured) meshes_.number("thickness", share_of(l, s));
    meshes_.flag("use_variable_thickness", measured);
    if (measured) {
      meshes_.text("mesh_back_file", draft_.request.bones[at(surface)]);
      meshes_.number("min_thickness", s.thickness->least);
      meshes_.number("max_thickness", s.thickness->most);
    }
    meshes_.vector("scale_factors", Vec3::Ones());
    meshes_.close("Smith2018ContactMesh");
    return name;
  }

  ModelDraft& draft_;
  XmlWriter &forces_, &meshes_;
  std::set<int> written_;
};

void tell_surfaces(ModelDraft& draft) {
  std::set<int> used;
  const std::set<std::string> kept = [&] {
    std::set<std::string> names;
    for (const ExportOutcome& o : draft.outcomes)
      if (o.kind == "contact" && !o.in_model.empty()) names.insert(o.name);
    return names;
  }();
  for (const LayerDef& l : draft.scene.layers)
    if (kept.count(l.pair.name) > 0) used.insert({l.pair.surface_a, l.pair.surface_b});
  for (int k = 0; at(k) < draft.scene.surfaces.size(); ++k) {
    const SurfaceDef& s = draft.scene.surfaces[at(k)];
    std::string place = used.count(k) > 0 ? "/contactgeometryset/" + s.name : std::string();
    for (const auto& [key, name] : draft.wraps)
      if (place.empty() && key.first == k) place = draft.body_path(s.body) + "/" + name;
    place.empty() ? draft.left_out("surface", s.name, "nothing that is written needs it")
                  : draft.kept("surface", s.name, place);
  }
}

}  // namespace

void write_contact_forces(ModelDraft& draft, XmlWriter& forces, XmlWriter& meshes) {
  ContactExporter exporter(draft, forces, meshes);
  for (std::size_t i = 0; i < draft.scene.layers.size(); ++i) exporter.layer(i);
  for (const ContactDef& c : draft.scene.contacts)
    draft.left_out("contact", c.name, "WARNING: OpenSim has no rigid contact; model = \"cartilage\" can be written");
  tell_surfaces(draft);
}

}  // namespace genu::osim
