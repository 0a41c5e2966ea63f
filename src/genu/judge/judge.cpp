#include "genu/judge/judge.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "genu/judge/motion.h"
#include "genu/judge/pose.h"
#include "genu/judge/required.h"
#include "genu/judge/start_sides.h"

namespace genu::judge {
namespace {

bool has_columns(const Scene& scene, const ResultsFile& table, const std::string& name, Diagnostics& out) {
  bool all = true;
  std::set<std::string> told;
  for (const std::string& column : required_columns(scene)) {
    if (table.has(column) || !told.insert(column).second) continue;
    all = false;
    out.add(error_at({name, {1, 0}}, Code::other_scene, column, {},
                     "is missing: the scene asks for this column; is it the scene that these results are of?"));
  }
  return all;
}

void judge_static(const Subject& subject, const StartSides& sides, const Row& row, bool surfaces, Findings& out) {
  PoseCase pose;
  if (!begin_pose(subject, row, out, pose)) return;
  PoseForces forces;
  check_row(pose);
  check_prescribed(pose);
  check_ligaments(pose, nullptr, forces);
  check_bushings(pose, nullptr, forces);
  add_loads(pose, forces);
  check_contacts(pose, forces);
  if (surfaces) check_gaps(pose);
  if (surfaces) sides.check(pose);
  check_layers(pose, surfaces, forces);
  check_balance(pose, forces);
}

void say_what_is_left(const Scene& scene, const ResultsFile& table, Judgement& judgement) {
  auto& left = judgement.not_judged;
  left.assign(judgement.findings.skipped().begin(), judgement.findings.skipped().end());
  std::vector<std::string> columns;
  for (const std::string& column : table.unread())
    if (column != "newton.iterations") columns.push_back(printable(column));
  if (std::erase_if(columns, [](const std::string& c) { return c.starts_with("stability"); }) > 0)
    left.emplace_back("stability: needs second derivatives of the surfaces and of what is held");
  if (std::erase_if(columns, [](const std::string& c) { return c.starts_with("energy."); }) > 0)
    left.emplace_back("energies of a motion");
  constexpr std::size_t kColumnsListed = 8;
  const std::size_t told = std::min(kColumnsListed, columns.size());
  const std::string more = columns.size() > told ? fmt::format(" and {} more", columns.size() - told) : "";
  if (told > 0)
    left.push_back(fmt::format("columns: {}{}",
                               fmt::join(columns.begin(), columns.begin() + static_cast<long>(told), ", "), more));
  if (!scene.steps.empty() && !scene.contacts.empty()) left.emplace_back("whether other equilibria exist");
}

}  // namespace

std::size_t Judgement::rejected() const {
  std::set<std::size_t> rows_rejected;
  for (const Finding& f : findings.all()) rows_rejected.insert(f.rejected.begin(), f.rejected.end());
  return rows_rejected.size();
}

std::optional<Judgement> judge_results(const Scene& scene, const std::string& csv, const std::string& csv_name,
                                       const Options& options, Diagnostics& out) {
  const auto table = ResultsFile::parse(csv, csv_name, out);
  if (!table || !has_columns(scene, *table, csv_name, out)) return std::nullopt;
  const auto subject = make_subject(scene, options.samples, out);
  if (!subject) return std::nullopt;
  Judgement judgement;
  judgement.rows = table->rows();
  std::vector<std::size_t> good;
  for (std::size_t r = 0; r < table->rows(); ++r)
    if (table->status(r) == "ok")
      good.push_back(r);
    else
      judgement.not_ok.emplace_back(r, table->status(r));
  judgement.judged = good.size();
  std::vector<Findings> each;
  for (const std::size_t r : good) each.emplace_back(r);
  const StartSides sides(*subject);
  const MotionRows motion(*subject, *table, good);
  tbb::parallel_for(std::size_t{0}, good.size(), [&](std::size_t k) {
    const bool surfaces = k % std::max<std::size_t>(1, options.every) == 0 || k + 1 == good.size();
    if (scene.dynamics)
      motion.judge(k, surfaces, each[k]);
    else
      judge_static(*subject, sides, {&*table, good[k]}, surfaces, each[k]);
  });
  for (const Findings& f : each) judgement.findings.merge(f);
  if (options.every > 1 && !(scene.contacts.empty() && scene.layers.empty()))
    judgement.findings.skip(fmt::format("overlap and pressure of all rows but every {}th", options.every));
  for (std::size_t r = 1; r < table->rows(); ++r)
    if (table->has("branch") && table->number(r, "branch") != table->number(r - 1, "branch"))
      judgement.jumps.push_back(r);
  say_what_is_left(scene, *table, judgement);
  return judgement;
}

}  // namespace genu::judge
