#include "genu/study/accuracy_trials.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "genu/core/timer.h"
#include "genu/study/tolerances.h"

namespace genu {
namespace {

/// Solves a trial once, for `most` seconds or about that long; its table and rows are those of the last time. False
/// where it was called off: the trial is then as it was.
bool solve_once(Trial& trial, const RunOptions& options, double most, Solution* keep) {
  RunOptions mine = options;
  const Timer timer;
  mine.path.newton.cancelled =
      mine.cancelled = [&] { return timer.seconds() > most || asked_to_stop(options.cancelled); };
  ContactField field(trial.prepared->model);
  Solution solution = solve(*trial.prepared, field, mine);
  if (asked_to_stop(options.cancelled)) return false;
  trial.called_off = timer.seconds() > most;
  trial.solved = solution.summary.poses_solved;
  trial.asked = solution.summary.poses_asked;
  if (trial.solved > 0) {
    trial.seconds.push_back(seconds_of(solution.summary, "solving") / trial.solved);
    for (std::size_t k = 0; k < kAccuracyEffects; ++k)
      trial.effects[k].push_back(effect_seconds(*trial.prepared, k) / trial.solved);
  }
  trial.poses = solution.poses;
  if (keep != nullptr) *keep = std::move(solution);
  return true;
}

double patience(const AccuracySetting& setting) {
  return setting.knob == AccuracySetting::Knob::tolerance ? kShortPatience : kTrialPatience;
}

class Rounds {
 public:
  Rounds(std::vector<Trial>& trials, const AccuracyChoice& choice, const RunOptions& options, Solution& own)
      : trials_(trials), choice_(choice), options_(options), own_(own) {}

  /// One round over the trials from `first`. False where it is called off.
  bool run(std::size_t first) {
    for (std::size_t i = first; i < trials_.size(); ++i) {
      Trial& trial = trials_[i];
      if (trial.asked > 0 && !trial.complete()) continue;  // what does not get there need not be timed
      const double most = own_seconds_ > 0 ? std::max(kMinPatience, patience(trial.setting) * own_seconds_)
                                           : std::numeric_limits<double>::infinity();
      const Timer timer;
      if (!solve_once(trial, options_, most, own_seconds_ > 0 ? nullptr : &own_)) return false;
      if (own_seconds_ == 0) own_seconds_ = timer.seconds();
      ++done_;
      if (options_.varied_progress) options_.varied_progress(done_, std::max(done_, asked()));
    }
    return true;
  }

 private:
  int asked() const { return choice_.rounds * static_cast<int>(trials_.size()); }

  std::vector<Trial>& trials_;
  const AccuracyChoice& choice_;
  const RunOptions& options_;
  Solution& own_;
  double own_seconds_ = 0;
  int done_ = 0;
};

}  // namespace

double effect_seconds(const Prepared& prepared, std::size_t effect) {
  constexpr std::array<std::array<Effect, 2>, kAccuracyEffects> kEffectsOf = {
      {{Effect::contact_search, Effect::contact_search},
       {Effect::rigid_contacts, Effect::layers},
       {Effect::ligaments, Effect::ligaments}}};
  const auto& [first, second] = kEffectsOf[effect];
  const EffectMeter& meter = *prepared.model.meter;
  return meter.seconds(first) + (second == first ? 0 : meter.seconds(second));
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double spread(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t outside = values.size() / 4;
  return (values[values.size() - 1 - outside] - values[outside]) / median(values);
}

std::optional<Trial> make_trial(const Prepared& prepared, const AccuracySetting& setting) {
  const Timer timer;
  Trial trial{setting, with_setting(prepared, setting)};
  if (!trial.prepared) return std::nullopt;
  trial.build_seconds = timer.seconds();
  return trial;
}

bool solve_all(std::vector<Trial>& trials, const AccuracyChoice& choice, const RunOptions& options,
               const std::function<std::vector<Trial>(const std::vector<Trial>&)>& later, int& rounds, Solution& own) {
  const Timer timer;
  Rounds round(trials, choice, options, own);
  bool joined = false;
  for (rounds = 0; rounds == 0 || (rounds < choice.rounds && timer.seconds() < choice.seconds); ++rounds) {
    if (!round.run(0)) return rounds > 0;
    const bool last = rounds + 1 >= choice.rounds || timer.seconds() >= choice.seconds;
    if (joined || (!last && rounds + 1 < kMinRounds)) continue;
    joined = true;
    const std::size_t first = trials.size();
    for (Trial& trial : later(trials)) trials.push_back(std::move(trial));
    if (!round.run(first)) trials.resize(first);
  }
  return true;
}

}  // namespace genu
