#include "studies/wrapping_study.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/results/chart.h"
#include "genu/scene/reader.h"

namespace genu::studies {
namespace {

constexpr double kValgus = 10, kAxial = 5;  // N m
constexpr int kRaised = 5;                  // poses in which the moment is raised before the flexion
constexpr int kFlexed = 90;                 // steps of 1 deg
constexpr std::size_t kTableEvery = 30;     // rows of the table: 0, 30, 60, 90 deg

using Knee = std::array<WrappingCurve, 4>;

bool is_medial_collateral(const std::string& name) { return name.rfind("MCL", 0) == 0; }

/// The moment (N m) on the tibia, in its frame: x anterior, y proximal, z lateral of a right knee.
Vec3 moment_on_tibia(int moment) {
  switch (moment) {
    case WrappingStudy::valgus:
      return {-kValgus, 0, 0};
    case WrappingStudy::internal:
      return {0, kAxial, 0};
    case WrappingStudy::external:
      return {0, -kAxial, 0};
    default:
      return Vec3::Zero();
  }
}

/// The knee of `scene` under a moment that is raised at its first pose and then kept.
Scene under_moment(Scene scene, int moment) {
  LoadDef load;
  load.name = "moment";
  const auto tibia =
      std::find_if(scene.bodies.begin(), scene.bodies.end(), [](const BodyDef& b) { return b.name == "tibia"; });
  load.body = static_cast<int>(tibia - scene.bodies.begin());
  load.moment = moment_on_tibia(moment);
  load.frame = LoadDef::Frame::body;
  scene.loads.push_back(load);
  StepDef raise = scene.steps.front();
  for (StepDef::Prescribed& p : raise.prescribe) p.to = p.from;
  raise.factors.push_back({static_cast<int>(scene.loads.size()) - 1, 0, 1});
  raise.increments = kRaised;
  scene.steps.front().increments = kFlexed;
  scene.steps.insert(scene.steps.begin(), raise);
  return scene;
}

WrappingCurve curve_of(const Scene& scene, const std::shared_ptr<MeshLibrary>& meshes, Diagnostics& out) {
  WrappingCurve c;
  const auto solved = solve_scene(scene, out, meshes);
  if (!solved) return c;
  c.complete = solved->all_stable();
  const auto from_flexion = [&](const std::string& column) {
    std::vector<double> values = solved->column(column);
    if (values.size() > kFlexed + 1) values.erase(values.begin(), values.end() - (kFlexed + 1));
    return values;
  };
  c.flexion = from_flexion("knee.flexion_deg");
  c.adduction = from_flexion("knee.adduction_deg");
  c.rotation = from_flexion("knee.rotation_deg");
  c.contact = from_flexion("tibiofemoral.force_N");
  c.medial = from_flexion("tibiofemoral.medial.force_N");
  c.lateral = from_flexion("tibiofemoral.lateral.force_N");
  c.ligament.assign(c.flexion.size(), 0);
  for (const LigamentDef& l : scene.ligaments) {
    if (!is_medial_collateral(l.name)) continue;
    const std::vector<double> force = from_flexion(l.name + ".force_N");
    for (std::size_t row = 0; row < force.size(); ++row) c.ligament[row] += force[row];
  }
  return c;
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> out;
  for (std::size_t row = 0; row < std::min(a.size(), b.size()); ++row) out.push_back(a[row] - b[row]);
  return out;
}

std::string table(const WrappingStudy& study) {
  std::string text =
      "| moment | flexion deg | ligament | adduction deg | rotation deg | its force N | contact N | medial N | lateral "
      "N "
      "|\n|---|---:|---|---:|---:|---:|---:|---:|---:|\n";
  const std::array<std::string, 4> names = {"none", fmt::format("{:g} N m valgus", kValgus),
                                            fmt::format("{:g} N m internal", kAxial),
                                            fmt::format("{:g} N m external", kAxial)};
  for (std::size_t moment = 0; moment < names.size(); ++moment)
    for (std::size_t row = 0; row < study.straight[moment].flexion.size(); row += kTableEvery)
      for (const bool wrapped : {false, true}) {
        const WrappingCurve& c = (wrapped ? study.wrapped : study.straight)[moment];
        text += fmt::format("| {} | {} | {} | {:.1f} | {:.1f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} |\n",
                            wrapped || row > 0 ? "" : names[moment],
                            wrapped ? "" : fmt::format("{:.0f}", std::abs(c.flexion[row])),
                            wrapped ? "wrapped" : "straight", c.adduction[row], c.rotation[row], c.ligament[row],
                            c.contact[row], c.medial[row], c.lateral[row]);
      }
  return text;
}

Chart chart_of(const WrappingStudy& study) {
  Chart chart;
  chart.title = "The measured knee with its medial collateral ligament straight and round the edge of the tibia";
  chart.x_title = "flexion [deg]";
  chart.x = study.straight[0].flexion;
  const auto both = [&](const std::string& title, const std::vector<double>& straight,
                        const std::vector<double>& wrapped) {
    chart.panels.push_back({title, {{"straight", straight}, {"wrapped", wrapped}}, true, false});
  };
  const auto panel = [&](const std::string& title, WrappingStudy::Moment moment,
                         const std::vector<double> WrappingCurve::*values) {
    both(title, study.straight[moment].*values, study.wrapped[moment].*values);
  };
  panel("ligament under valgus [N]", WrappingStudy::valgus, &WrappingCurve::ligament);
  both("opening by valgus [deg]", WrappingStudy::opening(study.straight), WrappingStudy::opening(study.wrapped));
  panel("contact under valgus [N]", WrappingStudy::valgus, &WrappingCurve::contact);
  panel("ligament under internal moment [N]", WrappingStudy::internal, &WrappingCurve::ligament);
  panel("contact under internal moment [N]", WrappingStudy::internal, &WrappingCurve::contact);
  both("external to internal rotation [deg]", WrappingStudy::rotation_laxity(study.straight),
       WrappingStudy::rotation_laxity(study.wrapped));
  return chart;
}

/// A row of the table of changes: the quantity where it is straight, and the difference of wrapped from straight.
std::string change(const std::string& name, const std::vector<double>& straight, const std::vector<double>& wrapped) {
  const std::vector<double> d = difference(wrapped, straight);
  const auto [least, most] = std::minmax_element(d.begin(), d.end());
  const auto [low, high] = std::minmax_element(straight.begin(), straight.end());
  return fmt::format("| {} | {:.1f} to {:.1f} | {:+.2f} to {:+.2f} |\n", name, *low, *high, *least, *most);
}

/// The largest share, in percent, by which wrapping changes a quantity.
double largest_share(const std::vector<double>& straight, const std::vector<double>& wrapped) {
  double most = 0;
  for (std::size_t row = 0; row < straight.size(); ++row)
    most = std::max(most, std::abs(wrapped[row] / straight[row] - 1));
  return 100 * most;
}

}  // namespace

bool WrappingStudy::complete() const {
  const auto good = [](const WrappingCurve& c) { return c.complete && c.flexion.size() == kFlexed + 1; };
  return std::all_of(straight.begin(), straight.end(), good) && std::all_of(wrapped.begin(), wrapped.end(), good);
}

std::vector<double> WrappingStudy::opening(const Knee& knee) {
  return difference(knee[none].adduction, knee[valgus].adduction);
}

std::vector<double> WrappingStudy::rotation_laxity(const Knee& knee) {
  return difference(knee[internal].rotation, knee[external].rotation);
}

std::optional<WrappingStudy> solve_wrapping(const std::string& folder, Diagnostics& out) {
  const auto scene = read_scene(folder + "/scene-wrapped.toml", out);
  if (!scene) return std::nullopt;
  Scene straight = *scene;
  for (LigamentDef& l : straight.ligaments)
    if (is_medial_collateral(l.name)) l.wraps.clear();
  WrappingStudy study;
  const auto meshes = std::make_shared<MeshLibrary>();
  for (int moment = 0; moment < 4; ++moment) {
    study.straight[static_cast<std::size_t>(moment)] = curve_of(under_moment(straight, moment), meshes, out);
    study.wrapped[static_cast<std::size_t>(moment)] = curve_of(under_moment(*scene, moment), meshes, out);
  }
  if (out.has_errors()) return std::nullopt;
  return study;
}

Files wrapping_files(const WrappingStudy& study) {
  std::string text = fmt::format(
      "# The measured knee with its medial collateral ligament straight and round the edge of the tibia\n\n"
      "Written by `studies wrapping meshes` (`tools/figures`); do not edit.\n\n"
      "Blankevoort and Huiskes (1991, J Biomech Eng 113:263-269) let the medial collateral ligament of a knee model "
      "bend round the\nedge of the tibia. They found that the edge redirects the ligament's force so that it resists "
      "valgus moments more effectively, and\nthat it hardly changes the laxity in internal and external rotation. Here "
      "the same is asked of the measured knee of Lenhart et al.\n(2015): `scene-wrapped.toml`, in which 16 fibres of "
      "the ligament wrap round two ellipsoids on the medial edge of the tibia, beside\nthe same scene with these "
      "fibres "
      "straight. Flexion is prescribed from 0 to 90 deg under 100 N along the tibia, alone, with {:g} N m\nof valgus, "
      "and with {:g} N m of internal and external rotation, raised before the flexion.\n\n",
      kValgus, kAxial);
  if (!study.complete()) return {{"STUDY-wrapping.md", text + "Not every pose was solved.\n"}};
  text += "![Ligament force, opening, contact force and rotation over flexion](study-wrapping.svg)\n\n";
  const auto& s = study.straight;
  const auto& w = study.wrapped;
  const std::vector<double> open_s = WrappingStudy::opening(s), open_w = WrappingStudy::opening(w);
  const std::vector<double> turn_s = WrappingStudy::rotation_laxity(s), turn_w = WrappingStudy::rotation_laxity(w);
  std::size_t firmer = 0;
  for (std::size_t row = 0; row < open_s.size(); ++row) firmer += open_w[row] < open_s[row] ? 1 : 0;
  text += fmt::format(
      "Round the edge the ligament resists valgus better at {} of {} flexions: the knee opens by up to {:.0f} % less. "
      "The rotation from\nthe external to the internal moment changes by at most {:.1f} %. Both are what the paper "
      "says.\n\n| over the whole of the flexion | straight | wrapped less straight |\n|---|---|---|\n",
      firmer, open_s.size(), largest_share(open_s, open_w), largest_share(turn_s, turn_w));
  text += change("force of the ligament under valgus, N", s[1].ligament, w[1].ligament) +
          change("opening of the knee by valgus, deg", open_s, open_w) +
          change("contact force under valgus, N", s[1].contact, w[1].contact) +
          change("force of the ligament under the internal moment, N", s[2].ligament, w[2].ligament) +
          change("contact force under the internal moment, N", s[2].contact, w[2].contact) +
          change("rotation under the internal moment, deg", s[2].rotation, w[2].rotation) +
          change("rotation from the external to the internal moment, deg", turn_s, turn_w) + "\n";
  text += "Forces of the ligament are sums over its fibres.\n\n" + table(study);
  return {{"study-wrapping.svg", to_svg(chart_of(study))}, {"STUDY-wrapping.md", text}};
}

}  // namespace genu::studies
