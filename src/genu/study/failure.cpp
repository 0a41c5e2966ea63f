#include "genu/study/failure.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include <fmt/format.h>

#include "genu/assemble/changed_scene.h"
#include "genu/assemble/scene_values.h"
#include "genu/core/atomic_output.h"
#include "genu/core/program_hash.h"
#include "genu/core/scratch_folder.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/mesh_files/mesh_writer.h"
#include "genu/store/stop_of.h"
#include "genu/study/run_scene.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOutOfMemory = "out of memory";

std::string file_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Without the folders of names that lead from the root: nobody is told where the user keeps what.
std::string without_folders(const std::string& text) {
  static const std::regex kFolders(R"((^|[\s"'=(,:])/(?:[^\s"'/]+/)+)");
  return std::regex_replace(text, kFolders, "$1");
}

/// Numbers as #: they differ in the last digits where a mesh is cut.
std::string without_numbers(const std::string& text) {
  static const std::regex kNumber(R"([-+]?[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?)");
  return std::regex_replace(text, kNumber, "#");
}

/// The files of a scene, their names in the pack, and names in messages made those.
struct Names {
  std::vector<std::pair<std::string, std::string>> files;  ///< path and name
  std::string scene, folder;

  std::string name_of(const std::string& own) {
    const std::string path = fs::path(own).is_absolute() ? own : (fs::path(folder) / own).string();
    for (const auto& [known, name] : files)
      if (known == path) return name;
    files.emplace_back(path, fmt::format("mesh{}{}", files.size() + 1, fs::path(own).extension().string()));
    return files.back().second;
  }

  std::string told(std::string text) const {
    const auto replace = [&](const std::string& what, const std::string& with) {
      for (std::size_t k = 0; !what.empty() && (k = text.find(what, k)) != std::string::npos; k += with.size())
        text.replace(k, what.size(), with);
    };
    for (const auto& [path, name] : files) {
      replace(path, name);
      replace(fs::path(path).lexically_normal().string(), name);
    }
    replace(scene, "scene.toml");
    if (!folder.empty()) replace(folder + "/", "");
    return without_folders(text);
  }
};

std::vector<std::string> verdict_of(const Names& names, const Solution* found, std::size_t from_row,
                                    const Diagnostics& out) {
  std::vector<std::string> lines;
  const auto add = [&](const std::string& line) { lines.push_back(without_numbers(names.told(line))); };
  if (found == nullptr) {
    for (const Diagnostic& d : out.items())
      if (d.severity == Diagnostic::Severity::error) add("refused: " + to_string(d));
    return lines;
  }
  if (!found->stopped.empty()) add("stopped: " + found->stopped);
  if (found->summary.motion && !found->summary.verdict.empty() && found->stopped.empty())
    add("motion: " + found->summary.verdict.front());
  for (std::size_t k = from_row; k < found->records.size(); ++k) {
    const PosePoint& p = found->records[k].point;
    if (p.solved()) continue;
    const std::string row = fmt::format("step {} increment {}: {}", p.step, p.increment, to_string(p.report.status));
    lines.push_back(row + without_numbers(names.told(p.report.why.empty() ? "" : ": " + p.report.why)));
  }
  return lines;
}

/// The triangles of a mesh within `reach` (m) of some points of its body.
std::string cut_mesh(const SurfaceDef& def, MeshLibrary& meshes, const std::vector<Vec3>& feet, double reach) {
  Diagnostics ignored;
  const auto mesh = meshes.read(def.file, def.file_unit, ignored);
  if (!mesh) return {};
  const Pose back = def.placement.inverse();
  std::vector<Vec3> places;
  for (const Vec3& p : feet) places.push_back(back * p);
  std::vector<int> number(mesh->vertices.size(), -1);
  std::vector<char> near(mesh->vertices.size());
  for (std::size_t i = 0; i < near.size(); ++i)
    near[i] = std::any_of(places.begin(), places.end(),
                          [&](const Vec3& p) { return (mesh->vertices[i] - p).norm() < reach; });
  Mesh cut;
  for (const auto& t : mesh->triangles) {
    if (std::none_of(t.begin(), t.end(), [&](int i) { return near[at(i)] != 0; })) continue;
    auto corner = t;
    for (int& i : corner) {
      if (number[at(i)] < 0) {
        number[at(i)] = static_cast<int>(cut.vertices.size());
        cut.vertices.push_back(mesh->vertices[at(i)]);
      }
      i = number[at(i)];
    }
    cut.triangles.push_back(corner);
  }
  if (cut.triangles.empty() || cut.triangles.size() == mesh->triangles.size()) return {};
  return ply_bytes(cut, def.file_unit, "cut out round contact");
}

/// Where a surface is touched in the rows since the path rested, in its body.
std::vector<Vec3> feet_on(int surface, const Prepared& prepared, const Solution& found) {
  std::vector<Vec3> feet;
  const std::size_t first = found.rest_rows > 0 ? found.rest_rows - 1 : 0;
  for (std::size_t k = first; k < found.records.size(); ++k)
    for (const ActiveContact& c : found.records[k].point.pose.state.contacts) {
      const ContactDef& def = prepared.scene.contacts[at(c.pair)];
      if (def.surface_a == surface) feet.push_back(c.geometry.a.p);
      if (def.surface_b == surface) feet.push_back(c.geometry.b.p);
    }
  return feet;
}

/// `whole` with the meshes of surfaces in contact cut out; empty where none can be.
std::optional<Failure> cut_out(const Failure& whole, Names& names, const Prepared& prepared, const Solution& found,
                               double reach) {
  Failure cut = whole;
  bool any = false;
  for (std::size_t i = 0; i < prepared.scene.surfaces.size(); ++i) {
    const SurfaceDef& def = prepared.scene.surfaces[i];
    if (def.shape != SurfaceDef::Shape::mesh) continue;
    const auto users = std::count_if(prepared.scene.surfaces.begin(), prepared.scene.surfaces.end(),
                                     [&](const SurfaceDef& other) { return other.file == def.file; });
    const std::string bytes =
        users == 1 && !def.file.several()
            ? cut_mesh(def, *prepared.meshes, feet_on(static_cast<int>(i), prepared, found), reach)
            : "";
    if (bytes.empty()) continue;
    const std::string old = names.name_of(def.file.text()), name = fs::path(old).stem().string() + ".ply";
    for (auto& [known, content] : cut.meshes)
      if (known == old) known = name, content = bytes;
    cut.scene = with_mesh_names(cut.scene, [&](const std::string& n) { return n == old ? name : n; });
    any = true;
  }
  cut.meshes_are = fmt::format("within {:g} mm of contact", 1e3 * reach);
  return any ? std::optional(cut) : std::nullopt;
}

constexpr const char* kPackedScene = "scene.toml";

/// Whether it does so again, unpacked by itself; `problem`: why that could not be tried.
bool fails_alike(const Failure& failure, const RunOptions& options, std::string& problem) {
  const ScratchFolder folder("genu-failure");
  problem = folder.problem();
  if (problem.empty()) problem = unpack(failure, folder.path().string());
  return problem.empty() && alike(failure.verdict, reproduce(failure, folder.path().string(), options));
}

void tell_poses(const Prepared& prepared, const Solution& found, Failure& failure) {
  constexpr std::size_t kPosesKept = 3;
  for (std::size_t k = found.records.size(); k-- > 0 && failure.last_poses.size() < kPosesKept;) {
    const PosePoint& p = found.records[k].point;
    if (!p.solved()) continue;
    std::string line = fmt::format("row {} step {} increment {} t {:a}:", k + 1, p.step, p.increment, p.t);
    for (std::size_t j = 0; j < p.pose.state.coordinates.size(); ++j)
      line += fmt::format(" {} ({:a})", prepared.model.joints[j].name, fmt::join(p.pose.state.coordinates[j], " "));
    for (const ActiveContact& c : p.pose.state.contacts)
      line += fmt::format(" {}.{} {:a} N", prepared.model.pairs[at(c.pair)].name, c.number, c.force);
    failure.last_poses.push_back(line);
  }
  std::istringstream rows(found.event_rows.to_csv());
  for (std::string line; std::getline(rows, line);) failure.events.push_back(line);
}

}  // namespace

bool alike(std::vector<std::string> expected, std::vector<std::string> found) {
  // A mesh that was cut out may have another ending.
  static const std::regex kMesh("mesh#\\.[A-Za-z]+");
  for (auto* lines : {&expected, &found})
    for (std::string& line : *lines) line = std::regex_replace(line, kMesh, "mesh");
  return expected == found;
}

std::string unpack(const Failure& failure, const std::string& folder) {
  std::string error = write_file_atomically(fs::path(folder) / kPackedScene, failure.scene);
  for (const auto& [name, bytes] : failure.meshes)
    if (error.empty()) error = write_file_atomically(fs::path(folder) / name, bytes);
  return error;
}

std::vector<std::string> reproduce(const Failure& failure, const std::string& folder, const RunOptions& options) {
  Names names;
  names.folder = folder;
  names.scene = (fs::path(folder) / kPackedScene).string();
  Diagnostics out;
  const auto prepared = prepare(names.scene, out);
  if (!prepared) return verdict_of(names, nullptr, 0, out);
  RunOptions own = options;
  own.checkpoint = nullptr;
  own.keep_partial = true;
  own.keep_rest = false;
  own.from = failure.rest;
  const auto found = prepared->scene.dynamics ? move_all(*prepared, own, out) : solve_all(*prepared, own, out);
  return verdict_of(names, found ? &*found : nullptr, 0, out);
}

void save_failure(const std::string& file, const std::string& scene, const Prepared* prepared, const Solution& found,
                  const RunOptions& options, Diagnostics& out) {
  const auto say = [&](Code code, const std::string& rule) { out.warning(code, file, rule); };
  const bool refused = found.records.empty() && found.stopped.empty() && !found.summary.motion;
  if (!refused && all_solved(found.summary.exit_code))
    return say(Code::not_applicable, "is not written: nothing failed");
  Names names;
  names.scene = scene;
  names.folder = fs::path(scene).parent_path().string();
  Failure failure;
  failure.version = GENU_VERSION;
  failure.program = program_hash();
  failure.scene = file_bytes(scene);
  if (failure.scene.empty()) return say(Code::cannot_read, "is not written: the scene cannot be read");
  if (prepared != nullptr) failure.scene = with_changes(failure.scene, prepared->scene, out);
  failure.scene =
      without_folders(with_mesh_names(failure.scene, [&](const std::string& own) { return names.name_of(own); }));
  failure.rest = found.rest;
  failure.verdict = verdict_of(names, refused ? nullptr : &found, found.rest_rows, out);
  for (const Diagnostic& d : out.items()) failure.messages.push_back(names.told(to_string(d)));
  for (const std::string& line : found.summary.verdict) failure.messages.push_back(names.told(line));
  if (prepared != nullptr) tell_poses(*prepared, found, failure);
  failure.meshes_are = "whole";
  std::vector<Failure> trials;
  if (refused && !names.files.empty()) {
    trials.push_back(failure);
    trials.back().meshes_are = "left out: the failure does not need them";
    for (const auto& [path, name] : names.files) trials.back().meshes.emplace_back(name, std::string());
  }
  for (const auto& [path, name] : names.files) failure.meshes.emplace_back(name, file_bytes(path));
  if (names.files.empty()) failure.meshes_are = "none";
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) failure.memory_limit = limit.rlim_cur;
  const bool out_of_memory = found.stopped == kOutOfMemory;
  if (prepared != nullptr && !refused && !out_of_memory && !found.summary.motion)
    for (const double reach : {5e-3, 10e-3, 20e-3, 40e-3})
      if (const auto cut = cut_out(failure, names, *prepared, found, reach)) trials.push_back(*cut);
  trials.push_back(failure);
  std::string problem;
  auto alike = std::find_if(trials.begin(), trials.end(),
                            [&](const Failure& f) { return !out_of_memory && fails_alike(f, options, problem); });
  const bool tried = alike != trials.end();
  const Failure& kept = tried ? *alike : trials.back();
  if (const std::string error = write_file_atomically(file, to_json(kept)); !error.empty())
    return out.error(Code::cannot_write, "", error);
  say(Code::not_solved, "holds what genu reproduce needs; meshes: " + kept.meshes_are +
                            (tried || out_of_memory ? ""
                             : problem.empty()      ? "; but a trial did not fail in the same way"
                                               : "; whether it fails in the same way could not be tried: " + problem));
}

}  // namespace genu
