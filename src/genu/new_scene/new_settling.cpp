#include "genu/new_scene/new_settling.h"

#include <utility>

#include <fmt/format.h>

#include "genu/core/atomic_output.h"
#include "genu/new_scene/new_aims.h"
#include "genu/new_scene/new_ligaments.h"
#include "genu/new_scene/new_numbers.h"
#include "genu/new_scene/new_scene_text.h"
#include "genu/new_scene/new_trial.h"
#include "genu/new_scene/tolerances.h"

namespace genu {
namespace {

constexpr int kSettleRounds = 8;   // trials after which ligaments stay as they are
constexpr int kPatellaRounds = 4;  // the same of those of the patella
constexpr int kSettlingRows = 10;  // rows of the step before it

/// The staged scene, written and tried out until it is as good as it gets.
class Settling {
 public:
  Settling(const NewScene& asked, std::string staged, std::string file, Composed& composed, Tried& tried,
           Diagnostics& out)
      : asked_(asked),
        staged_(std::move(staged)),
        file_(std::move(file)),
        composed_(composed),
        tried_(tried),
        out_(out) {}

  /// An error in words; empty: none.
  std::string settle() {
    const bool stl = asked_.kind == NewScene::Kind::stl;
    trial(true);
    for (int round = 0; round < kSettleRounds && settles(round); ++round) trial(false);
    if (stl && !composed_.lengths.empty()) aim();
    // What moves with the patella settles without it: it changes the balance of the tibia little.
    composed_.with_patella = !composed_.patella.text.empty();
    if (composed_.with_patella && found())
      tried_.without_patella = fmt::format("Without the patella {} of {} poses are solved.",
                                           found()->summary.poses_solved, found()->summary.poses_asked);
    for (int round = 0; composed_.with_patella && round < kPatellaRounds && error_.empty() && found(); ++round) {
      patella_trial(round == 0);
      if (error_.empty() && found() && !settle_patella(found()->poses, composed_.patella.lengths)) break;
    }
    if (stl && error_.empty() && found() && !all_solved(found()->summary.exit_code) &&
        found()->summary.poses_solved > kSettlingRows) {
      ask_for_flexion(composed_.words, found()->summary.poses_solved - kSettlingRows, true);
      trial(false);
    }
    return error_;
  }

 private:
  std::optional<Solution>& found() { return tried_.found; }

  void trial(bool first) { trial(first, out_); }
  void trial(bool first, Diagnostics& out) {
    tried_.text = composed_.whole();
    error_ = write_file_atomically(staged_, tried_.text);
    if (error_.empty()) found() = try_out(staged_, file_, asked_, first, out);
  }

  /// Says once what is done to the patella's mesh.
  void patella_trial(bool first) {
    Diagnostics all;
    trial(first, all);
    for (const Diagnostic& d : all.items())
      if (d.severity == Diagnostic::Severity::error || d.key.starts_with("surface.patella")) out_.add(d);
  }

  bool settles(int round) {
    if (!error_.empty() || !found() || !settle_ligaments(found()->poses, round, composed_.lengths)) return false;
    refer_to_balance(composed_.words, *found());
    return true;
  }

  /// Tests the knee's laxity, and changes ligaments and menisci until it is that of usual knees. Without that where the
  /// changed knee does not bend.
  void aim() {
    if (!bends()) return;
    Diagnostics ignored;
    const auto prepared = prepare(staged_, ignored);
    if (!prepared) return;
    const AimedKnee aimed = aim_at_ranges(*prepared, asked_.cancelled);
    if (asked_to_stop(asked_.cancelled)) {
      say_stopped(out_);
      found().reset();
      return;
    }
    tried_.laxity = aimed.laxity.text();
    tried_.aimed = text_of(aimed.aims);
    if (aimed.aims.isZero()) return;
    const Words lengths = composed_.lengths, words = composed_.words;
    for (const auto& [fibre, slack] : aimed.slack) set_slack(composed_.lengths[length_word(fibre)], slack);
    for (const auto& [fibre, stiffness] : aimed.stiffness)
      composed_.lengths[stiffness_word(fibre)] = stiffness_text(stiffness);
    for (int again = 0; again < kAimTrials && found(); ++again) {
      trial(false);
      if (again == 0 && bends()) refer_to_balance(composed_.words, *found());
    }
    if (bends() || !error_.empty() || !found()) return;
    tried_.laxity = aimed.before + "; with other ligaments it would not bend so far";
    tried_.aimed.clear();
    composed_.lengths = lengths;
    composed_.words = words;
    trial(false);
  }

  bool bends() { return error_.empty() && found() && all_solved(found()->summary.exit_code); }

  const NewScene& asked_;
  const std::string staged_, file_;
  Composed& composed_;
  Tried& tried_;
  Diagnostics& out_;
  std::string error_;
};

}  // namespace

std::string Composed::whole() {
  words["ligaments"] = filled_in(ligaments, lengths);
  words["patella"] = with_patella ? filled_in(patella.text, patella.lengths) : "";
  words["patella_ramp"] = with_patella ? patella.ramp : "";
  return filled_in(text, words);
}

std::string settle_new_scene(const NewScene& asked, const std::string& staged, const std::string& name,
                             Composed& composed, Tried& tried, Diagnostics& out) {
  return Settling(asked, staged, name, composed, tried, out).settle();
}

}  // namespace genu
