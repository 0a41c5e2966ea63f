#include "genu/model/measured_thickness.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/core/units.h"

namespace genu {
namespace {

void say(const PlacedScene& scene, const SurfaceDef& surface, Diagnostic::Severity severity, std::string rule,
         Diagnostics& out) {
  Diagnostic d(severity, Code::no_thickness, {scene.file, surface.thickness->where},
               "surface." + surface.name + ".thickness", {}, std::move(rule));
  const auto same = [&](const Diagnostic& other) { return to_string(other) == to_string(d); };
  if (std::none_of(out.items().begin(), out.items().end(), same)) out.add(std::move(d));
}

/// In the body's frame of the file.
std::string place(const PlacedScene& scene, const SurfaceDef& surface, const Vec3& x) {
  const Vec3 p = to::kMillimetre * (x + scene.origins[static_cast<std::size_t>(surface.body)]);
  return fmt::format("({:.1f}, {:.1f}, {:.1f}) mm", p[0], p[1], p[2]);
}

void warn(const PlacedScene& scene, const SurfaceDef& surface, const BoneReport& report, Diagnostics& out) {
  const SurfaceDef::Thickness& asked = *surface.thickness;
  const auto percent = [&](int count) { return 100.0 * count / report.vertices; };
  if (report.without > 0) {
    const std::string worst =
        std::isfinite(report.farthest)
            ? fmt::format("they take the thickness of the nearest that have some, up to {:.1f} mm away at {}",
                          to::kMillimetre * report.farthest, place(scene, surface, report.farthest_place))
            : fmt::format("a piece of the mesh without any, at {}, is taken to be {:.3g} mm thick",
                          place(scene, surface, report.farthest_place), to::kMillimetre * asked.least);
    say(scene, surface, Diagnostic::Severity::warning,
        fmt::format("no bone within {:.3g} mm under {} of {} vertices ({:.1f} %): {}", to::kMillimetre * asked.most,
                    report.without, report.vertices, percent(report.without), worst),
        out);
  }
  if (report.thin > 0)
    say(scene, surface, Diagnostic::Severity::warning,
        fmt::format("cartilage is thinner than {:.3g} mm at {} of {} vertices ({:.1f} %) and counts as that thick; {} "
                    "at {}{}",
                    to::kMillimetre * asked.least, report.thin, report.vertices, percent(report.thin),
                    report.thinnest < 0
                        ? fmt::format("bone stands out by {:.2f} mm", -to::kMillimetre * report.thinnest)
                        : fmt::format("it is {:.2f} mm", to::kMillimetre * report.thinnest),
                    place(scene, surface, report.thinnest_place),
                    2 * report.thin > report.vertices && report.thinnest < 0
                        ? ": does its outward side face away from the bone (`inside`), and are both in one frame?"
                        : ""),
        out);
}

}  // namespace

bool thickness_on(const PlacedScene& scene, const Bones& bones, int surface, const Mesh& mesh,
                  std::shared_ptr<const ThicknessField>& field, Diagnostics& out) {
  const auto k = static_cast<std::size_t>(surface);
  const SurfaceDef& def = scene.surfaces[k];
  if (!def.thickness || !def.thickness->measured) return true;
  BoneReport report;
  if (k < bones.size() && bones[k]) field = measure_thickness(mesh, *bones[k], report);
  if (!field) {
    say(scene, def, Diagnostic::Severity::error,
        fmt::format("no bone lies within {:.3g} mm under the surface: check the frames and units of both meshes, and "
                    "the outward side of the surface",
                    to::kMillimetre * def.thickness->most),
        out);
    return false;
  }
  warn(scene, def, report, out);
  return true;
}

}  // namespace genu
