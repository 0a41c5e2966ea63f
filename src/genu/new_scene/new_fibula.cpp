#include "genu/new_scene/new_fibula.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/atlas/tolerances.h"
#include "genu/core/length_units.h"
#include "genu/core/units.h"
#include "genu/new_scene/new_words.h"
#include "genu/new_scene/tolerances.h"
#include "genu/scene/utf8.h"

namespace genu {

std::optional<bool> left_by_fibula(const Mesh& fibula, const KneeLayout& knee) {
  if (fibula.vertices.empty()) return std::nullopt;
  const auto height = [&](const Vec3& x) { return x.dot(knee.proximal); };
  double top = height(fibula.vertices.front()), right = 0;
  for (const Vec3& x : fibula.vertices) top = std::max(top, height(x));
  int count = 0;
  for (const Vec3& x : fibula.vertices)
    if (height(x) > top - kFibulaHead * knee.width) right += (x - knee.centre).dot(knee.right), ++count;
  right /= count;
  if (std::abs(right) < kFibulaAside * knee.width) return std::nullopt;
  return right < 0;
}

std::string fibula_text(const NewScene& asked, const NewBones& bones) {
  if (!bones.fibula) return "";
  return fmt::format(
      "\n# The fibula is part of the tibia and touches nothing: it is there to be seen.\n"
      "[surface.fibula]\nbody = \"tibia\"\nshape = \"mesh\"\nfile = {}\nunits = \"{}\"\n",
      names_seen_from(asked.fibula, asked.folder), length_unit_name(bones.fibula->unit));
}

void doubt_fibula(const NewScene& asked, const NewBones& bones, const KneeLayout& knee, bool left, Diagnostics& out) {
  if (!bones.fibula) return;
  if (const auto seen = left_by_fibula(bones.fibula->mesh, knee); seen && *seen != left)
    out.warning(
        Code::layout, asked.fibula.text(),
        fmt::format("lies on the {} of the tibia, as the fibula of a {} knee does, and this is a {} one: --side "
                    "decides",
                    *seen ? "left" : "right", *seen ? "left" : "right", left ? "left" : "right"));
}

std::string fibula_choice(const NewScene& asked, double farthest, Diagnostics& out) {
  const std::string distance = fmt::format("{:.1f} mm", to::kMillimetre * farthest);
  if (farthest == 0) return "no ligament put onto it: landmarks say where they insert";
  if (farthest <= kOntoFibula)
    return fmt::format("lateral collateral and popliteofibular ligament put onto it, by at most {}", distance);
  out.warning(
      Code::layout, asked.fibula.text(),
      fmt::format("is {} from where the reference knee's lateral collateral or popliteofibular ligament inserts "
                  "(at most {:.0f} mm are bridged): they stay where they are. Is it the fibula of this knee?",
                  distance, to::kMillimetre * kOntoFibula));
  return "no ligament put onto it";
}

}  // namespace genu
