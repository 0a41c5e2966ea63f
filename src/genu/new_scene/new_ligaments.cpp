#include "genu/new_scene/new_ligaments.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "genu/new_scene/fit_doubts.h"
#include "genu/new_scene/new_menisci.h"
#include "genu/new_scene/new_numbers.h"
#include "genu/new_scene/tolerances.h"

namespace genu {
namespace {

/// A place at the tibia's joint: parts of its width to the lateral side and up, of its depth forward.
struct Place {
  double lateral, anterior, proximal;
};
struct StartLigament {
  const char* name;
  Place femur, tibia;
  double stiffness;  ///< N
  double strain;
};
constexpr StartLigament kLigaments[] = {
    {"ACL", {0.10, -0.25, 0.20}, {-0.02, 0.15, -0.03}, 5000, 0.04},
    {"PCL", {-0.08, -0.10, 0.15}, {0.0, -0.45, -0.12}, 9000, 0.04},
    {"LCL", {0.50, -0.10, 0.30}, {0.48, -0.35, -0.55}, 2000, 0.04},
    {"MCL_anterior", {-0.50, -0.05, 0.30}, {-0.40, 0.10, -0.75}, 2500, 0.04},
    {"MCL_posterior", {-0.50, -0.15, 0.30}, {-0.45, -0.25, -0.60}, 2500, 0.04},
};

/// What people call the bundles of the reference knee, and the largest strain of their fibres in passive flexion: of
/// the size that they have in the reference knee (0.03 to 0.07, its posterior capsule 0.04 in extension), chosen such
/// that new knees are within the ranges of docs/laxity.md.
struct BundleName {
  const char *name, *words;
  double strain;
};
constexpr BundleName kBundles[] = {{"ACLam", "anterior cruciate, anteromedial bundle", 0.015},
                                   {"ACLpl", "anterior cruciate, posterolateral bundle", 0.025},
                                   {"PCLal", "posterior cruciate, anterolateral bundle", 0.04},
                                   {"PCLpm", "posterior cruciate, posteromedial bundle", 0.04},
                                   {"MCLs", "medial collateral, superficial", 0.06},
                                   {"MCLd", "medial collateral, deep", 0.045},
                                   {"MCLp", "posteromedial capsule", 0.045},
                                   {"LCL", "lateral collateral", 0.08},
                                   {"PFL", "popliteofibular", 0.06},
                                   {"pCAP", "posterior capsule", 0.03}};

Vec3 lateral_of(const KneeLayout& knee, bool left) { return left ? Vec3(-knee.right) : knee.right; }

std::string ligament_text(const std::string& name, const std::string& from, const std::string& to,
                          const std::string& stiffness, double transition, const std::string& length) {
  return fmt::format(
      "[ligament.{}]\nfrom = {{ body = \"femur\", point = {}\nto = {{ body = \"tibia\", point = {}\n"
      "law = \"blankevoort\"\n{}\ntransition_strain = {:g}\n{}\n\n",
      name, from, to, stiffness, transition, length);
}

std::string of_proportions(const KneeLayout& knee, bool left) {
  const Vec3 lateral = lateral_of(knee, left);
  const auto at = [&](const Place& p) {
    return Vec3(knee.centre + p.lateral * knee.width * lateral + p.anterior * knee.depth * knee.anterior +
                p.proximal * knee.width * knee.proximal);
  };
  const Vec3 up = knee.gap * knee.proximal;  // of the reference pose, where they touch
  std::string out;
  for (const StartLigament& l : kLigaments)
    out += ligament_text(l.name, point_text(at(l.femur) + up) + " }", point_text(at(l.tibia)) + " }",
                         stiffness_text(l.stiffness), kProportionTransition,
                         fmt::format("reference_strain = {:g}", l.strain));
  return out;
}

std::string insertion_text(const Insertion& insertion) {
  return fmt::format("{} }}   # +- {} mm{}{}", point_text(insertion.at), tenths(insertion.error),
                     insertion.on_mesh ? "" : ", beside the mesh",
                     insertion.given.empty() ? "" : ", by your landmark " + insertion.given);
}

std::string of_reference(const FittedKnee& fitted) {
  const std::vector<ReferenceFibre>& fibres = reference_knee().fibres;
  std::string out;
  for (const BundleName& bundle : kBundles) {
    out += fmt::format("# {}\n[bundle.{}]\nfibres = \"{}*\"\n\n", bundle.words, bundle.name, bundle.name);
    for (std::size_t i = 0; i < fibres.size(); ++i)
      if (fibres[i].bundle == bundle.name)
        out += ligament_text(fibres[i].name, insertion_text(fitted.femur.insertions[i]),
                             insertion_text(fitted.tibia.insertions[i]), "@" + stiffness_word(fibres[i].name) + "@",
                             fibres[i].transition, "@" + length_word(fibres[i].name) + "@");
  }
  return out;
}

std::map<std::string, std::string> lengths_of(const FittedKnee& fitted, double closer) {
  // Of cartilage alone insertions are too uncertain for lengths along the whole flexion.
  const bool bones = !fitted.femur.articular && !fitted.tibia.articular;
  const std::vector<ReferenceFibre>& fibres = reference_knee().fibres;
  const std::vector<double> slack = slack_lengths(fitted, closer);
  std::map<std::string, std::string> out;
  for (std::size_t i = 0; i < fibres.size(); ++i) {
    out[stiffness_word(fibres[i].name)] = stiffness_text(fibres[i].stiffness);
    std::string& text = out[length_word(fibres[i].name)];
    if (bones)
      set_slack(text, slack[i]);
    else
      text = fmt::format("reference_strain = {:g}", fibres[i].strain);
  }
  out.merge(slack_menisci(fitted));
  return out;
}

std::optional<std::string> turned_doubt(const FittedKnee& fitted, const KneeAxes& axes) {
  const double turned = turned_against(fitted, axes) * 180 / std::numbers::pi;
  if (turned <= kMostTurned) return std::nullopt;
  return fmt::format(
      "are turned by about {:.0f} deg against the axes of their files, by how the reference knee fits, and "
      "the scene bends the knee about those axes: turn the meshes first",
      turned);
}

/// Least and largest error of all insertions. m
std::pair<double, double> errors_of(const FittedKnee& fitted) {
  std::vector<double> errors;
  for (const FittedBone* bone : {&fitted.femur, &fitted.tibia})
    for (const Insertion& insertion : bone->insertions) errors.push_back(insertion.error);
  const auto [low, high] = std::minmax_element(errors.begin(), errors.end());
  return {*low, *high};
}

}  // namespace

NewLigaments ligaments_of(const Mesh& femur, const Mesh& tibia, const Mesh* fibula, const KneeLayout& knee, bool left,
                          bool bare) {
  FittedKnee fitted = fit_reference_knee(femur, tibia, axes_of(knee, left));
  const std::string fit = fmt::format("misfit {:.2g} mm on the femur, {:.2g} mm on the tibia",
                                      1e3 * fitted.femur.median, 1e3 * fitted.tibia.median);
  if (fitted.femur.poor() || fitted.tibia.poor())
    return {
        of_proportions(knee, left),
        {},
        "Anatomy of common proportions, scaled to the width of your tibia.",
        "of common proportions, scaled to the tibia",
        {},
        fmt::format("the reference knee does not fit on these bones ({}; {:.0f} and {:.0f} % of it near them), so its "
                    "ligaments are not taken. Is the side right? --side, --proximal and --anterior decide",
                    fit, 100 * fitted.femur.matched, 100 * fitted.tibia.matched),
        {},
        {},
        0,
        fitted.femur.median + fitted.tibia.median};
  const double beside = fibula ? put_on_fibula(*fibula, fitted) : 0;
  const auto [low, high] = errors_of(fitted);
  return {of_reference(fitted) + menisci_text(fitted),
          lengths_of(fitted, bare ? std::max(0.0, knee.gap) : 0),
          fmt::format("Those of a measured knee (Lenhart et al. 2015), laid on your bones: {}.\n# Each end has its "
                      "error (standard deviation) beside it, {} to {} mm.",
                      fit, tenths(low), tenths(high)),
          fmt::format("{} fibres of a measured knee laid on your bones ({}), known to {} to {} mm; 4 for the menisci",
                      reference_knee().fibres.size(), fit, tenths(low), tenths(high)),
          turned_doubt(fitted, axes_of(knee, left)),
          {},
          frames_of_bones(fitted),
          fitted,
          beside,
          fitted.femur.median + fitted.tibia.median};
}

bool settle_ligaments(const ResultTable& poses, int round, std::map<std::string, std::string>& lengths) {
  bool any = round < kMeniscusRounds && settle_menisci(poses, lengths);
  for (const BundleName& bundle : kBundles)
    for (const ReferenceFibre& fibre : reference_knee().fibres) {
      const std::string word = length_word(fibre.name);
      if (fibre.bundle != bundle.name || !lengths.contains(word)) continue;
      double usual = 0, most = 0;
      for (std::size_t row = 0; row < poses.rows(); ++row) {
        const auto length = length_in(poses, row, fibre.name);
        if (!length) continue;
        most = std::max(most, *length);
        if (poses.number(row, "knee.flexion_deg") <= kSettledFlexion) usual = std::max(usual, *length);
      }
      if (most == 0) continue;
      const double slack = std::max(usual / (1 + bundle.strain), most / (1 + std::max(kMostNewStrain, bundle.strain)));
      any = set_slack(lengths[word], slack) || any;
    }
  return any;
}

std::string balanced_reference(const ResultTable& poses) {
  std::string out;
  for (const auto& [coordinate, unit] : {std::pair("adduction", "deg"), std::pair("rotation", "deg"),
                                         std::pair("x", "mm"), std::pair("y", "mm"), std::pair("z", "mm")}) {
    const std::string column = fmt::format("knee.{}_{}", coordinate, unit);
    const double value = poses.rows() > 0 && poses.has_column(column) ? poses.number(0, column) : NAN;
    if (!std::isfinite(value)) return {};
    out += fmt::format("{}{} = {:g}", out.empty() ? "" : ", ", coordinate, std::round(100 * value) / 100 + 0.0);
  }
  return out;
}

}  // namespace genu
