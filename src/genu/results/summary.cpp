#include "genu/results/summary.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <thread>

namespace genu {
namespace {

using nlohmann::ordered_json;

ordered_json number_or_null(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr); }

void add_solved(const RunSummary& s, ordered_json& j) {
  j["poses"] = {{"asked", s.poses_asked}, {"solved", s.poses_solved}, {"stable", s.poses_stable}};
  if (s.rigid_pairs > 0) j["contacts"] = {{"fewest", s.fewest_contacts}, {"most", s.most_contacts}};
  j["newton"] = {{"iterations", s.iterations}, {"substeps", s.substeps}, {"worst_residual", s.worst_residual}};
  j["certificate"] = {{"smallest_force_N", number_or_null(s.smallest_force)},
                      {"smallest_gap_mm", number_or_null(1e3 * s.smallest_gap)}};
}

void add_motion(const RunSummary& s, ordered_json& j) {
  const RunSummary::Motion& m = *s.motion;
  j["rows"] = {{"asked", s.poses_asked}, {"solved", s.poses_solved}};
  j["motion"] = {{"duration_s", m.duration},
                 {"output_interval_s", m.output_interval},
                 {"tolerance", m.tolerance},
                 {"method", m.method},
                 {"steps", m.steps},
                 {"evaluations", m.evaluations},
                 {"jacobians", m.jacobians},
                 {"starts", m.starts},
                 {"switches", m.switches},
                 {"contacts_closed_or_opened", m.impacts},
                 {"worst_constraint_residual", m.worst_residual},
                 {"worst_drift_taken_out", m.worst_drift},
                 {"worst_energy_error_J", number_or_null(m.worst_energy)},
                 {"largest_energy_J", number_or_null(m.energy_scale)}};
}

void add_given(const RunSummary& s, ordered_json& j) {
  j["poses"] = {{"file", s.given->file},
                {"given", s.poses_asked},
                {"evaluated", s.poses_solved},
                {"left_out", s.given->left_out}};
  for (const auto& c : s.given->columns)
    j["columns"].push_back({{"column", c.column}, {"coordinate", c.coordinate}, {"unit", c.unit}, {"how", c.how}});
  j["columns_ignored"] = s.given->ignored;
  j["smallest_gap_mm"] = number_or_null(1e3 * s.smallest_gap);
}

ordered_json hertz_json(const HertzCheck& c) {
  ordered_json j = {{"contact", c.contact},           {"row", c.row},
                    {"applies", c.applies()},         {"approach_mm", 1e3 * c.approach},
                    {"layer_force_N", c.layer_force}, {"layer_max_pressure_MPa", 1e-6 * c.layer_peak_pressure}};
  if (!c.applies()) {
    j["why"] = c.why;
    return j;
  }
  j["force_N"] = c.force;
  j["max_pressure_MPa"] = 1e-6 * c.peak_pressure;
  j["half_axes_mm"] = {1e3 * c.a, 1e3 * c.b};
  j["layer_force_over_hertz"] = number_or_null(c.layer_force / c.force);
  j["half_axis_over_thickness"] = c.axis_over_thickness;
  return j;
}

ordered_json body_json(const RunSummary::BodyFacts& b) {
  const Vec3 c = 1e3 * b.centre_of_mass;
  const Mat3& I = b.inertia;
  return {{"name", b.name},
          {"file", b.file},
          {"density_kg_m3", b.density},
          {"volume_cm3", 1e6 * b.volume},
          {"mass_kg", b.mass},
          {"centre_of_mass_mm", {c.x(), c.y(), c.z()}},
          {"inertia_kg_m2", {I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)}}};
}

ordered_json effect_json(const RunSummary::Effect& e) {
  ordered_json j = {{"name", e.name}, {"count", e.count}, {"unknowns", e.unknowns}};
  if (e.evaluations) {
    j["evaluations"] = *e.evaluations;
    j["seconds"] = e.seconds;
  }
  return j;
}

std::string effect_text(const RunSummary::Effect& e) {
  const std::string cost =
      e.evaluations ? fmt::format("{:>10} evaluated {:>9.3g} s", *e.evaluations, e.seconds) : std::string(31, ' ');
  return fmt::format("{:<22}{:>4}{}   {}", e.name, e.count, cost, e.unknowns);
}

}  // namespace

std::string to_text(const RunSummary::BodyFacts& b) {
  const Vec3 c = 1e3 * b.centre_of_mass;
  const Mat3& I = b.inertia;
  return fmt::format(
      "{}: {:.4g} kg ({:.5g} cm3 of {:g} kg/m3), centre of mass ({:.2f}, {:.2f}, {:.2f}) mm, inertia [{:.4g}, {:.4g}, "
      "{:.4g}, {:.4g}, {:.4g}, {:.4g}] kg m2",
      b.name, b.mass, 1e6 * b.volume, b.density, c.x(), c.y(), c.z(), I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2),
      I(1, 2));
}

double seconds_of(const RunSummary& summary, const std::string& stage) {
  for (const auto& [name, seconds] : summary.seconds)
    if (name == stage) return seconds;
  return 0;
}

const char* to_string(RunSummary::Class verdict) {
  constexpr const char* kWords[] = {"solved", "doubtful", "not_solved"};
  return kWords[static_cast<int>(verdict)];
}

std::string to_json(const RunSummary& s) {
  ordered_json j;
  j["genu"] = s.version;
  j["scene"] = s.scene_file;
  if (!s.scene_path.empty()) j["scene_path"] = s.scene_path;
  j["files"] = ordered_json::array();
  for (const auto& f : s.files)
    j["files"].push_back({{"path", f.path}, {"bytes", f.checksum.bytes}, {"xxh128", f.checksum.xxh128}});
  if (!s.changed.asked.empty() || !s.changed.words.empty())
    j["changes"] = {{"without", s.changed.asked.without}, {"set", s.changed.asked.set}, {"applied", s.changed.words}};
  if (s.results)
    j["results"] = {
        {"rows", s.results->rows}, {"bytes", s.results->checksum.bytes}, {"xxh128", s.results->checksum.xxh128}};
  j["title"] = s.title;
  j["verdict"] = {{"class", to_string(s.verdict_class)}, {"sentences", s.verdict}};
  j["exit_code"] = s.exit_code;
  j["partial"] = s.partial;
  for (const auto& e : s.effects) j["effects"].push_back(effect_json(e));
  for (const auto& f : s.surfaces) j["surfaces"].push_back({{"name", f.name}, {"facts", f.text}});
  for (const auto& b : s.bodies) j["bodies"].push_back(body_json(b));
  for (const auto& v : s.variants)
    j["error_bars"].push_back({{"cause", v.cause}, {"variant", v.name}, {"poses_solved", v.poses_solved}});
  j["scales"] = {{"length_mm", 1e3 * s.length_scale}, {"force_N", s.force_scale}};
  if (s.given)
    add_given(s, j);
  else if (s.motion)
    add_motion(s, j);
  else
    add_solved(s, j);
  for (const ContactLocation& c : s.locations)
    j["contact_location"].push_back({{"contact", c.contact},
                                     {"worst_mm", number_or_null(1e3 * c.spread)},
                                     {"typical_mm", number_or_null(1e3 * c.typical_spread)},
                                     {"least_relative_curvature_per_m", number_or_null(c.least_curvature)},
                                     {"curvature_uncertainty_per_m", c.curvature_uncertainty},
                                     {"least_ratio", number_or_null(c.ratio())},
                                     {"poses_below_ratio_10", c.doubtful},
                                     {"poses", c.poses}});
  for (const HertzCheck& c : s.hertz) j["hertz"].push_back(hertz_json(c));
  for (const auto& [stage, seconds] : s.seconds) j["seconds"][stage] = seconds;
  j["machine"] = {{"hardware_threads", std::thread::hardware_concurrency()}};
  // Names come from files: whatever is no UTF-8 there is replaced, not refused.
  return j.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string to_text(const RunSummary& s) {
  std::string out;
  const auto line = [&](const std::string& name, const std::string& text) {
    out += fmt::format("  {:<12}{}\n", name, text);
  };
  for (const auto& c : s.changed.words) line(&c == &s.changed.words.front() ? "changed" : "", c);
  for (const auto& e : s.effects) line(&e == &s.effects.front() ? "effects" : "", effect_text(e));
  for (const auto& f : s.surfaces) line(&f == &s.surfaces.front() ? "surfaces" : "", f.name + ": " + f.text);
  for (const auto& b : s.bodies) line(&b == &s.bodies.front() ? "bodies" : "", to_text(b));
  if (s.motion) {
    const RunSummary::Motion& m = *s.motion;
    line("motion",
         fmt::format("{} of {} rows over {:g} s; {} steps, {} evaluations, {} Jacobians, {} starts", s.poses_solved,
                     s.poses_asked, m.duration, m.steps, m.evaluations, m.jacobians, m.starts));
    line("checks", fmt::format("constraints kept to {:.1e} of the length scale, energy to {:.1e} of {:.3g} J",
                               m.worst_residual, m.worst_energy, m.energy_scale));
  } else {
    const std::string contacts =
        s.rigid_pairs > 0 ? fmt::format("; {} to {} contacts", s.fewest_contacts, s.most_contacts) : "";
    line("poses",
         fmt::format("{} of {} solved, {} of them stable{}", s.poses_solved, s.poses_asked, s.poses_stable, contacts));
    line("newton", fmt::format("{} iterations in {} substeps, worst residual {:.1e}", s.iterations, s.substeps,
                               s.worst_residual));
  }
  if (!s.motion && std::isfinite(s.smallest_gap))
    line("certificate",
         fmt::format("smallest gap anywhere {:.1e} mm, smallest contact force {}", 1e3 * s.smallest_gap,
                     std::isfinite(s.smallest_force) ? fmt::format("{:.3f} N", s.smallest_force) : "none"));
  std::string times;
  for (const auto& [stage, seconds] : s.seconds)
    times += fmt::format("{}{} {:.3f} s", times.empty() ? "" : ", ", stage, seconds);
  line("time", times);
  for (const std::string& sentence : s.verdict) line(&sentence == &s.verdict.front() ? "verdict" : "", sentence);
  return out;
}

}  // namespace genu
