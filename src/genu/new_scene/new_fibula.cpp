#include "genu/new_scene/new_fibula.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/atlas/tolerances.h"
#include "genu/core/length_units.h"
#include "genu/core/units.h"
#include "genu/new_scene/new_words.h"
#include "genu/new_scene/tolerances.h"
#include "genu/study/layout_doubts.h"

namespace genu {

namespace {

/// From the middle of the plateau to the middle of its head, in widths of the tibia.
struct FibulaHead {
  double right = 0, anterior = 0, proximal = 0;
};
FibulaHead head_of(const Mesh& fibula, const KneeLayout& knee) {
  double top = -std::numeric_limits<double>::infinity();
  for (const Vec3& x : fibula.vertices) top = std::max(top, x.dot(knee.proximal));
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (const Vec3& x : fibula.vertices)
    if (x.dot(knee.proximal) > top - kFibulaHead * knee.width) sum += x - knee.centre, ++count;
  const Vec3 head = sum / (count * knee.width);
  return {head.dot(knee.right), head.dot(knee.anterior), head.dot(knee.proximal)};
}

}  // namespace

std::optional<bool> left_by_fibula(const Mesh& fibula, const KneeLayout& knee) {
  if (fibula.vertices.empty()) return std::nullopt;
  const double right = head_of(fibula, knee).right;
  if (std::abs(right) < kFibulaAside) return std::nullopt;
  return right < 0;
}

bool check_fibula(const NewScene& asked, const NewBones& bones, const KneeLayout& knee, Diagnostics& out) {
  if (!bones.fibula) return true;
  if (bones.fibula->mesh.empty()) {
    out.error(Code::layout, asked.fibula.text(), "has no triangles");
    return false;
  }
  const FibulaHead head = head_of(bones.fibula->mesh, knee);
  const auto mm = [&](double widths) { return to::kMillimetre * widths * knee.width; };
  if (std::abs(head.right) < kFibulaReach && std::abs(head.anterior) < kFibulaReach && head.proximal < 0 &&
      head.proximal > -kFibulaReach)
    return true;
  out.error(Code::layout, asked.fibula.text(),
            fmt::format("is not where a fibula is: its upper end is {:.0f} mm to the side, {:.0f} mm to the front and "
                        "{:.0f} mm up from the middle of the tibia's plateau. Is it the fibula, in the frame of the "
                        "other meshes?",
                        mm(std::abs(head.right)), mm(head.anterior), mm(head.proximal)));
  return false;
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
  const auto warn = [&](bool seen, bool taken) {
    const auto side = [](bool is_left) { return is_left ? "left" : "right"; };
    out.warning(
        Code::layout, asked.fibula.text(),
        fmt::format("lies on the {} of the tibia, as the fibula of a {} knee does, and {} a {} one: --side "
                    "decides",
                    side(seen), side(seen), taken ? "this is" : "the shape of the bones is that of", side(!seen)));
  };
  const auto seen = left_by_fibula(bones.fibula->mesh, knee), shape = seems_left(knee);
  if (seen && *seen != left) warn(*seen, true);
  if (seen && shape && *seen != *shape && *seen == left) warn(*seen, false);
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
