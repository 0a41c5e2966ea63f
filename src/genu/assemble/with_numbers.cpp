#include "genu/assemble/with_numbers.h"

#include "genu/assemble/parameter_values.h"
#include "genu/model/build_model.h"
#include "genu/scene/centre_bodies.h"

namespace genu {

std::optional<Prepared> with_numbers(const Prepared& prepared, const std::vector<NewNumber>& numbers,
                                     Diagnostics& out) {
  Scene scene = prepared.source;
  for (const auto& [parameter, value] : numbers) {
    double* const number = parameter_number(scene, parameter);
    if (number == nullptr)
      out.add(error_at({prepared.source.file}, Code::not_applicable, parameter.name, {},
                       "cannot be changed: numbers of ligaments, loads, bodies and joints can"));
    else
      *number = value;
  }
  if (out.has_errors()) return std::nullopt;
  return with_scene(prepared, std::move(scene), out);
}

std::optional<Prepared> with_scene(const Prepared& prepared, Scene scene, Diagnostics& out) {
  Prepared changed;
  changed.source = std::move(scene);
  changed.scene = place(changed.source, prepared.scene.origins);
  auto model = build_model(changed.scene, prepared.surfaces, out, prepared.bones, {&prepared.scene, &prepared.model});
  if (!model) return std::nullopt;
  model->meter = std::make_shared<EffectMeter>();
  changed.model = std::move(*model);
  changed.steps = plan_steps(changed.scene);
  changed.surfaces = prepared.surfaces;
  changed.notes = prepared.notes;
  changed.bones = prepared.bones;
  changed.bodies = prepared.bodies;
  changed.seconds = prepared.seconds;
  changed.meshes = prepared.meshes;
  changed.facing = prepared.facing;
  changed.search = prepared.search;
  return changed;
}

void share_search(Prepared& prepared) { prepared.search = std::make_shared<const ContactField>(prepared.model); }

ContactField contact_field(const Prepared& prepared) {
  return prepared.search ? ContactField(prepared.model, *prepared.search) : ContactField(prepared.model);
}

}  // namespace genu
