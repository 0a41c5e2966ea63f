#include "genu/osim/export_scene.h"

#include <algorithm>

#include <fmt/format.h>

#include "genu/core/counted.h"
#include "genu/core/file_text.h"
#include "genu/osim/model_draft.h"

namespace genu::osim {
namespace {

void write_body(ModelDraft& draft, int index, XmlWriter& out) {
  const BodyDef& body = draft.scene.bodies[at(index)];
  const Mat3& I = body.inertia;
  out.open("Body", body.name);
  out.number("mass", body.mass);
  out.vector("mass_center", body.centre_of_mass);
  out.text("inertia", fmt::format("{} {} {} {} {} {}", I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)));
  if (const auto wraps = draft.wrap_objects.find(index); wraps != draft.wrap_objects.end()) {
    out.open("WrapObjectSet", "wrapobjectset");
    out.open("objects");
    out.add(wraps->second);
    out.close("objects");
    out.close("WrapObjectSet");
  }
  out.close("Body");
}

void add_set(XmlWriter& out, const char* tag, const char* name, const XmlWriter& objects) {
  out.open(tag, name);
  out.open("objects");
  out.add(objects);
  out.close("objects");
  out.close(tag);
}

std::string model_text(ModelDraft& draft) {
  XmlWriter bodies, joints, forces, meshes, out;
  write_path_forces(draft, forces);
  write_contact_forces(draft, forces, meshes);
  write_other_loads(draft, forces);
  for (int b = 0; at(b) < draft.scene.bodies.size(); ++b) {
    write_body(draft, b, bodies);
    draft.kept("body", draft.body(b), draft.body_path(b));
  }
  write_joint_set(draft, joints);
  out.open("Model", draft.request.name);
  out.vector("gravity", draft.scene.gravity.value_or(Vec3::Zero()));
  out.text("credits", "Written by genu export from " + draft.scene.file);
  out.text("length_units", "meters");
  out.text("force_units", "N");
  add_set(out, "BodySet", "bodyset", bodies);
  add_set(out, "JointSet", "jointset", joints);
  add_set(out, "ForceSet", "forceset", forces);
  add_set(out, "ContactGeometrySet", "contactgeometryset", meshes);
  out.close("Model");
  XmlWriter document;
  document.add(out);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<OpenSimDocument Version=\"40000\">\n" + document.str() +
         "</OpenSimDocument>\n";
}

std::string table_of(const std::vector<ExportOutcome>& outcomes) {
  std::string table = "kind,name,fate,in_model,reason\n";
  for (const ExportOutcome& o : outcomes)
    table += fmt::format("{},{},{},{},{}\n", o.kind, csv_word(o.name), o.in_model.empty() ? "left out" : "kept",
                         csv_word(o.in_model), csv_word(o.reason));
  return table;
}

/// "2 ligaments (AAC, PAC): WARNING: ..."; the fate first.
std::vector<std::string> summary_of(const std::vector<ExportOutcome>& outcomes) {
  constexpr std::size_t kMostNames = 4;
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    const ExportOutcome& first = outcomes[k];
    const auto alike = [&](const ExportOutcome& o) {
      return o.kind == first.kind && o.reason == first.reason && o.in_model.empty() == first.in_model.empty();
    };
    if (first.reason.empty() || std::any_of(outcomes.begin(), outcomes.begin() + static_cast<std::ptrdiff_t>(k), alike))
      continue;
    std::string names;
    std::size_t count = 0;
    for (const ExportOutcome& o : outcomes)
      if (alike(o) && ++count <= kMostNames) names += (names.empty() ? "" : ", ") + o.name;
    lines.push_back(fmt::format("{:<8}  {} ({}{}): {}", first.in_model.empty() ? "left out" : "kept",
                                counted(count, first.kind), names, count > kMostNames ? ", ..." : "", first.reason));
  }
  return lines;
}

std::string forces_text(const ModelDraft& draft) {
  if (draft.forces_head.empty()) return {};
  const auto columns = 1 + std::count(draft.forces_head.begin(), draft.forces_head.end(), '\t');
  return fmt::format("forces\nversion=1\nnRows=1\nnColumns={}\ninDegrees=no\nendheader\ntime{}\n0{}\n", columns,
                     draft.forces_head, draft.forces_row);
}

}  // namespace

const std::string& ModelDraft::coordinate(const CoordinateRef& c) const {
  const auto named = std::find_if(request.coordinates.begin(), request.coordinates.end(),
                                  [&](const auto& one) { return one.first == c; });
  return named->second;
}

ExportedModel export_scene(const SceneTables& scene, const ExportRequest& request) {
  ExportedModel model;
  ModelDraft draft{scene, request};
  model.text = model_text(draft);
  model.table = table_of(draft.outcomes);
  model.summary = summary_of(draft.outcomes);
  model.forces = forces_text(draft);
  for (const JointDef& joint : scene.joints)
    if (joint.type != JointDef::Type::fixed) model.joints.push_back(joint.name);
  for (const ExportOutcome& o : draft.outcomes) ++(o.in_model.empty() ? model.left_out : model.kept);
  return model;
}

}  // namespace genu::osim
