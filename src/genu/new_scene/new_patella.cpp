#include "genu/new_scene/new_patella.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/atlas/fitted_patella.h"
#include "genu/core/length_units.h"
#include "genu/core/units.h"
#include "genu/mesh/nearest_point.h"
#include "genu/new_scene/new_numbers.h"
#include "genu/new_scene/new_scene_text.h"
#include "genu/new_scene/tolerances.h"

namespace genu {
namespace {

struct PatellaBundle {
  const char *name, *words;
};
constexpr PatellaBundle kPatellaBundles[] = {
    {"PT", "patellar tendon"}, {"mPFL", "medial patellofemoral"}, {"lPFL", "lateral patellofemoral"}};

Vec3 middle_of_mesh(const Mesh& mesh) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& vertex : mesh.vertices) sum += vertex;
  return sum / static_cast<double>(std::max<std::size_t>(1, mesh.vertices.size()));
}

/// Least distance (m) of its vertices, of some hundreds, from the other mesh.
double distance_between(const Mesh& mesh, const Mesh& other) {
  double least = std::numeric_limits<double>::infinity();
  const std::size_t step = std::max<std::size_t>(1, mesh.vertices.size() / kPieceSamples);
  for (std::size_t v = 0; v < mesh.vertices.size(); v += step)
    least = std::min(least, (mesh.vertices[v] - nearest_on_mesh(other, mesh.vertices[v])).norm());
  return least;
}

double length_of(const Mesh& mesh) {
  Vec3 low = mesh.vertices.front(), high = low;
  for (const Vec3& vertex : mesh.vertices) low = low.cwiseMin(vertex), high = high.cwiseMax(vertex);
  return (high - low).maxCoeff();
}

/// Why it cannot lie there; empty where it can.
std::string misplaced(const Mesh& patella, const Mesh& femur, const KneeLayout& knee) {
  if (const double length = length_of(patella); length > kLargestPatella * knee.width)
    return fmt::format("is {} mm long beside a tibia of {} mm width: is it the patella?", tenths(length),
                       tenths(knee.width));
  const double forward = (middle_of_mesh(patella) - knee.centre).dot(knee.anterior);
  if (forward <= 0)
    return fmt::format(
        "lies {} mm behind the middle of the tibia's plateau: is it the patella, in the frame of the "
        "other meshes, and --anterior right?",
        tenths(-forward));
  const double away = distance_between(patella, femur);
  if (away > kPatellaAway)
    return fmt::format("lies {} mm from the femur: is it the patella, in the frame of the other meshes?", tenths(away));
  return "";
}

std::string end_text(const char* body, const Insertion& insertion) {
  return fmt::format("{{ body = \"{}\", point = {} }}   # +- {} mm{}", body, point_text(insertion.at),
                     tenths(insertion.error), insertion.on_mesh ? "" : ", beside the mesh");
}

std::string fibres_text(const FittedPatella& fitted) {
  const std::vector<PatellaFibre>& fibres = reference_knee().patella.fibres;
  std::string out;
  for (const PatellaBundle& bundle : kPatellaBundles) {
    out += fmt::format("# {}\n[bundle.{}]\nfibres = \"{}*\"\n\n", bundle.words, bundle.name, bundle.name);
    for (std::size_t i = 0; i < fibres.size(); ++i)
      if (fibres[i].bundle == bundle.name)
        out += fmt::format(
            "[ligament.{}]\nfrom = {}\nto = {}\nlaw = \"blankevoort\"\nstiffness = {:g}\ntransition_strain = {:g}\n"
            "@{}@\n\n",
            fibres[i].name, end_text("patella", fitted.fibres[i].patella),
            end_text(fibres[i].to_tibia ? "tibia" : "femur", fitted.fibres[i].bone), fibres[i].stiffness,
            fibres[i].transition, length_word(fibres[i].name));
  }
  return out;
}

/// The cables' part of `load` of a step in which the load grows.
std::string ramp_text() {
  std::string out;
  for (const QuadricepsCable& cable : reference_knee().patella.quadriceps)
    out += fmt::format(", {} = [0.05, 1]", cable.name);
  return out;
}

std::string unit_text(const Vec3& d) { return fmt::format("[{:.6f}, {:.6f}, {:.6f}]", d.x(), d.y(), d.z()); }

std::string quadriceps_text(const FittedPatella& fitted) {
  const std::vector<QuadricepsCable>& cables = reference_knee().patella.quadriceps;
  std::string out;
  for (std::size_t i = 0; i < cables.size(); ++i) {
    const FittedPatella::Cable& cable = fitted.quadriceps[i];
    const std::string& name = cables[i].name;
    const Vec3 across = (cable.anterior - cable.anterior.dot(cable.axis) * cable.axis).normalized();
    out += fmt::format(
        "[surface.front_{}]\nbody = \"femur\"\nshape = \"cylinder\"\nradius = {}\norigin = {}\nx_axis = {}\n"
        "z_axis = {}\n\n",
        name, tenths(cable.radius), point_text(cable.centre), unit_text(across), unit_text(cable.axis));
    out += fmt::format(
        "[load.{}]\nfrom = {{ body = \"femur\", point = {} }}\nto = {{ body = \"patella\", point = {} }}\n"
        "wrap = [{{ surface = \"front_{}\", side = {}, inside = \"ignore\" }}]\nmagnitude = {:g}\n\n",
        name, point_text(cable.femur), point_text(cable.patella), name, unit_text(across), cables[i].tension);
  }
  return out;
}

}  // namespace

NewPatella patella_of(const NewScene& asked, const NewBones& bones, const std::optional<FittedKnee>& fitted,
                      const KneeLayout& knee, const Words& words, Diagnostics& out) {
  if (!bones.patella) return {};
  const Mesh& mesh = bones.patella->mesh;
  const std::string files = asked.patella.text();
  if (const std::string why = misplaced(mesh, bones.femur_shape(), knee); !why.empty()) {
    out.error(Code::layout, files, why);
    return {};
  }
  if (!fitted) {
    out.warning(Code::layout, files, "is left out: without the reference knee nothing says what holds a patella");
    return {};
  }
  const FittedPatella patella = fit_reference_patella(
      {mesh, bones.patella_bone ? bones.patella_bone->mesh : mesh, bones.femur_shape(), bones.tibia_shape()}, *fitted);
  const std::string fit = fmt::format("misfit {:.2g} mm", 1e3 * patella.median);
  if (patella.poor()) {
    out.warning(Code::layout, files,
                fmt::format("is left out: the reference patella does not fit on it ({}; {:.0f} % of it near)", fit,
                            100 * patella.matched));
    return {};
  }
  Words w = words;
  double tension = 0;
  for (const QuadricepsCable& cable : reference_knee().patella.quadriceps) tension += cable.tension;
  w["patella_file"] = names_seen_from(asked.patella, asked.folder);
  w["patella_unit"] = length_unit_name(bones.patella->unit);
  w["patella_origin"] = point_text(middle_of_mesh(mesh));
  // The femur's cartilage is as thick under the patella as under the tibia.
  const std::string of_its_bone = thickness_text(asked.patella_bone, asked.folder, bones.patella_bone);
  const std::string chosen = "\nthickness = 3                  # CHOSEN: mm";
  w["patella_thickness"] = !bones.femur_bone ? "" : bones.patella_bone ? of_its_bone : chosen;
  w["patella_layer"] = bones.femur_bone ? "" : "thickness = 6                  # CHOSEN: mm, of both layers together\n";
  w["patella_fit"] = fit;
  w["patella_ligaments"] = fibres_text(patella);
  w["quadriceps"] = quadriceps_text(patella);
  w["tension"] = fmt::format("{:.0f}", tension);
  std::map<std::string, std::string> lengths;
  for (const PatellaFibre& fibre : reference_knee().patella.fibres) {
    lengths[length_word(fibre.name)] = fmt::format("reference_strain = {:g}", fibre.strain);
    w[length_word(fibre.name)] = "@" + length_word(fibre.name) + "@";
  }
  return {filled_in(patella_text(), w), lengths, ramp_text(), w["patella_unit"],
          fmt::format("{} fibres and four cables of quadriceps ({:.0f} N) of a measured knee laid on it ({})",
                      patella.fibres.size(), tension, fit)};
}

bool settle_patella(const ResultTable& poses, std::map<std::string, std::string>& lengths) {
  bool any = false;
  for (const PatellaFibre& fibre : reference_knee().patella.fibres) {
    if (fibre.to_tibia) continue;
    double most = 0, longest = 0;
    for (std::size_t row = 0; row < poses.rows(); ++row) {
      const auto length = length_in(poses, row, fibre.name);
      if (!length) continue;
      longest = std::max(longest, *length);
      most = std::max(most, poses.number(row, fibre.name + ".strain"));
    }
    if (most > kMostNewStrain) any = set_slack(lengths[length_word(fibre.name)], longest / (1 + kMostNewStrain)) || any;
  }
  return any;
}

}  // namespace genu
