#include "studies/dortmans_study.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/results/chart.h"

namespace genu::studies {
namespace {

constexpr std::size_t kEvery = 10;  // rows, of a degree each, in the tables

struct Source {
  const char *file, *chart, *words;
};
constexpr Source kReadings[] = {
    {"scene.toml", "study-ring-15.svg", "ring 15 mm, tube 5 mm: the condyle's sagittal radius is 20 mm"},
    {"scene-outer-15.toml", "study-outer-15.svg", "sagittal radius 15 mm, tube 5 mm: the ring is 10 mm"}};

std::vector<double> since_start(std::vector<double> values, double factor) {
  const double first = values.empty() ? 0 : values.front();
  for (double& v : values) v = factor * (v - first) + 0.0;  // no -0
  return values;
}

/// The contact of a pair at a row; null where it is open or the row was not solved.
const ActiveContact* contact_at(const SolvedScene& scene, std::size_t row, const std::string& pair) {
  const State& state = scene.solution.records[row].point.pose.state;
  for (const ActiveContact& c : state.contacts)
    if (scene.prepared.model.pairs[static_cast<std::size_t>(c.pair)].name == pair) return &c;
  return nullptr;
}

ContactShift shift_of(const SolvedScene& scene, const std::string& pair) {
  ContactShift shift{pair, {0}, {0}, {0}};
  for (std::size_t row = 1; row < scene.solution.records.size(); ++row) {
    const ActiveContact *before = contact_at(scene, row - 1, pair), *now = contact_at(scene, row, pair);
    if (before == nullptr || now == nullptr) return shift;
    const auto& p = scene.prepared.model.pairs[static_cast<std::size_t>(now->pair)];  // a: femur, b: tibia
    const auto rotation = [&](std::size_t k) {
      const auto& poses = scene.solution.records[k].point.pose.state.poses;
      return Mat3(poses[static_cast<std::size_t>(p.body_b)].R.transpose() *
                  poses[static_cast<std::size_t>(p.body_a)].R);
    };
    const Vec3 on_femur = now->geometry.a.p - before->geometry.a.p, on_tibia = now->geometry.b.p - before->geometry.b.p;
    const Vec3 turned = 0.5 * (rotation(row - 1) + rotation(row)) * on_femur;
    shift.femur.push_back(shift.femur.back() + on_femur.norm());
    shift.tibia.push_back(shift.tibia.back() + on_tibia.norm());
    shift.sliding.push_back(shift.sliding.back() + (turned - on_tibia).norm());
  }
  return shift;
}

std::vector<double> millimetres(std::vector<double> values) {
  for (double& v : values) v *= to::kMillimetre;
  return values;
}

Chart chart_of(const DortmansReading& r) {
  std::vector<ChartSeries> paths, shares;
  for (const ContactShift& s : r.shifts) {
    paths.push_back({s.name + " femur", millimetres(s.femur)});
    paths.push_back({s.name + " tibia", millimetres(s.tibia)});
    std::vector<double> share(1, std::nan(""));
    for (std::size_t k = 1; k < s.femur.size(); ++k) share.push_back(sliding_share(s, k - 1, k));
    shares.push_back({s.name, share});
  }
  Chart chart;
  chart.title = "Dortmans 1984, " + r.words;
  chart.x_title = "flexion [deg]";
  chart.x = r.flexion;
  chart.panels = {{"exorotation of the femur since extension [deg]", {{"exorotation", r.exorotation}}, true, false},
                  {"strain since extension [1]",
                   {{"AAC (anterior part)", r.anterior_strain}, {"PAC (posterior part)", r.posterior_strain}},
                   true,
                   false},
                  {"path of the contact since extension [mm]", paths, true, false},
                  {"sliding, as a share of the femur's path [1]", shares, true, false}};
  return chart;
}

std::string table_of(const DortmansReading& r) {
  std::string out =
      "| flexion deg | exorotation deg | AAC strain | PAC strain | medial: femur mm | tibia mm | sliding | lateral: "
      "femur mm | tibia mm | sliding |\n|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  for (std::size_t row = 0; row < r.flexion.size(); row += kEvery) {
    out += fmt::format("| {:.0f} | {:.2f} | {:+.4f} | {:+.4f} |", std::round(r.flexion[row]) + 0.0, r.exorotation[row],
                       r.anterior_strain[row], r.posterior_strain[row]);
    for (const ContactShift& s : r.shifts) {
      const std::string share = row == 0 ? "" : fmt::format("{:.0f} %", 100 * sliding_share(s, row - kEvery, row));
      out +=
          fmt::format(" {:.2f} | {:.2f} | {} |", to::kMillimetre * s.femur[row], to::kMillimetre * s.tibia[row], share);
    }
    out += "\n";
  }
  return out;
}

bool complete(const DortmansReading& r) {
  return r.all_stable && r.shifts[0].femur.size() == r.flexion.size() && r.shifts[1].femur.size() == r.flexion.size();
}

}  // namespace

double sliding_share(const ContactShift& shift, std::size_t from, std::size_t to) {
  return (shift.sliding[to] - shift.sliding[from]) / (shift.femur[to] - shift.femur[from]);
}

DortmansReading reading_of(const SolvedScene& scene) {
  DortmansReading r;
  r.flexion = scene.column("knee.flexion_deg");
  r.exorotation = since_start(scene.column("knee.rotation_deg"), -1);
  r.anterior_strain = since_start(scene.column("AAC.strain"), 1);
  r.posterior_strain = since_start(scene.column("PAC.strain"), 1);
  r.moment = scene.column("knee.flexion.reaction_Nm");
  for (const LigamentDef& l : scene.prepared.scene.ligaments) {
    r.springs.push_back(l.name);
    r.strains.push_back(since_start(scene.column(l.name + ".strain"), 1));
  }
  r.shifts = {shift_of(scene, "medial"), shift_of(scene, "lateral")};
  r.all_stable = scene.all_stable();
  return r;
}

std::vector<DortmansReading> solve_dortmans(const std::string& folder, Diagnostics& out) {
  std::vector<DortmansReading> readings;
  for (const Source& source : kReadings) {
    const auto scene = solve_scene(folder + "/" + source.file, out);
    if (!scene) continue;
    DortmansReading r = reading_of(*scene);
    r.scene = source.file;
    r.words = source.words;
    readings.push_back(std::move(r));
  }
  return readings;
}

Files dortmans_files(const std::vector<DortmansReading>& readings) {
  std::string text =
      "# The three figures of the report, in numbers\n\n"
      "Written by `tools/figures`; do not edit. [SOURCE.md](SOURCE.md) says what is the report's and what is "
      "reconstructed.\n\n"
      "Exorotation: of the femur on the tibia (the tibia turns inward). Strains: less those in extension. Paths: of "
      "the "
      "contact point along\neither surface since extension; sliding: how far the surfaces moved on one another there, "
      "as "
      "a share of the femur's path over the last\n10 degrees (0 % is pure rolling).\n";
  Files files;
  for (const DortmansReading& r : readings) {
    const auto source =
        std::find_if(std::begin(kReadings), std::end(kReadings), [&](const Source& s) { return r.scene == s.file; });
    text += fmt::format("\n## {} (`{}`)\n\n", r.words, r.scene);
    if (!complete(r)) {
      text += "Not every pose was solved and stable.\n";
      continue;
    }
    text += table_of(r) +
            fmt::format("\n![Rotation, strains, contact paths and sliding over flexion]({})\n", source->chart);
    files.emplace_back(source->chart, to_svg(chart_of(r)));
  }
  files.emplace_back("STUDY.md", text);
  return files;
}

}  // namespace genu::studies
