#include "genu/study/new_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "genu/core/atomic_output.h"
#include "genu/mesh/mesh_check.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/scene/utf8.h"
#include "genu/scene/words.h"
#include "genu/study/fit_doubts.h"
#include "genu/study/knee_layout.h"
#include "genu/study/layout_doubts.h"
#include "genu/study/new_ligaments.h"
#include "genu/study/new_scene_text.h"
#include "genu/study/run_scene.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

using Words = std::map<std::string, std::string>;

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

/// A string of TOML.
std::string toml_string_of(const std::string& text) {
  std::string out;
  for (const char c : text)
    if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if (is_control(c))
      out += fmt::format("\\u{:04x}", c);
    else
      out += c;
  return out;
}

struct Bone {
  Mesh mesh;
  double unit = 1e-3;
  std::string space;  ///< the frame that its file names
};

std::optional<Bone> read_bone(const std::string& file, const std::string& unit, Diagnostics& out) {
  Bone bone;
  if (unit == "m") bone.unit = 1;
  MeshFileFacts facts;
  auto mesh =
      unit.empty() ? read_mesh_of_some_unit(file, bone.unit, out, &facts) : read_mesh(file, bone.unit, out, &facts);
  bone.space = facts.space;
  if (!mesh) return std::nullopt;
  check_scale(check_mesh(*mesh), file, bone.unit == 1 ? "m" : "mm", out);
  if (out.has_errors()) return std::nullopt;
  bone.mesh = std::move(*mesh);
  return bone;
}

/// The file as a scene in `folder` names it.
std::string seen_from(const std::string& file, const std::string& folder) {
  std::error_code failed;
  const fs::path from = fs::weakly_canonical(fs::absolute(folder, failed), failed),
                 to = fs::weakly_canonical(fs::absolute(file, failed), failed);
  const fs::path relative = to.lexically_relative(from);
  return toml_string_of((relative.empty() ? to : relative).string());
}

/// The meshes of a knee, and those that the reference knee is laid on: bones where there are some.
struct Bones {
  Bone femur, tibia;
  std::optional<Bone> femur_bone, tibia_bone;

  const Mesh& femur_shape() const { return femur_bone ? femur_bone->mesh : femur.mesh; }
  const Mesh& tibia_shape() const { return tibia_bone ? tibia_bone->mesh : tibia.mesh; }
};

std::optional<Bones> read_bones(const NewScene& asked, Diagnostics& out) {
  auto femur = read_bone(asked.femur, asked.unit, out), tibia = read_bone(asked.tibia, asked.unit, out);
  std::optional<Bone> femur_bone, tibia_bone;
  if (!asked.femur_bone.empty()) femur_bone = read_bone(asked.femur_bone, asked.unit, out);
  if (!asked.tibia_bone.empty()) tibia_bone = read_bone(asked.tibia_bone, asked.unit, out);
  if (out.has_errors() || !femur || !tibia) return std::nullopt;
  return Bones{std::move(*femur), std::move(*tibia), std::move(femur_bone), std::move(tibia_bone)};
}

/// The thickness of cartilage over a bone.
std::string thickness_text(const std::string& file, const std::string& folder, const std::optional<Bone>& bone) {
  if (!bone) return "";
  return fmt::format("\nthickness = {{ bone = \"{}\", units = \"{}\" }}", seen_from(file, folder),
                     bone->unit == 1 ? "m" : "mm");
}

Words words_of_knee(const NewScene& asked, const KneeLayout& knee, bool left, const Bones& bones) {
  Words w;
  const bool guessed = asked.unit.empty();
  const std::string right = axis_word(knee.right), side = left ? "left" : "right";
  const Vec3 lateral = left ? Vec3(-knee.right) : knee.right;
  w["side"] = side;
  w["proximal"] = axis_word(knee.proximal);
  w["anterior"] = axis_word(knee.anterior);
  w["proximal_how"] = asked.proximal.empty() ? " (from the tibia to the femur)" : " (as you said)";
  w["anterior_how"] = asked.anterior.empty()
                          ? " (GUESSED: away from the notch between the condyles; `genu new --anterior` decides)"
                          : " (as you said)";
  w["width"] = tenths(knee.width);
  w["depth"] = tenths(knee.depth);
  w["cartilage_note"] =
      asked.femur_bone.empty() ? "Of bones without cartilage the layer stands for it, but begins at the bone." : "";
  w["flexion_axis"] = axis_word(-knee.right);
  w["adduction_axis"] = axis_word(left ? Vec3(-knee.anterior) : knee.anterior);
  w["rotation_axis"] = axis_word(left ? Vec3(-knee.proximal) : knee.proximal);
  Eigen::Index up = 0;
  knee.proximal.cwiseAbs().maxCoeff(&up);
  w["reference"] = fmt::format("{} = {}", "xyz"[up], tenths(knee.gap * knee.proximal[up]));
  w["centre"] = point_text(knee.centre);
  w["femur_origin"] = point_text(knee.centre + knee.gap * knee.proximal);
  w["femur_file"] = seen_from(asked.femur, asked.folder);
  w["tibia_file"] = seen_from(asked.tibia, asked.folder);
  w["femur_unit"] = bones.femur.unit == 1 ? "m" : "mm";
  w["tibia_unit"] = bones.tibia.unit == 1 ? "m" : "mm";
  w["femur_thickness"] = thickness_text(asked.femur_bone, asked.folder, bones.femur_bone);
  w["tibia_thickness"] = thickness_text(asked.tibia_bone, asked.folder, bones.tibia_bone);
  const bool measured = !asked.femur_bone.empty();
  w["thickness"] = measured ? "" : "thickness = 6                  # CHOSEN: mm, of both layers together\n";
  w["layer"] = measured ? "10 MPa, as thick as it lies on the bones" : "6 mm and 10 MPa in all";
  w["femur_unit_how"] = w["tibia_unit_how"] = guessed ? "                   # GUESSED from its size" : "";
  Eigen::Index sideways = 0;
  lateral.cwiseAbs().maxCoeff(&sideways);
  const char axis = "xyz"[sideways];
  const std::string middle = tenths(knee.centre[sideways]);
  const std::string below = fmt::format("{} < {}", axis, middle), above = fmt::format("{} >= {}", axis, middle);
  w["medial"] = lateral[sideways] > 0 ? below : above;
  w["lateral"] = lateral[sideways] > 0 ? above : below;
  w["compression"] = fmt::format("[{:g}, {:g}, {:g}]", 100 * knee.proximal.x() + 0.0, 100 * knee.proximal.y() + 0.0,
                                 100 * knee.proximal.z() + 0.0);
  return w;
}

/// Which side, and why.
struct Side {
  bool left = false;
  std::string why;
};
Side side_of(const NewScene& asked, const KneeLayout& knee, const Bones& bones) {
  if (asked.left) return {*asked.left, "as you said"};
  if (const auto left = seems_left(knee)) return {*left, why_this_side(knee) + "; --side says otherwise"};
  if (const auto left = fits_left(bones.femur_shape(), bones.tibia_shape(), knee))
    return {*left, "the reference knee fits better so; --side says otherwise"};
  return {false, "not told by the meshes; --side left or right decides"};
}

std::vector<std::string> choices_of(const NewScene& asked, const KneeLayout& knee, const Side& side,
                                    const NewLigaments& ligaments, const Words& w) {
  std::vector<std::string> out;
  out.push_back(fmt::format("axes        proximal {}{}, anterior {}{}", w.at("proximal"),
                            asked.proximal.empty() ? " (found)" : "", w.at("anterior"),
                            asked.anterior.empty() ? " (guessed; --anterior says otherwise)" : ""));
  out.push_back(fmt::format("side        {} ({})", w.at("side"), side.why));
  out.push_back(fmt::format("units       femur {}, tibia {}{}", w.at("femur_unit"), w.at("tibia_unit"),
                            asked.unit.empty() ? " (guessed from their size; --units decides)" : ""));
  out.push_back(fmt::format("start       the tibia moved {} mm {} the femur, where the meshes touch",
                            tenths(std::abs(knee.gap)), knee.gap < 0 ? "away from" : "toward"));
  out.push_back("ligaments   " + ligaments.choice);
  out.push_back("chosen      ligaments, cartilage, load: nothing in a mesh says them. Put your own there");
  return out;
}

constexpr int kStartFlexion = 30;   // deg: what a start without anatomy can be asked
constexpr int kWholeFlexion = 120;  // deg: with it
constexpr int kSettleRounds = 8;    // trials after which ligaments stay as they are
constexpr int kSettlingRows = 10;   // rows of the step before it

void ask_for_flexion(Words& words, int degrees, bool tried_further) {
  words["flexion"] = fmt::format("{}", degrees);
  words["increments"] = fmt::format("{}", std::max(degrees, 1));
  words["flexion_note"] =
      tried_further ? fmt::format(": beyond {} deg the trial found no pose; better ligaments lead further", degrees)
                    : "";
}

/// Errors name the scene as it will stand in its folder, `name`. The `first` time what is done to the meshes is told.
std::optional<Solution> try_out(const std::string& file, const std::string& name, const NewScene& asked, bool first,
                                Diagnostics& out) {
  RunOptions options;
  options.cancelled = asked.cancelled;
  options.keep_partial = true;
  Diagnostics warnings;
  const auto prepared = prepare(file, warnings);
  std::optional<Solution> found;
  if (prepared)
    found = prepared->scene.dynamics ? move_all(*prepared, options, warnings) : solve_all(*prepared, options, warnings);
  if (found && found->stopped == "interrupted") {
    out.error(Code::interrupted, {}, "stopped while the scene was tried out: nothing is written");
    return std::nullopt;
  }
  const auto of_meshes = [](const Diagnostic& d) {
    return d.code == Code::mesh_repaired || d.code == Code::layout || d.code == Code::no_thickness;
  };
  for (Diagnostic d : warnings.items())
    if (d.severity == Diagnostic::Severity::error ? !found : first && of_meshes(d)) {
      if (d.file == file) d.file = name;
      out.add(d);
    }
  return found;
}

bool refuse_words(const NewScene& asked, Diagnostics& out) {
  const auto refuse_it = [&](Code code, const char* option, const std::string& found, const std::string& rule) {
    out.add(error_at({}, code, option, with_quotes(found), rule));
  };
  std::error_code ignored;
  const bool meshes = !asked.femur.empty() || !asked.tibia.empty();
  if (asked.folder.empty()) out.error(Code::no_scene_name, {}, "the scene has no name: genu new NAME");
  // A scene is a text, and names these.
  for (const auto& [what, name] :
       {std::pair("NAME", asked.folder), std::pair("--femur", asked.femur), std::pair("--tibia", asked.tibia),
        std::pair("--femur", asked.femur_bone), std::pair("--tibia", asked.tibia_bone)})
    if (first_invalid_utf8(name) || std::any_of(name.begin(), name.end(), is_control))
      refuse_it(Code::not_utf8, what, printable(valid_utf8(name)),
                "must be a name of UTF-8 text without control characters: rename it");
  if (fs::exists(fs::symlink_status(asked.folder, ignored)))
    out.error(Code::name_taken, asked.folder, "exists already, and genu new replaces nothing: choose another name");
  if (asked.kind != NewScene::Kind::stl && meshes)
    refuse_it(Code::meshes_needed, "--kind", asked.kind == NewScene::Kind::motion ? "motion" : "analytic",
              "has no meshes: --femur and --tibia belong to --kind stl");
  if (asked.femur_bone.empty() != asked.tibia_bone.empty())
    out.error(Code::meshes_needed, {},
              "cartilage over bone is given for one of femur and tibia: --femur BONE CARTILAGE --tibia BONE CARTILAGE");
  if (asked.kind == NewScene::Kind::stl && (asked.femur.empty() || asked.tibia.empty()))
    out.error(Code::meshes_needed, {},
              "a scene of kind stl needs two meshes in one frame: --femur femur.stl --tibia tibia.stl");
  for (const auto& [option, word] : {std::pair("--proximal", asked.proximal), std::pair("--anterior", asked.anterior)})
    if (!word.empty() && !axis_named(word))
      refuse_it(Code::unknown_name, option, word, "must be one of x, y, z, -x, -y, -z");
  return out.has_errors();
}

/// Two frames in two files are seldom meant: between RAS and LPS one of the bones stands back to front.
bool check_spaces(const Bone& femur, const Bone& tibia, const NewScene& asked, Diagnostics& out) {
  if (femur.space.empty() || tibia.space.empty() || femur.space == tibia.space) return true;
  out.error(Code::layout, asked.femur + ", " + asked.tibia,
            fmt::format("are in two frames by their own headers, SPACE={} and SPACE={}: export both in one frame",
                        femur.space, tibia.space));
  return false;
}

/// False where one of them is impossible.
bool say_all(const std::vector<LayoutDoubt>& doubts, const NewScene& asked, Diagnostics& out) {
  for (const LayoutDoubt& doubt : doubts)
    out.add({doubt.impossible ? Diagnostic::Severity::error : Diagnostic::Severity::warning,
             Code::layout,
             {asked.femur + ", " + asked.tibia},
             {},
             {},
             doubt.what});
  return !out.has_errors();
}

/// False, with the reasons in `out`, where the meshes cannot be a femur and its tibia in one frame.
bool check_layout(const Mesh& femur, const Mesh& tibia, const KneeLayout& knee, const NewScene& asked,
                  Diagnostics& out) {
  say_all(doubts_about(femur, tibia, knee), asked, out);
  if (const auto left = seems_left(knee); left && asked.left && *asked.left != *left)
    out.warning(Code::layout, asked.femur + ", " + asked.tibia,
                fmt::format("look like a {} knee, and --side says {}: {}", *left ? "left" : "right",
                            *asked.left ? "left" : "right", why_this_side(knee)));
  return !out.has_errors();
}

struct Composed {
  std::string text;
  Words words;
  std::vector<std::string> choices;
  std::string ligaments{};  ///< of kind stl: their text, and what stands for its words
  Words lengths{};

  std::string whole() {
    words["ligaments"] = filled_in(ligaments, lengths);
    return filled_in(text, words);
  }
};

std::optional<Composed> compose(const NewScene& asked, const std::string& name, Diagnostics& out) {
  Words words{{"title", toml_string_of(name)},
              {"name", toml_string_of(name)},
              {"file", toml_string_of((fs::path(asked.folder) / (name + ".toml")).string())}};
  if (asked.kind == NewScene::Kind::analytic) return Composed{analytic_scene_text(), words, {}};
  if (asked.kind == NewScene::Kind::given) return Composed{asked.text, {}, {}};
  if (asked.kind == NewScene::Kind::motion) return Composed{motion_scene_text(), words, {}};
  const auto bones = read_bones(asked, out);
  if (!bones || !check_spaces(bones->femur, bones->tibia, asked, out)) return std::nullopt;
  const Mesh &femur = bones->femur.mesh, &tibia = bones->tibia.mesh;
  const auto knee = lay_out_knee(femur, tibia, axis_named(asked.proximal), axis_named(asked.anterior));
  if (!knee) {
    out.error(Code::layout, {},
              "--proximal and --anterior must be along different axes, and the meshes must not be flat");
    return std::nullopt;
  }
  if (!check_layout(femur, tibia, *knee, asked, out)) return std::nullopt;
  const Side side = side_of(asked, *knee, *bones);
  words.merge(words_of_knee(asked, *knee, side.left, *bones));
  const NewLigaments ligaments =
      ligaments_of(bones->femur_shape(), bones->tibia_shape(), *knee, side.left, !bones->femur_bone);
  if (!say_all(fit_doubts(bones->femur_shape(), bones->tibia_shape(), *knee, ligaments.misfit), asked, out))
    return std::nullopt;
  for (const auto& doubt : {ligaments.turned, ligaments.doubt})
    if (doubt) out.warning(Code::layout, asked.femur + ", " + asked.tibia, *doubt);
  words["ligaments_note"] = ligaments.note;
  ask_for_flexion(words, ligaments.doubt ? kStartFlexion : kWholeFlexion, false);
  return Composed{stl_scene_text(), words, choices_of(asked, *knee, side, ligaments, words), ligaments.text,
                  ligaments.lengths};
}

}  // namespace

std::optional<NewSceneReport> write_new_scene(const NewScene& asked, Diagnostics& out) {
  fs::path folder = fs::path(asked.folder).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  const std::string name = folder.filename().string();
  if (refuse_words(asked, out)) return std::nullopt;
  auto composed = compose(asked, name, out);
  if (!composed) return std::nullopt;
  StagedFolder staged("");  // it will be edited: never to be replaced
  if (const auto refused = staged.open(folder)) {
    out.error(refused->code, {}, refused->text);
    return std::nullopt;
  }
  std::string error;
  NewSceneReport report;
  report.file = (folder / (name + ".toml")).string();
  report.choices = composed->choices;
  const std::string staged_file = (staged.path() / (name + ".toml")).string();
  const auto write = [&] { error = write_file_atomically(staged_file, composed->whole()); };
  write();
  if (error.empty()) {
    auto found = try_out(staged_file, report.file, asked, true, out);
    const bool stl = asked.kind == NewScene::Kind::stl;
    for (int round = 0; round < kSettleRounds && found && settle_ligaments(found->poses, round, composed->lengths);
         ++round) {
      write();
      if (error.empty()) found = try_out(staged_file, report.file, asked, false, out);
    }
    if (found && stl && !all_solved(found->summary.exit_code) && found->summary.poses_solved > kSettlingRows) {
      ask_for_flexion(composed->words, found->summary.poses_solved - kSettlingRows, true);
      write();
      if (error.empty()) found = try_out(staged_file, report.file, asked, false, out);
    }
    if (!found) return std::nullopt;
    report.poses_solved = found->summary.poses_solved;
    report.poses_asked = found->summary.poses_asked;
    if (!all_solved(found->summary.exit_code)) report.verdict = found->summary.verdict;
  }
  if (error.empty()) error = staged.commit();
  if (error.empty()) return report;
  out.error(Code::cannot_write, {}, error);
  report.written = false;
  return report;
}

}  // namespace genu
