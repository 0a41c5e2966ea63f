#include "genu/new_scene/new_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "genu/core/atomic_output.h"
#include "genu/core/length_units.h"
#include "genu/core/units.h"
#include "genu/landmarks/landmark_file.h"
#include "genu/new_scene/fit_doubts.h"
#include "genu/new_scene/knee_picture.h"
#include "genu/new_scene/new_bones.h"
#include "genu/new_scene/new_edit.h"
#include "genu/new_scene/new_fibula.h"
#include "genu/new_scene/new_landmarks.h"
#include "genu/new_scene/new_ligaments.h"
#include "genu/new_scene/new_numbers.h"
#include "genu/new_scene/new_patella.h"
#include "genu/new_scene/new_picture.h"
#include "genu/new_scene/new_pieces.h"
#include "genu/new_scene/new_refusals.h"
#include "genu/new_scene/new_scene_text.h"
#include "genu/new_scene/new_settling.h"
#include "genu/new_scene/new_side.h"
#include "genu/new_scene/new_trial.h"
#include "genu/new_scene/new_words.h"
#include "genu/new_scene/tolerances.h"
#include "genu/scene/reader.h"
#include "genu/scene/utf8.h"
#include "genu/scene/words.h"
#include "genu/study/knee_layout.h"
#include "genu/study/layout_doubts.h"
#include "genu/study/run_scene.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> choices_of(const NewScene& asked, const KneeLayout& knee, const Side& side,
                                    const KneeLandmarks& landmarks, const NewLigaments& ligaments,
                                    const NewPatella& patella, const std::string& fibula,
                                    const std::string& fibula_unit, const KneeFrames& frames, const Words& w) {
  std::vector<std::string> out;
  const double turned = to::kDegree * angle_between(frames_of_files(knee), frames);
  out.push_back(fmt::format("axes        proximal {}{}, anterior {}{}{}", w.at("proximal"),
                            asked.proximal.empty() ? " (found)" : "", w.at("anterior"),
                            asked.anterior.empty() ? " (guessed; --anterior says otherwise)" : "",
                            turned > 0 ? fmt::format("; the bones are turned by {:.0f} deg to them, and the knee bends "
                                                     "about its own axes",
                                                     turned)
                                       : ""));
  out.push_back(fmt::format("side        {} ({})", w.at("side"), side.why));
  out.push_back(fmt::format("units       femur {}, tibia {}{}{}", w.at("femur_unit"), w.at("tibia_unit"),
                            (patella.text.empty() ? "" : ", patella " + patella.unit) +
                                (fibula_unit.empty() ? "" : ", fibula " + fibula_unit),
                            asked.unit.empty() ? " (guessed from their size; --units decides)" : ""));
  out.push_back(fmt::format("start       the tibia moved {} mm {} the femur, where the meshes touch",
                            tenths(std::abs(knee.gap)), knee.gap < 0 ? "away from" : "toward"));
  out.push_back("ligaments   " + ligaments.choice);
  if (!fibula.empty()) out.push_back("fibula      " + fibula);
  if (!patella.choice.empty()) out.push_back("patella     " + patella.choice);
  if (!asked.landmarks.empty()) out.push_back(landmarks_choice(landmarks, asked.landmarks));
  out.push_back("chosen      ligaments, cartilage, load: nothing in a mesh says them. Put your own there");
  return out;
}

constexpr int kStartFlexion = 30;   // deg: what a start without anatomy can be asked
constexpr int kWholeFlexion = 120;  // deg: with it

/// False where one of them is impossible.
bool say_all(const std::vector<LayoutDoubt>& doubts, const NewScene& asked, Diagnostics& out) {
  for (const LayoutDoubt& doubt : doubts)
    out.add({doubt.impossible ? Diagnostic::Severity::error : Diagnostic::Severity::warning,
             Code::layout,
             {asked.femur.text() + ", " + asked.tibia.text()},
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
    out.warning(Code::layout, asked.femur.text() + ", " + asked.tibia.text(),
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

bool asks_for_axes(const NewScene& asked) { return !asked.proximal.empty() || !asked.anterior.empty(); }

/// Those of the bones, where they are known and nobody asked for others.
KneeFrames frames_of(const NewScene& asked, const KneeLayout& knee, const NewLigaments& ligaments) {
  const bool known = !asks_for_axes(asked) && ligaments.frames && believed(*ligaments.frames);
  const KneeFrames files = frames_of_files(knee);
  return known && to::kDegree * angle_between(files, *ligaments.frames) > kAxesKept ? *ligaments.frames : files;
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
  if (!check_fibula(asked, *bones, *knee, out)) return std::nullopt;
  const Side side = side_of(asked, *knee, *bones, *landmarks);
  doubt_landmarks(*landmarks, bones->femur_shape(), bones->tibia_shape(), *knee, side.left, out);
  const NewLigaments ligaments =
      ligaments_of(bones->femur_shape(), bones->tibia_shape(), bones->fibula ? &bones->fibula->mesh : nullptr, *knee,
                   side.left, !bones->femur_bone);
  if (!say_all(fit_doubts(bones->femur_shape(), bones->tibia_shape(), *knee, ligaments.misfit), asked, out))
    return std::nullopt;
  doubt_fibula(asked, *bones, *knee, side.left, out);
  const std::string fibula =
      bones->fibula && ligaments.fitted ? fibula_choice(asked, ligaments.beside_fibula, out) : "";
  const KneeFrames frames = frames_of(asked, *knee, ligaments);
  const bool along_files = angle_between(frames, frames_of_files(*knee)) == 0;
  for (const auto& doubt : {along_files ? ligaments.turned : std::nullopt, ligaments.doubt})
    if (doubt) out.warning(Code::layout, asked.femur.text() + ", " + asked.tibia.text(), *doubt);
  words.merge(words_of_knee(asked, *knee, frames, side.left, *bones, *landmarks));
  words["ligaments_note"] = ligaments.note;
  words["fibula"] = fibula_text(asked, *bones);
  const NewPatella patella = patella_of(asked, *bones, ligaments.fitted, *knee, words, out);
  if (out.has_errors()) return std::nullopt;
  ask_for_flexion(words, ligaments.doubt ? kStartFlexion : kWholeFlexion, false);
  return Composed{stl_scene_text(),
                  words,
                  choices_of(asked, *knee, side, *landmarks, ligaments, patella, fibula,
                             bones->fibula ? length_unit_name(bones->fibula->unit) : "", frames, words),
                  ligaments.text,
                  ligaments.lengths,
                  patella,
                  NewKnee{*bones, *knee, side.left, *landmarks, ligaments.choice, ligaments.doubt.value_or("")}};
}

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

std::string write_picture(const NewScene& asked, const Composed& composed, const Tried& tried,
                          const std::string& file) {
  Diagnostics ignored;
  const auto scene = parse_scene(tried.text, file, ignored);
  if (asked.picture.empty() || !scene || !composed.knee) return {};
  return write_file_atomically(asked.picture, picture_of(*composed.knee, *scene));
}

}  // namespace

std::optional<NewSceneReport> write_new_scene(const NewScene& as_given, Diagnostics& out) {
  fs::path folder = fs::path(as_given.folder).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  const NewSceneFiles files{folder, folder.filename().string()};
  if (refuse_words(as_given, out)) {
    refuse_landmarks(as_given, out);
    return std::nullopt;
  }
  std::vector<std::string> pieces;
  const auto sorted = sort_pieces(as_given, pieces, out);
  if (!sorted) {
    refuse_landmarks(as_given, out);
    return std::nullopt;
  }
  const NewScene& asked = *sorted;
  std::optional<EarlierScene> earlier;
  if (asked.edit) earlier = read_earlier(files, asked, out);
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
  report.choices = pieces;
  report.choices.insert(report.choices.end(), composed->choices.begin(), composed->choices.end());
  Tried tried;
  std::string error = settle_new_scene(asked, staged_files.scene(), report.file, *composed, tried, out);
  if (error.empty()) {
    if (!tried.found) return std::nullopt;
    if (!tried.laxity.empty())
      report.choices.push_back("laxity      " + tried.laxity + (composed->with_patella ? "; without the patella" : "") +
                               (earlier ? "; without your changes" : ""));
    if (!tried.aimed.empty()) report.choices.push_back("for it      " + tried.aimed);
    const std::string fresh = tried.text;
    if (earlier && !keep_changes(asked, files, *earlier, tried, report, out)) return std::nullopt;
    const RunSummary& summary = tried.found->summary;
    report.poses_solved = summary.poses_solved;
    report.poses_asked = summary.poses_asked;
    if (!all_solved(summary.exit_code)) {
      report.verdict = summary.verdict;
      if (!tried.without_patella.empty()) report.verdict.push_back(tried.without_patella);
    }
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
