#include "genu/appraise/appraise.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include "genu/appraise/barely_held.h"
#include "genu/appraise/contact_location.h"
#include "genu/appraise/hertz_check.h"
#include "genu/appraise/implausible.h"
#include "genu/appraise/jumps.h"
#include "genu/appraise/layer_doubts.h"
#include "genu/appraise/layer_verdict.h"
#include "genu/appraise/patella.h"
#include "genu/appraise/place.h"
#include "genu/appraise/unstable.h"
#include "genu/appraise/untouched.h"
#include "genu/appraise/verdict.h"
#include "genu/core/timer.h"

namespace genu {
namespace {

void note_pose(const PosePoint& point, RunSummary& s) {
  if (!point.solved()) return;
  const int contacts = static_cast<int>(point.pose.state.contacts.size());
  s.fewest_contacts = s.poses_solved == 0 ? contacts : std::min(s.fewest_contacts, contacts);
  s.most_contacts = std::max(s.most_contacts, contacts);
  ++s.poses_solved;
  if (point.stability.verdict == Stability::Verdict::stable && !point.stability.complex_pair) ++s.poses_stable;
  s.smallest_force = std::min(s.smallest_force, point.report.certificate.smallest_force);
  s.smallest_gap = std::min(s.smallest_gap, point.report.certificate.smallest_gap);
}

}  // namespace

std::vector<std::string> doubts_of(const Prepared& prepared, const Solved& solved, const ResultTable& poses) {
  std::vector<std::string> doubts;
  const auto add = [&](std::vector<std::string> sentences) {
    std::move(sentences.begin(), sentences.end(), std::back_inserter(doubts));
  };
  if (solved.complete()) add(patella_sentences(prepared, solved.records, solved.events));  // else the verdict has them
  add(jump_sentences(prepared, solved.events));
  add(unstable_sentences(prepared, solved.records));
  add(barely_held_sentences(prepared, solved.records, poses));
  add(implausible(prepared, solved.records, poses));
  if (needs_contact(prepared)) add(untouched_sentences(prepared, solved.records, poses));
  return doubts;
}

void classify(const std::vector<std::string>& doubts, bool doubted, RunSummary& s) {
  if (s.exit_code != kExitOk) {
    s.verdict_class = RunSummary::Class::not_solved;
    for (const std::string& sentence : doubts) s.verdict.push_back(as_sentence(sentence));
    return;
  }
  if (doubts.empty() && !doubted) return;
  s.verdict_class = RunSummary::Class::doubtful;
  s.exit_code = kExitDoubtful;
  for (std::size_t k = doubts.size(); k-- > 0;)
    s.verdict.insert(s.verdict.begin(), k > 0 ? as_sentence(doubts[k]) : "Solved, but " + doubts[k] + ".");
}

RunSummary appraise(const Prepared& prepared, const Solved& solved, const ResultTable& poses) {
  RunSummary s = begin_summary(prepared);
  s.poses_asked = solved.asked;
  s.smallest_force = s.smallest_gap = std::numeric_limits<double>::infinity();
  for (const PoseRecord& record : solved.records) note_pose(record.point, s);
  s.partial = !solved.stopped.empty();
  s.effects = solved.effects;
  s.iterations = solved.path.iterations;
  s.substeps = solved.path.substeps;
  s.worst_residual = solved.path.worst_residual;
  s.exit_code = solved.complete() ? kExitOk : kExitIncomplete;
  s.bearable_loads = solved.path.borne_loads;
  const Timer timer;
  s.locations = locate_contacts(prepared, solved.records);
  s.verdict = verdict_sentences(prepared, solved.records, solved.events, s);
  s.seconds.emplace_back("solving", solved.seconds);
  const auto add = [&](std::vector<std::string> sentences) {
    s.verdict.insert(s.verdict.end(), sentences.begin(), sentences.end());
  };
  if (!needs_contact(prepared))
    for (const std::string& sentence : untouched_sentences(prepared, solved.records, poses))
      s.verdict.push_back(as_sentence(sentence));
  add(layer_sentences(prepared.scene, prepared.model, poses));
  say_layer_doubts(prepared, solved.records, s.verdict);
  s.hertz = hertz_checks(prepared, solved.records, poses);
  add(hertz_sentences(s.hertz));
  classify(doubts_of(prepared, solved, poses), !prepared.facing.empty(), s);
  s.seconds.emplace_back("appraising", timer.seconds());
  return s;
}

}  // namespace genu
