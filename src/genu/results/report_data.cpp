#include "genu/results/report_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <nlohmann/json.hpp>

#include "genu/core/units.h"
#include "genu/results/ligament_groups.h"
#include "genu/results/packed_numbers.h"
#include "genu/results/report_page.h"

namespace genu {
namespace {

using nlohmann::ordered_json;

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

ordered_json vector_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
ordered_json place_json(const Vec3& p) { return vector_json(to::kMillimetre * p); }

/// To 0.1 um: there are many, and they are only looked at.
ordered_json short_place_json(const Vec3& p) {
  constexpr double kPlaceParts = 1e4;  // of a mm
  return vector_json(((kPlaceParts * to::kMillimetre * p).array().round() / kPlaceParts).matrix());
}

/// Origin of the page: poses are relative to it, so that single precision serves however far away it is.
Vec3 origin_of(const JointModel& model) {
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (model.bodies[i].moving >= 0) return model.reference_poses[i].p;
  return Vec3::Zero();
}

/// Of each row and body a quaternion and the place of the origin (mm).
std::string poses_text(const ReportRun& run, const std::vector<std::vector<Pose>>& rows) {
  const Vec3 origin = origin_of(*run.model);
  const std::size_t bodies = run.model->bodies.size();
  std::vector<double> numbers;
  numbers.reserve(rows.size() * bodies * 7);
  for (const std::vector<Pose>& row : rows)
    for (std::size_t b = 0; b < bodies; ++b) {
      if (row.size() != bodies) {
        numbers.insert(numbers.end(), 7, kMissing);
        continue;
      }
      const Eigen::Quaterniond q(row[b].R);
      const Vec3 p = to::kMillimetre * (row[b].p - origin);
      for (const double v : {q.x(), q.y(), q.z(), q.w(), p.x(), p.y(), p.z()}) numbers.push_back(v);
    }
  return packed_floats(numbers);
}

std::string points_text(const std::vector<Vec3>& points, double factor) {
  std::vector<double> numbers;
  for (const Vec3& p : points)
    for (Eigen::Index i = 0; i < 3; ++i) numbers.push_back(factor * p[i]);
  return packed_floats(numbers);
}

ordered_json mesh_json(const ReportMesh& mesh) {
  constexpr const char* kKinds[] = {"surface", "bone", "wrapped"};
  std::vector<Vec3> mm;
  for (const Vec3& v : mesh.vertices) mm.push_back(to::kMillimetre * v);
  const PackedPoints points = packed_points(mm);
  ordered_json j = {{"name", mesh.name},
                    {"body", mesh.body},
                    {"kind", kKinds[static_cast<int>(mesh.kind)]},
                    {"triangles", mesh.triangles.size()},
                    {"triangles_in_full", mesh.triangles_in_full},
                    {"low", vector_json(points.low)},
                    {"step", points.step},
                    {"points", points.integers}};
  constexpr std::size_t kShort = 65536;
  if (mesh.vertices.size() <= kShort) {
    std::vector<std::uint16_t> corners;
    for (const auto& t : mesh.triangles)
      for (const int i : t) corners.push_back(static_cast<std::uint16_t>(i));
    j["corners16"] = packed(corners);
  } else {
    std::vector<std::uint32_t> corners;
    for (const auto& t : mesh.triangles)
      for (const int i : t) corners.push_back(static_cast<std::uint32_t>(i));
    j["corners32"] = packed(corners);
  }
  return j;
}

ordered_json bodies_json(const ReportRun& run) {
  ordered_json j = ordered_json::array();
  for (std::size_t i = 0; i < run.model->bodies.size(); ++i) {
    const JointModel::Body& b = run.model->bodies[i];
    ordered_json one = {{"name", b.name}, {"fixed", b.moving < 0}, {"centre", place_json(b.centre)}};
    const BodyDef& def = run.scene->bodies[i];
    if (def.mass > 0) one["centre_of_mass"] = place_json(def.centre_of_mass);
    j.push_back(std::move(one));
  }
  return j;
}

/// The course of a ligament in each row; null where it does not wrap.
ordered_json courses_json(const ReportRun& run, std::size_t ligament) {
  ordered_json rows;
  for (const ReportPath& path : run.wrapped) {
    if (at(path.ligament) != ligament) continue;
    for (const auto& row : path.rows) {
      ordered_json course = ordered_json::array();
      for (const ReportPath::Point& point : row)
        course.push_back({{"body", point.body}, {"point", short_place_json(point.p)}});
      rows.push_back(std::move(course));
    }
  }
  return rows;
}

ordered_json ligaments_json(const ReportRun& run) {
  const PlacedScene& scene = *run.scene;
  std::vector<std::string> group(scene.ligaments.size());
  for (const LigamentGroup& g : ligament_groups(scene))
    for (const std::size_t member : g.members) group[member] = g.name;
  ordered_json j = ordered_json::array();
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    const LigamentDef& l = scene.ligaments[i];
    ordered_json path = ordered_json::array();
    for (const LigamentDef::End& end : l.path_points())
      path.push_back({{"body", end.body}, {"point", place_json(end.point)}});
    j.push_back({{"name", l.name}, {"group", group[i]}, {"path", path}});
    if (ordered_json rows = courses_json(run, i); !rows.is_null()) j.back()["rows"] = std::move(rows);
  }
  return j;
}

ordered_json joints_json(const ReportRun& run) {
  constexpr const char* kTypes[] = {"free", "revolute", "fixed"};
  ordered_json j = ordered_json::array();
  for (const JointDef& joint : run.scene->joints) {
    ordered_json one = {{"name", joint.name},
                        {"type", kTypes[static_cast<int>(joint.type)]},
                        {"parent", joint.parent},
                        {"child", joint.child},
                        {"origin", place_json(own_origin(*run.model, joint.child))},
                        {"axis", vector_json(joint.rotations[0].axis)}};
    if (joint.type == JointDef::Type::free) one["translations"] = joint.translations;
    if (joint.grood_suntay && !joint.grood_suntay->patella) {
      const GroodSuntayDef& def = *joint.grood_suntay;
      one["right"] = def.right;
      for (const auto& [name, bone] : {std::pair("femur", &def.femur), std::pair("tibia", &def.tibia)})
        one[name] = {
            {"body", bone->body}, {"proximal", vector_json(bone->proximal)}, {"anterior", vector_json(bone->anterior)}};
    }
    j.push_back(std::move(one));
  }
  return j;
}

ordered_json contacts_json(const std::vector<ReportContact>& contacts) {
  ordered_json j = ordered_json::array();
  for (const ReportContact& c : contacts)
    j.push_back({{"name", c.name},
                 {"surface", c.surface},
                 {"body_a", c.body_a},
                 {"body_b", c.body_b},
                 {"point", points_text(c.point, to::kMillimetre)},
                 {"force", points_text(c.force, 1)}});
  return j;
}

/// The rigid contacts of the scene: whose gaps the page may colour.
ordered_json pairs_json(const ReportRun& run) {
  ordered_json j = ordered_json::array();
  for (std::size_t i = 0; i < run.model->pairs.size() && i < run.scene->contacts.size(); ++i) {
    const ContactDef& contact = run.scene->contacts[i];
    j.push_back({{"name", contact.name},
                 {"surface_a", run.scene->surfaces[at(contact.surface_a)].name},
                 {"surface_b", run.scene->surfaces[at(contact.surface_b)].name},
                 {"body_a", run.model->pairs[i].body_a},
                 {"body_b", run.model->pairs[i].body_b}});
  }
  return j;
}

/// Pressures in 65535 parts of the largest, row after row: `starts` of each row among the samples.
ordered_json pressures_json(const std::vector<ReportPressure>& pressures) {
  constexpr double kParts = 65535;
  ordered_json j = ordered_json::array();
  for (const ReportPressure& map : pressures) {
    double most = 0;
    for (const auto& row : map.rows)
      for (const auto& sample : row) most = std::max(most, sample.pressure);
    std::vector<std::uint32_t> starts = {0}, sites;
    std::vector<std::uint16_t> parts;
    for (const auto& row : map.rows) {
      for (const auto& sample : row) {
        sites.push_back(static_cast<std::uint32_t>(sample.site));
        parts.push_back(static_cast<std::uint16_t>(std::lround(kParts * sample.pressure / most)));
      }
      starts.push_back(static_cast<std::uint32_t>(sites.size()));
    }
    ordered_json one = {{"contact", map.contact}, {"surface", map.surface},
                        {"body", map.body},       {"most_MPa", most / units::kMegapascal},
                        {"every", map.every},     {"starts", packed(starts)},
                        {"parts", packed(parts)}};
    const std::size_t count = map.mesh >= 0 ? map.triangles.size() : map.places.size();
    constexpr std::size_t kShort = 65536;
    if (count <= kShort)
      one["sites16"] = packed(std::vector<std::uint16_t>(sites.begin(), sites.end()));
    else
      one["sites32"] = packed(sites);
    if (map.mesh >= 0) {
      one["mesh"] = map.mesh;
      one["triangles"] = packed(std::vector<std::uint32_t>(map.triangles.begin(), map.triangles.end()));
    } else {
      std::vector<Vec3> mm;
      for (const Vec3& p : map.places) mm.push_back(to::kMillimetre * p);
      const PackedPoints points = packed_points(mm);
      std::vector<double> radii_mm;
      for (const double r : map.radii) radii_mm.push_back(to::kMillimetre * r);
      one["low"] = vector_json(points.low);
      one["step"] = points.step;
      one["points"] = points.integers;
      one["radii"] = packed_floats(radii_mm);
    }
    j.push_back(std::move(one));
  }
  return j;
}

ordered_json beside_json(const std::vector<ReportBeside>& tables) {
  ordered_json j = ordered_json::array();
  for (const ReportBeside& table : tables) {
    ordered_json columns = ordered_json::array();
    for (const auto& c : table.columns)
      columns.push_back({{"column", c.column}, {"in_file", c.in_file}, {"numbers", packed_floats(c.numbers)}});
    j.push_back({{"name", table.name}, {"columns", std::move(columns)}});
  }
  return j;
}

/// A column of numbers, or of words with the index of each row's word (65535: none).
ordered_json column_json(const ResultTable& table, std::size_t column) {
  std::vector<double> numbers(table.rows(), kMissing);
  std::vector<std::uint16_t> places(table.rows(), std::numeric_limits<std::uint16_t>::max());
  std::map<std::string, std::uint16_t> known;
  ordered_json words = ordered_json::array();
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const Cell& cell = table.at(row, column);
    if (const double* number = std::get_if<double>(&cell)) numbers[row] = *number;
    if (const long* whole = std::get_if<long>(&cell)) numbers[row] = static_cast<double>(*whole);
    const std::string* word = std::get_if<std::string>(&cell);
    if (word == nullptr) continue;
    const auto [place, fresh] = known.emplace(*word, static_cast<std::uint16_t>(known.size()));
    if (fresh) words.push_back(*word);
    places[row] = place->second;
  }
  ordered_json j = {{"name", table.columns()[column]}};
  if (known.empty()) {
    j["numbers"] = packed_floats(numbers);
  } else {
    j["words"] = words;
    j["places"] = packed(places);
  }
  return j;
}

ordered_json table_json(const ResultTable& table) {
  ordered_json j = ordered_json::array();
  for (std::size_t c = 0; c < table.columns().size(); ++c) j.push_back(column_json(table, c));
  return j;
}

ordered_json chart_json(const Chart& chart) {
  constexpr const char* kKinds[] = {"gained", "lost", "window", "other"};
  ordered_json j = {{"x_title", chart.x_title}, {"x", packed_floats(chart.x)}, {"panels", ordered_json::array()}};
  for (const ChartPanel& panel : chart.panels) {
    ordered_json series = ordered_json::array();
    for (const ChartSeries& s : panel.series) {
      ordered_json one = {{"name", s.name}, {"y", packed_floats(s.y)}};
      if (!s.bar.empty()) one["bar"] = packed_floats(s.bar);
      if (!s.column.empty()) one["column"] = s.column;
      series.push_back(std::move(one));
    }
    j["panels"].push_back({{"title", panel.title}, {"from_zero", panel.from_zero}, {"series", series}});
  }
  j["breaks"] = chart.breaks;
  j["events"] = ordered_json::array();
  for (const ChartEvent& e : chart.events)
    j["events"].push_back(
        {{"kind", kKinds[static_cast<int>(e.kind)]}, {"from", e.from}, {"to", e.to}, {"text", e.text}});
  return j;
}

ordered_json summary_json(const RunSummary& s) {
  ordered_json effects = ordered_json::array(), surfaces = ordered_json::array(), bodies = ordered_json::array(),
               variants = ordered_json::array();
  for (const auto& e : s.effects) effects.push_back({{"name", e.name}, {"count", e.count}, {"unknowns", e.unknowns}});
  for (const auto& f : s.surfaces) surfaces.push_back({{"name", f.name}, {"facts", f.text}});
  for (const auto& b : s.bodies) bodies.push_back(to_text(b));
  for (const auto& v : s.variants)
    variants.push_back({{"cause", v.cause}, {"name", v.name}, {"poses_solved", v.poses_solved}});
  ordered_json j = {{"version", s.version},   {"title", s.title},
                    {"scene", s.scene_file},  {"class", to_string(s.verdict_class)},
                    {"verdict", s.verdict},   {"exit_code", s.exit_code},
                    {"asked", s.poses_asked}, {"solved", s.poses_solved},
                    {"effects", effects},     {"surfaces", surfaces},
                    {"bodies", bodies},       {"error_bars", variants}};
  if (!s.motion) j["stable"] = s.poses_stable;
  const auto add = [&](const char* name, double value) {
    if (!s.motion && std::isfinite(value)) j[name] = value;
  };
  add("smallest_gap_mm", to::kMillimetre * s.smallest_gap);
  add("smallest_force_N", s.smallest_force);
  add("worst_residual", s.worst_residual);
  if (s.motion) j["motion"] = {{"duration_s", s.motion->duration}, {"method", s.motion->method}};
  return j;
}

ordered_json run_json(const ReportRun& run) {
  ordered_json meshes = ordered_json::array();
  for (const ReportMesh& mesh : run.meshes) meshes.push_back(mesh_json(mesh));
  ordered_json j = {{"summary", summary_json(*run.summary)},
                    {"scene_text", run.scene_text},
                    {"motion", run.scene->dynamics.has_value()},
                    {"rows", run.poses->rows()},
                    {"bodies", bodies_json(run)},
                    {"origin", place_json(origin_of(*run.model))},
                    {"poses", poses_text(run, run.body_poses)},
                    {"reference", poses_text(run, {run.model->reference_poses})},
                    {"meshes", std::move(meshes)},
                    {"ligaments", ligaments_json(run)},
                    {"joints", joints_json(run)},
                    {"contacts", contacts_json(run.contacts)},
                    {"pairs", pairs_json(run)},
                    {"pressures", pressures_json(run.pressures)},
                    {"coordinates", run.coordinates},
                    {"main_coordinate", run.main_coordinate},
                    {"every", run.every},
                    {"rows_in_full", run.every > 1 ? run.rows_in_full : run.poses->rows()},
                    {"beside", beside_json(run.beside)},
                    {"table", table_json(*run.poses)},
                    {"chart", chart_json(run.chart)},
                    {"events_in_full", std::max(run.events_in_full, run.chart.events.size())},
                    {"left_out", run.left_out},
                    {"event_rows", run.events->rows()}};
  if (run.scene->gravity) j["gravity"] = vector_json(*run.scene->gravity);
  return j;
}

std::string one_line(const ordered_json& json) {
  return html_safe_json(json.dump(-1, ' ', true, ordered_json::error_handler_t::replace));
}

}  // namespace

std::string report_data(const std::vector<ReportRun>& runs) {
  ordered_json j = {{"format", kReportFormat}, {"runs", ordered_json::array()}};
  for (const ReportRun& run : runs) j["runs"].push_back(run_json(run));
  return one_line(j);
}

std::string report_times(const std::vector<ReportRun>& runs) {
  ordered_json j = {{"runs", ordered_json::array()}};
  for (const ReportRun& run : runs) {
    ordered_json effects = ordered_json::array(), stages = ordered_json::array();
    for (const auto& e : run.summary->effects)
      effects.push_back(e.evaluations ? ordered_json{{"evaluations", *e.evaluations}, {"seconds", e.seconds}}
                                      : ordered_json(nullptr));
    for (const auto& [stage, seconds] : run.summary->seconds) stages.push_back({{"name", stage}, {"seconds", seconds}});
    j["runs"].push_back({{"effects", effects}, {"stages", stages}});
  }
  return one_line(j);
}

}  // namespace genu
