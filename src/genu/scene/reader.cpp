#include "genu/scene/reader.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/scene/leave_out_bodies.h"
#include "genu/scene/read_parts.h"
#include "genu/scene/tolerances.h"
#include "genu/scene/toml_document.h"
#include "genu/scene/utf8.h"
#include "genu/scene/words.h"

namespace genu {

namespace fs = std::filesystem;

namespace {

std::shared_ptr<const std::string> read_text(const std::string& path, InputFiles& files, Diagnostics& out) {
  std::error_code failed;
  const fs::file_status status = fs::status(path, failed);
  std::optional<Fault> fault;
  if (path.empty()) {
    fault = {Code::no_such_file, "no scene file is named"};
  } else if (status.type() == fs::file_type::not_found) {
    fault = {Code::no_such_file, "no such file"};
  } else if (failed) {
    fault = {Code::cannot_read, "cannot be read: " + failed.message()};
  } else if (fs::is_directory(status)) {
    fault = {Code::is_folder,
             "is a folder; name the scene file in it, e.g. " + (fs::path(path) / "scene.toml").string()};
  } else if (!fs::is_regular_file(status)) {
    fault = {Code::cannot_read, "is not a regular file"};
  }
  if (fault) {
    out.error(fault->code, path, fault->text);
    return nullptr;
  }

  if (fs::file_size(path, failed) > kMaxSceneBytes && !failed) {
    out.error(Code::too_large, path, fmt::format("is larger than {} MB: not a scene file", kMaxSceneBytes >> 20));
    return nullptr;
  }
  auto text = files.bytes(path);
  if (!text) out.error(Code::cannot_read, path, "cannot be read");
  return text;
}

void read_units(ReadContext& context, Section& root) {
  const Item item = root.require("units");
  if (!is_table(context, item)) return;
  Section units(context, item, "units");
  const std::vector<std::string> lengths = {"mm", "m"}, angles = {"deg", "rad"};
  const Item length = units.require("length");
  if (const auto k = read_choice(context, length, lengths)) {
    context.scene.units_where = length.node->where;
    context.scene.length_unit = *k == 0 ? units::kMillimetre : units::kMetre;
    context.length_name = lengths[static_cast<std::size_t>(*k)];
  }
  if (const auto k = read_choice(context, units.require("angle"), angles)) {
    context.scene.angle_unit = *k == 0 ? units::kDegree : units::kRadian;
    context.angle_name = angles[static_cast<std::size_t>(*k)];
  }
  units.finish();
}

}  // namespace

void read_header(ReadContext& context, Section& root) {
  const Item format = root.require("format");
  if (format && !(format.node->kind == TomlNode::Kind::integer && format.node->integer == 1)) {
    refuse(context, format, Code::out_of_range, "must be 1, the format this version reads");
  }
  context.scene.title = read_string(context, root.find("title")).value_or("");
  read_units(context, root);
}

namespace {

std::optional<TomlNode> parse_document(const std::string& text, const std::string& path, Diagnostics& out) {
  if (const auto bad = first_invalid_utf8(text)) {
    out.add(error_at({path, *bad}, Code::not_utf8, {}, {}, "is not UTF-8 text from here on"));
    return std::nullopt;
  }
  return parse_toml(text, path, out);
}

/// Bodies for the names that surfaces give.
void name_bodies(const TomlNode& document, Scene& scene) {
  const TomlNode* surfaces = document.member("surface");
  if (!surfaces) return;
  for (const TomlNode& surface : surfaces->children) {
    const TomlNode* body = surface.member("body");
    if (!body || body->kind != TomlNode::Kind::string) continue;
    const bool known =
        std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const BodyDef& b) { return b.name == body->text; });
    if (known) continue;
    BodyDef def;
    def.name = body->text;
    def.where = body->where;
    scene.bodies.push_back(def);
  }
}

/// Bodies with `enabled = false` are read and checked with the rest, which may name them, and then left out with it.
void leave_out_disabled_bodies(ReadContext& context) {
  Scene& scene = context.scene;
  std::vector<int> bodies;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (is_disabled(scene, "body", scene.bodies[b].name)) bodies.push_back(static_cast<int>(b));
  if (const auto stays = cannot_leave_out(scene, bodies))
    return context.error(scene.bodies[at(stays->body)].where, Code::conflict,
                         "body." + scene.bodies[at(stays->body)].name + ".enabled", "false", stays->why);
  leave_out_bodies(scene, bodies);
}

std::optional<Scene> finished(Scene scene, Diagnostics& found, Diagnostics& out) {
  found.sort();
  const bool refused = found.has_errors();  // then warnings wait: they may follow from an error
  for (const Diagnostic& d : found.items())
    if (!refused || d.severity == Diagnostic::Severity::error) out.add(d);
  if (refused) return std::nullopt;
  return scene;
}

}  // namespace

std::optional<Scene> parse_scene(const std::string& text, const std::string& path, Diagnostics& out,
                                 const MeshesAtHand& at_hand) {
  const std::optional<TomlNode> document = parse_document(text, path, out);
  return document ? scene_of(*document, path, out, at_hand) : std::nullopt;
}

std::optional<Scene> scene_of(const TomlNode& document, const std::string& path, Diagnostics& out,
                              const MeshesAtHand& at_hand) {
  Diagnostics found;
  Scene scene;
  scene.file = path;
  ReadContext context(path, found, scene);
  for (const std::string& name : at_hand)
    context.at_hand.insert(context.at_hand.end(), {name, context.file_called(name)});
  Section root(context, {&document, ""}, "a scene");
  context.in_motion = root.has("dynamics");
  read_header(context, root);
  read_bodies(context, root);
  read_joints(context, root);
  read_combinations(context, root);
  read_moment_arms(context, root);
  read_surfaces(context, root);
  read_contacts(context, root);
  read_compartments(context, root);
  read_ligaments(context, root);
  read_bundles(context, root);
  read_bushings(context, root);
  read_loads(context, root);
  read_steps(context, root);
  read_solver(context, root);
  read_plausible(context, root);
  read_dynamics(context, root);
  root.finish();
  check_scene(context);
  if (!found.has_errors()) leave_out_disabled_bodies(context);
  return finished(std::move(scene), found, out);
}

std::optional<Scene> read_scene(const std::string& path, Diagnostics& out) {
  InputFiles files;
  return read_scene(path, files, out);
}

std::optional<Scene> read_scene(const std::string& path, InputFiles& files, Diagnostics& out,
                                const MeshesAtHand& at_hand) {
  const auto text = read_text(path, files, out);
  if (!text) return std::nullopt;
  return parse_scene(*text, path, out, at_hand);
}

std::optional<TomlNode> read_document(const std::string& path, InputFiles& files, Diagnostics& out) {
  const auto text = read_text(path, files, out);
  return text ? parse_document(*text, path, out) : std::nullopt;
}

std::optional<Scene> read_surface_file(const std::string& path, Diagnostics& out) {
  InputFiles files;
  const auto text = read_text(path, files, out);
  if (!text) return std::nullopt;
  const std::optional<TomlNode> document = parse_document(*text, path, out);
  if (!document) return std::nullopt;
  if (document->member("body") || document->member("joint") || document->member("step"))
    return parse_scene(*text, path, out);

  Diagnostics found;
  Scene scene;
  scene.file = path;
  ReadContext context(path, found, scene);
  Section root(context, {&*document, ""}, "a file of surfaces");
  read_header(context, root);
  name_bodies(*document, scene);
  read_surfaces(context, root);
  read_solid_shapes(context, root);
  root.finish();
  return finished(std::move(scene), found, out);
}

}  // namespace genu
