#include "genu/sweep/sweep.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "genu/assemble/changed_scene.h"
#include "genu/assemble/with_numbers.h"
#include "genu/core/file_checksum.h"
#include "genu/scene/reader.h"
#include "genu/scene/words.h"
#include "genu/store/input_hash.h"
#include "genu/study/run_scene.h"
#include "genu/sweep/read_sweep.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

/// File names without folder and ending; where two would be alike the paths from the study's folder, which are the same
/// from every working folder.
std::vector<std::string> scene_names(const SweepDef& def) {
  std::map<std::string, int> count;
  for (const SceneFileDef& scene : def.scenes) ++count[fs::path(scene.path).stem().string()];
  const auto whole = [](const std::string& path) { return fs::absolute(path).lexically_normal(); };
  const fs::path folder = whole(def.file).parent_path();
  std::vector<std::string> names;
  for (const SceneFileDef& scene : def.scenes) {
    const std::string stem = fs::path(scene.path).stem().string();
    names.push_back(count[stem] == 1 ? stem : whole(scene.path).lexically_relative(folder).generic_string());
  }
  return names;
}

/// Prepares one case. Errors of a what-if's options get its place in the study.
std::optional<Prepared> prepare_case(const SweepDef& def, const SceneSource& source, const WhatIfDef& what_if,
                                     std::shared_ptr<MeshLibrary> meshes, Diagnostics& out) {
  Diagnostics found;
  std::optional<Prepared> prepared;
  if (auto scene = read_changed_scene(source, meshes->files(), found))
    prepared = prepare(std::move(*scene), std::move(meshes), found);
  if (prepared) {
    share_search(*prepared);
    ContactField field = contact_field(*prepared);
    const bool moves = prepared->scene.dynamics.has_value();  // the start of a motion may be out of balance
    if (!moves && !check_start(*prepared, field, found)) prepared.reset();
  }
  for (Diagnostic d : found.items()) {
    if (d.severity == Diagnostic::Severity::warning && !source.changes.empty()) continue;  // said of the scene as it is
    if (d.file.empty() && d.line == 0) {
      d.file = def.file;
      d.line = what_if.where.line;
      d.column = what_if.where.column;
      d.key = "what_if." + what_if.name + (d.key == "--set" ? ".set" : ".without");
    }
    out.add(d);
  }
  return prepared;
}

bool same_factors(const std::vector<Factor>& a, const std::vector<Factor>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Factor& x, const Factor& y) { return x.name == y.name; });
}

/// The cases of one scene, added to `sweep`.
void add_scene(Sweep& sweep, const SceneFileDef& file, const std::string& name, std::string& hashed, Diagnostics& out) {
  const auto meshes = std::make_shared<MeshLibrary>();
  Diagnostics unused;
  const auto document = read_document(file.path, meshes->files(), unused);
  SceneFactors as_it_is;
  for (const WhatIfDef& what_if : sweep.def.what_ifs) {
    const SceneSource source(file.path, what_if.changes);
    auto prepared = prepare_case(sweep.def, source, what_if, meshes, out);
    const bool first = what_if.name == kAsItIs;
    if (!prepared || !document) {
      if (first) return;  // a what-if of it has the same errors
      continue;
    }
    SceneFactors factors =
        first ? find_factors(sweep.def, *prepared, *document, out) : factors_of_what_if(as_it_is, *prepared, *document);
    if (first) as_it_is = factors;
    for (const auto& [path, hash] : input_hashes(prepared->scene, meshes->files())) hashed += hash + "\n";
    hashed += change_hash(prepared->scene) + "\n";
    MainCoordinate main = main_coordinate(*prepared);
    sweep.cases.push_back({name, what_if.name, source, std::move(*prepared), std::move(factors), std::move(main)});
  }
}

/// Every scene has the factors of the first.
void check_factors(const Sweep& sweep, Diagnostics& out) {
  for (const SweepCase& other : sweep.cases) {
    if (same_factors(other.factors.factors, sweep.cases.front().factors.factors)) continue;
    const auto scene = std::find_if(sweep.def.scenes.begin(), sweep.def.scenes.end(),
                                    [&](const SceneFileDef& s) { return s.path == other.source.path; });
    out.add(error_at({sweep.def.file, scene->where}, Code::conflict, "scenes", with_quotes(scene->path),
                     fmt::format("has other varied numbers than {}: every scene needs the same names, or patterns that "
                                 "end with :together",
                                 sweep.cases.front().source.path)));
  }
}

/// The first number of a case that its what-if sets and [vary] gives to every sample; null where there is none.
const VariedNumber* overwritten(const Sweep& sweep, const SweepCase& in) {
  const std::vector<SceneEdit>& edits = in.prepared.scene.changed.edits;
  for (std::size_t f = 0; f < in.factors.factors.size(); ++f) {
    if (sweep.def.vary[in.factors.factors[f].vary].how != VaryDef::How::absolute) continue;
    for (const VariedNumber& number : in.factors.numbers[f])
      if (std::any_of(edits.begin(), edits.end(), [&](const SceneEdit& e) { return e.where == number.where; }))
        return &number;
  }
  return nullptr;
}

/// A what-if may set a number that samples multiply or add to, not one that they give.
void check_what_ifs(const Sweep& sweep, Diagnostics& out) {
  for (const WhatIfDef& what_if : sweep.def.what_ifs)
    for (const SweepCase& in : sweep.cases) {
      const VariedNumber* number = in.what_if == what_if.name ? overwritten(sweep, in) : nullptr;
      if (number == nullptr) continue;
      out.add(error_at({sweep.def.file, what_if.where}, Code::conflict, "what_if." + what_if.name + ".set", {},
                       "sets " + number->name +
                           ", and [vary] gives another value to every sample: use `relative = true` or `add = true` "
                           "there, so that samples start from the value set here"));
      break;
    }
}

void check_points(const Sweep& sweep, Diagnostics& out) {
  for (std::uint64_t s = 0; s < sweep.design.samples(); ++s) {
    const std::vector<double> draws = sweep.design.draws(s);
    for (const SweepCase& in : sweep.cases)
      for (std::size_t f = 0; f < draws.size(); ++f)
        for (const VariedNumber& number : in.factors.numbers[f]) {
          if (!number.parameter || !number.parameter->positive) continue;
          const double value = number_at(number, sweep.def.vary[sweep.factors[f].vary].how, draws[f]);
          if (value > 0) continue;
          out.error(
              Code::out_of_range, sweep.def.points,
              fmt::format("gives {} the number {:.4g} in its row {}, and it must be > 0", number.name, value, s + 1));
          return;
        }
  }
}

/// Samples whose tables are kept exist.
void check_tables(const Sweep& sweep, Diagnostics& out) {
  for (const TablesDef::Sample& sample : sweep.def.tables.samples)
    if (sample.number >= sweep.design.samples())
      out.add(error_at({sweep.def.file, sample.where}, Code::out_of_range, "tables", fmt::format("{}", sample.number),
                       fmt::format("is no sample of this study: they are 0 to {}", sweep.design.samples() - 1)));
}

}  // namespace

std::optional<Sweep> prepare_sweep(const std::string& path, Diagnostics& out) {
  InputFiles files;
  auto def = read_sweep(path, files, out);
  if (!def) return std::nullopt;
  std::string hashed = std::string(GENU_VERSION) + "\n" + files.checksum(path)->xxh128 + "\n";
  if (!def->points.empty())
    if (const auto sum = files.checksum(def->points)) hashed += sum->xxh128 + "\n";
  Sweep sweep{std::move(*def), {}, {}, {}, {}, {}, {}};
  const std::vector<std::string> names = scene_names(sweep.def);
  for (std::size_t k = 0; k < names.size(); ++k) add_scene(sweep, sweep.def.scenes[k], names[k], hashed, out);
  if (sweep.cases.empty()) return std::nullopt;
  sweep.factors = sweep.cases.front().factors.factors;
  check_factors(sweep, out);
  check_what_ifs(sweep, out);
  std::vector<const Prepared*> scenes;
  for (const SweepCase& in : sweep.cases)
    if (in.what_if == kAsItIs) scenes.push_back(&in.prepared);
  sweep.kept = find_kept(sweep.def, scenes, out);
  sweep.events = find_events(sweep.def, scenes, sweep.kept, out);
  const bool numbers_found = !out.has_errors();
  auto design = numbers_found ? SweepDesign::make(sweep.def, sweep.factors, files, out) : std::nullopt;
  if (!design) return std::nullopt;
  sweep.design = std::move(*design);
  if (sweep.def.design == DesignKind::points) check_points(sweep, out);
  check_tables(sweep, out);
  sweep.hash = checksum(hashed).xxh128;
  if (out.has_errors()) return std::nullopt;
  return sweep;
}

SceneSource source_of_sample(const Sweep& sweep, const SweepCase& in, std::uint64_t sample) {
  SceneSource source = in.source;
  const std::vector<double> draws = sweep.design.draws(sample);
  for (std::size_t f = 0; f < draws.size(); ++f)
    for (const VariedNumber& number : in.factors.numbers[f])
      if (number.surface < 0)
        source.changes.set.push_back(set_option(number, sweep.def.vary[sweep.factors[f].vary].how, draws[f]));
  return source;
}

std::vector<MeshDraw> mesh_draws(const SweepCase& in, const std::vector<double>& draws) {
  std::vector<MeshDraw> out;
  for (std::size_t f = 0; f < draws.size(); ++f)
    for (const VariedNumber& number : in.factors.numbers[f])
      if (number.surface >= 0)
        out.push_back({static_cast<std::size_t>(number.surface), number.noise, static_cast<std::uint64_t>(draws[f])});
  return out;
}

}  // namespace genu
