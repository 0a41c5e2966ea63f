#include "genu/study/new_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "genu/core/atomic_output.h"
#include "genu/core/length_units.h"
#include "genu/landmarks/landmark_file.h"
#include "genu/scene/reader.h"
#include "genu/scene/utf8.h"
#include "genu/scene/words.h"
#include "genu/study/fit_doubts.h"
#include "genu/study/knee_layout.h"
#include "genu/study/knee_picture.h"
#include "genu/study/layout_doubts.h"
#include "genu/study/new_bones.h"
#include "genu/study/new_edit.h"
#include "genu/study/new_landmarks.h"
#include "genu/study/new_ligaments.h"
#include "genu/study/new_numbers.h"
#include "genu/study/new_picture.h"
#include "genu/study/new_scene_text.h"
#include "genu/study/new_words.h"
#include "genu/study/run_scene.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

/// Which side, and why.
struct Side {
  bool left = false;
  std::string why;
};
Side side_of(const NewScene& asked, const KneeLayout& knee, const NewBones& bones, const KneeLandmarks& landmarks) {
  if (asked.left) return {*asked.left, "as you said"};
  if (landmarks.left) return {*landmarks.left, "by the names of the landmarks"};
  if (const auto left = landmarks.left_by_epicondyles(knee)) return {*left, "by the epicondyles"};
  if (const auto left = seems_left(knee)) return {*left, why_this_side(knee) + "; --side says otherwise"};
  if (const auto left = fits_left(bones.femur_shape(), bones.tibia_shape(), knee))
    return {*left, "the reference knee fits better so; --side says otherwise"};
  return {false, "not told by the meshes; --side left or right decides"};
}

std::vector<std::string> choices_of(const NewScene& asked, const KneeLayout& knee, const Side& side,
                                    const KneeLandmarks& landmarks, const NewLigaments& ligaments, const Words& w) {
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
  if (!asked.landmarks.empty()) out.push_back(landmarks_choice(landmarks, asked.landmarks));
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

/// The reference pose becomes the first one that the trial found.
void refer_to_balance(Words& words, const Solution& found) {
  const std::string pose = found.summary.poses_solved > 0 ? balanced_reference(found.poses) : "";
  if (pose.empty()) return;
  words["reference"] = pose;
  words["reference_note"] = "In balance under a twentieth of the load, as the trial found it";
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

/// A picture is never put in the place of what is none.
void refuse_picture(const NewScene& asked, Diagnostics& out) {
  const fs::path file = asked.picture;
  if (file.extension() != ".svg")
    out.add(error_at({}, Code::wrong_form, "--picture", with_quotes(printable(asked.picture)), "must end with .svg"));
  else if (asked.kind != NewScene::Kind::stl)
    out.add(error_at({}, Code::meshes_needed, "--picture", {}, "belongs to a scene of meshes: --femur F --tibia T"));
  else if (const auto kept = why_not_replaced(asked.picture, kKneePictureMark);
           kept && (asked.edit || file.parent_path().lexically_normal() != fs::path(asked.folder).lexically_normal()))
    out.error(kept->code, {}, kept->text);
}

bool refuse_words(const NewScene& asked, Diagnostics& out) {
  const auto refuse_it = [&](Code code, const char* option, const std::string& found, const std::string& rule) {
    out.add(error_at({}, code, option, with_quotes(found), rule));
  };
  std::error_code ignored;
  const bool meshes = !asked.femur.empty() || !asked.tibia.empty();
  if (asked.folder.empty()) out.error(Code::no_scene_name, {}, "the scene has no name: genu new NAME");
  // A scene is a text, and names these.
  for (const auto& [what, name] : {std::pair("NAME", asked.folder), std::pair("--femur", asked.femur),
                                   std::pair("--tibia", asked.tibia), std::pair("--femur", asked.femur_bone),
                                   std::pair("--tibia", asked.tibia_bone), std::pair("--landmarks", asked.landmarks)})
    if (first_invalid_utf8(name) || std::any_of(name.begin(), name.end(), is_control))
      refuse_it(Code::not_utf8, what, printable(valid_utf8(name)),
                "must be a name of UTF-8 text without control characters: rename it");
  if (asked.edit && !fs::is_directory(asked.folder, ignored))
    out.error(Code::no_such_file, asked.folder,
              "is no folder of a scene: --edit writes one again that genu new has written");
  if (asked.edit && asked.kind != NewScene::Kind::stl)
    out.add(error_at({}, Code::meshes_needed, "--edit", {}, "belongs to a scene of meshes: --femur F --tibia T"));
  if (!asked.edit && fs::exists(fs::symlink_status(asked.folder, ignored)))
    out.error(Code::name_taken, asked.folder,
              "exists already, and genu new replaces nothing: choose another name, or --edit to write it again");
  if (asked.kind != NewScene::Kind::stl && meshes)
    refuse_it(Code::meshes_needed, "--kind", asked.kind == NewScene::Kind::motion ? "motion" : "analytic",
              "has no meshes: --femur and --tibia belong to --kind stl");
  if (asked.landmarks.empty() && (!asked.landmark_unit.empty() || asked.landmark_error > 0))
    out.add(error_at({}, Code::usage, asked.landmark_unit.empty() ? "--landmark-error" : "--landmark-units", {},
                     "belongs to --landmarks FILE"));
  if (asked.femur_bone.empty() != asked.tibia_bone.empty())
    out.error(Code::meshes_needed, {},
              "cartilage over bone is given for one of femur and tibia: --femur BONE CARTILAGE --tibia BONE CARTILAGE");
  if (asked.kind == NewScene::Kind::stl && (asked.femur.empty() || asked.tibia.empty()))
    out.error(Code::meshes_needed, {},
              "a scene of kind stl needs two meshes in one frame: --femur femur.stl --tibia tibia.stl");
  for (const auto& [option, word] : {std::pair("--proximal", asked.proximal), std::pair("--anterior", asked.anterior)})
    if (!word.empty() && !axis_named(word))
      refuse_it(Code::unknown_name, option, word, "must be one of x, y, z, -x, -y, -z");
  if (!asked.picture.empty()) refuse_picture(asked, out);
  return out.has_errors();
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
bool check_layout(const NewBone& femur, const NewBone& tibia, const KneeLayout& knee, const NewScene& asked,
                  Diagnostics& out) {
  say_all(doubts_about(femur.mesh, tibia.mesh, knee, tibia.unit), asked, out);
  if (const auto left = seems_left(knee); left && asked.left && *asked.left != *left)
    out.warning(Code::layout, asked.femur + ", " + asked.tibia,
                fmt::format("look like a {} knee, and --side says {}: {}", *left ? "left" : "right",
                            *asked.left ? "left" : "right", why_this_side(knee)));
  return !out.has_errors();
}

/// None where none are asked for; empty where their file is refused.
std::optional<KneeLandmarks> landmarks_of(const NewScene& asked, const NewBones& bones, Diagnostics& out) {
  if (asked.landmarks.empty()) return KneeLandmarks{};
  const std::string unit = asked.landmark_unit.empty() ? asked.unit : asked.landmark_unit;
  const double metres = metres_in(unit).value_or(bones.femur.unit);
  auto landmarks = read_knee_landmarks({asked.landmarks, metres, asked.landmark_error, bones.space()},
                                       bones.femur_shape(), bones.tibia_shape(), out);
  if (landmarks && asked.left && landmarks->left && *asked.left != *landmarks->left) {
    out.add(error_at({asked.landmarks}, Code::conflict, "--side", *asked.left ? "left" : "right",
                     fmt::format("contradicts the names of the landmarks, which are of a {} knee",
                                 *landmarks->left ? "left" : "right")));
    return std::nullopt;
  }
  return landmarks;
}

/// By what was asked for, then by landmarks, then by the meshes.
std::optional<KneeLayout> lay_out(const NewScene& asked, const Mesh& femur, const Mesh& tibia,
                                  const KneeLandmarks& landmarks) {
  const auto proximal = asked.proximal.empty() ? landmarks.proximal() : axis_named(asked.proximal);
  auto knee = lay_out_knee(femur, tibia, proximal, axis_named(asked.anterior));
  if (!knee) return knee;
  const auto side = asked.left ? asked.left : landmarks.left;
  const auto seen = landmarks.left_by_epicondyles(*knee);
  if (asked.anterior.empty() && side && seen && *side != *seen)  // the epicondyles stand the other way round
    knee = lay_out_knee(femur, tibia, proximal, Vec3(-knee->anterior));
  if (knee) knee->given = landmarks.ends;
  return knee;
}

struct Composed {
  std::string text;
  Words words;
  std::vector<std::string> choices;
  std::string ligaments{};  ///< of kind stl: their text, and what stands for its words
  Words lengths{};
  std::optional<NewKnee> knee{};  ///< for its picture

  std::string whole() {
    words["ligaments"] = filled_in(ligaments, lengths);
    return filled_in(text, words);
  }
};

/// All that is wrong with the file of landmarks, where other errors end the work before it is used.
void refuse_landmarks(const NewScene& asked, Diagnostics& out) {
  if (!asked.landmarks.empty()) static_cast<void>(read_landmarks(asked.landmarks, 1, out));
}

std::optional<Composed> compose(const NewScene& asked, const std::string& name, Diagnostics& out) {
  Words words{{"title", toml_string_of(name)},
              {"name", toml_string_of(name)},
              {"file", toml_string_of((fs::path(asked.folder) / (name + ".toml")).string())}};
  if (asked.kind == NewScene::Kind::analytic) return Composed{analytic_scene_text(), words, {}};
  if (asked.kind == NewScene::Kind::given) return Composed{asked.text, {}, {}};
  if (asked.kind == NewScene::Kind::motion) return Composed{motion_scene_text(), words, {}};
  const auto bones = read_new_bones(asked, out);
  if (!bones) {
    refuse_landmarks(asked, out);
    return std::nullopt;
  }
  const auto landmarks = landmarks_of(asked, *bones, out);
  if (!landmarks) return std::nullopt;
  const Mesh &femur = bones->femur.mesh, &tibia = bones->tibia.mesh;
  auto knee = lay_out(asked, femur, tibia, *landmarks);
  if (!knee) {
    out.error(Code::layout, {},
              "--proximal and --anterior must be along different axes, and the meshes must not be flat");
    return std::nullopt;
  }
  if (!check_layout(bones->femur, bones->tibia, *knee, asked, out)) return std::nullopt;
  const Side side = side_of(asked, *knee, *bones, *landmarks);
  words.merge(words_of_knee(asked, *knee, side.left, *bones, *landmarks));
  doubt_landmarks(*landmarks, bones->femur_shape(), bones->tibia_shape(), *knee, side.left, out);
  const NewLigaments ligaments =
      ligaments_of(bones->femur_shape(), bones->tibia_shape(), *knee, side.left, !bones->femur_bone);
  if (!say_all(fit_doubts(bones->femur_shape(), bones->tibia_shape(), *knee, ligaments.misfit), asked, out))
    return std::nullopt;
  for (const auto& doubt : {ligaments.turned, ligaments.doubt})
    if (doubt) out.warning(Code::layout, asked.femur + ", " + asked.tibia, *doubt);
  words["ligaments_note"] = ligaments.note;
  ask_for_flexion(words, ligaments.doubt ? kStartFlexion : kWholeFlexion, false);
  return Composed{stl_scene_text(),
                  words,
                  choices_of(asked, *knee, side, *landmarks, ligaments, words),
                  ligaments.text,
                  ligaments.lengths,
                  NewKnee{*bones, *knee, side.left, *landmarks, ligaments.choice, ligaments.doubt.value_or("")}};
}

/// The text of a scene that is finished, and what its trial gave.
struct Tried {
  std::string text;
  std::optional<Solution> found;
};

/// Puts the user's changes into a scene that is written again, and tries it out where it stands.
bool keep_changes(const NewScene& asked, const NewSceneFiles& files, const EarlierScene& earlier, Tried& tried,
                  NewSceneReport& report, Diagnostics& out) {
  const MergedScene merged = with_changes(earlier, tried.text, files.scene(), out);
  report.choices.push_back(
      fmt::format("kept        {} change{} of yours, {} of them against what genu writes now; the scene before is {}",
                  merged.kept, merged.kept == 1 ? "" : "s", merged.conflicts.size(), printable(files.before())));
  if (merged.text == tried.text) return true;
  tried.text = merged.text;
  const std::string error = write_file_atomically(files.trial(), merged.text);
  if (!error.empty()) out.error(Code::cannot_write, {}, error);
  if (error.empty()) tried.found = try_out(files.trial(), files.scene(), asked, false, out);
  std::error_code ignored;
  fs::remove(files.trial(), ignored);
  return error.empty() && tried.found;
}

/// Writes the staged scene, until its trial is as good as it gets. An error in words; empty: none.
std::string settle(const NewScene& asked, const std::string& staged_file, const std::string& file, Composed& composed,
                   Tried& tried, Diagnostics& out) {
  std::string error;
  const auto write = [&] {
    tried.text = composed.whole();
    error = write_file_atomically(staged_file, tried.text);
  };
  write();
  if (!error.empty()) return error;
  auto& found = tried.found;
  found = try_out(staged_file, file, asked, true, out);
  const bool stl = asked.kind == NewScene::Kind::stl;
  for (int round = 0; round < kSettleRounds && found && settle_ligaments(found->poses, round, composed.lengths);
       ++round) {
    refer_to_balance(composed.words, *found);
    write();
    if (error.empty()) found = try_out(staged_file, file, asked, false, out);
  }
  if (found && stl && !all_solved(found->summary.exit_code) && found->summary.poses_solved > kSettlingRows) {
    ask_for_flexion(composed.words, found->summary.poses_solved - kSettlingRows, true);
    write();
    if (error.empty()) found = try_out(staged_file, file, asked, false, out);
  }
  return error;
}

std::string write_picture(const NewScene& asked, const Composed& composed, const Tried& tried,
                          const std::string& file) {
  Diagnostics ignored;
  const auto scene = parse_scene(tried.text, file, ignored);
  if (asked.picture.empty() || !scene || !composed.knee) return {};
  return write_file_atomically(asked.picture, picture_of(*composed.knee, *scene));
}

}  // namespace

std::optional<NewSceneReport> write_new_scene(const NewScene& asked, Diagnostics& out) {
  fs::path folder = fs::path(asked.folder).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  const NewSceneFiles files{folder, folder.filename().string()};
  if (refuse_words(asked, out)) {
    refuse_landmarks(asked, out);
    return std::nullopt;
  }
  std::optional<EarlierScene> earlier;
  if (asked.edit) earlier = read_earlier(files, out);
  auto composed = compose(asked, files.name, out);
  if (!composed || (asked.edit && !earlier)) return std::nullopt;
  StagedFolder staged("");  // it will be edited: never to be replaced
  if (const auto refused = staged.open(asked.edit ? fs::path(folder.string() + ".edit") : folder)) {
    out.error(refused->code, {}, refused->text);
    return std::nullopt;
  }
  const NewSceneFiles staged_files{staged.path(), files.name};
  NewSceneReport report;
  report.file = files.scene();
  report.choices = composed->choices;
  Tried tried;
  std::string error = settle(asked, staged_files.scene(), report.file, *composed, tried, out);
  if (error.empty()) {
    if (!tried.found) return std::nullopt;
    const std::string fresh = tried.text;
    if (earlier && !keep_changes(asked, files, *earlier, tried, report, out)) return std::nullopt;
    const RunSummary& summary = tried.found->summary;
    report.poses_solved = summary.poses_solved;
    report.poses_asked = summary.poses_asked;
    if (!all_solved(summary.exit_code)) report.verdict = summary.verdict;
    if (earlier) {
      error = write_edited(files, *earlier, tried.text, fresh);
    } else {
      if (composed->knee) error = write_file_atomically(staged_files.written(), written_copy(fresh));
      if (error.empty()) error = staged.commit();
    }
  }
  if (error.empty()) error = write_picture(asked, *composed, tried, report.file);
  if (error.empty()) return report;
  out.error(Code::cannot_write, {}, error);
  report.written = false;
  return report;
}

}  // namespace genu
