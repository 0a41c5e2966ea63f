// build/bin/population [--knees N] [--seed S] [--compare K] [--mirror M] [--jobs J]    random knees: solved, judged,
// compared build/bin/population --knee I [--seed S] --keep DIR                     one of them, its files left in DIR
//   1. draws each knee from the seed and its number: geometry, ligaments, loads, meshes; measured ones where data lies
//   2. runs it, has each ok pose judged, compares the first K comparable ones with a minimisation of energy, and the
//      first M with their mirror images
//   3. prints a table by kind, and each failure with the command that shows it again; exit code 1 if more than one in a
//      thousand failed, or any crashed, wrote a NaN or was rejected
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include <unistd.h>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "hard_cases/population/draw_knee.h"
#include "hard_cases/population/trial.h"
#include "support/places.h"

namespace genu::population {
namespace {

struct Options {
  int knees = 200, first = 0, compare = 200, mirror = 0;
  int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  std::uint64_t seed = 1;
  std::vector<int> these;  ///< numbers; else all from the first one
  std::string keep;
  TrialOptions trial;

  int number(int i) const { return these.empty() ? first + i : these[static_cast<std::size_t>(i)]; }
};

struct Tally {
  int knees = 0, solved = 0, diagnosed = 0, refused = 0, failed = 0, poses = 0, compared = 0, mirrored = 0,
      within_bars = 0, grave = 0;
  double seconds = 0;

  void add(const Trial& t) {
    ++knees;
    solved += t.end == Trial::End::solved;
    diagnosed += t.end == Trial::End::diagnosed;
    refused += t.end == Trial::End::refused;
    failed += t.end == Trial::End::failed;
    grave += t.grave;
    poses += t.poses;
    compared += t.compared;
    mirrored += t.mirrored;
    within_bars += t.within_bars;
    seconds += t.seconds;
  }
};

void print_row(const std::string& name, const Tally& t) {
  fmt::print("{:<44} {:>6} {:>7} {:>10} {:>8} {:>7} {:>8} {:>9} {:>9.2f}\n", name, t.knees, t.solved, t.diagnosed,
             t.refused, t.failed, t.poses, t.compared, t.seconds / std::max(1, t.knees));
}

/// Which of the knees the twin is asked about: the first `compare` that it knows.
std::vector<bool> chosen(const Options& options) {
  std::vector<bool> out(static_cast<std::size_t>(options.knees));
  int left = options.compare;
  for (int i = 0; i < options.knees && left > 0; ++i)
    if (draw_knee(options.seed, options.number(i), options.trial.data).comparable()) {
      out[static_cast<std::size_t>(i)] = true;
      --left;
    }
  return out;
}

class Population {
 public:
  explicit Population(const Options& options) : options_(options), compared_(chosen(options)) {}

  int run() {
    std::vector<std::thread> workers;
    for (int j = 0; j < options_.jobs; ++j) workers.emplace_back([this] { work(); });
    for (std::thread& w : workers) w.join();
    return report();
  }

 private:
  void work() {
    for (int i; (i = next_++) < options_.knees;) {
      TrialOptions trial = options_.trial;
      trial.compare = compared_[static_cast<std::size_t>(i)];
      trial.mirror = i < options_.mirror;
      const Trial done = run_trial(options_.seed, options_.number(i), trial);
      const std::lock_guard lock(mutex_);
      tallies_[done.kind].add(done);
      all_.add(done);
      if (done.end == Trial::End::diagnosed) ++statuses_[done.status];
      if (done.end == Trial::End::refused) ++statuses_["refused"];
      if (done.end == Trial::End::failed)
        failures_[options_.number(i)] = fmt::format("knee {} ({}): {}", options_.number(i), done.kind, done.why);
      say_progress();
    }
  }

  void say_progress() const {
    constexpr int kEach = 500;
    if (isatty(2) != 0)
      fmt::print(stderr, "\r{} of {} knees, {} failed", all_.knees, options_.knees, all_.failed);
    else if (all_.knees % kEach == 0)
      fmt::print(stderr, "{} of {} knees, {} failed\n", all_.knees, options_.knees, all_.failed);
  }

  int report() const {
    if (isatty(2) != 0) fmt::print(stderr, "\r{:50}\r", "");
    fmt::print("{:<44} {:>6} {:>7} {:>10} {:>8} {:>7} {:>8} {:>9} {:>9}\n", "knees", "", "solved", "diagnosed",
               "refused", "failed", "poses", "compared", "s a knee");
    for (const auto& [kind, tally] : tallies_) print_row(kind, tally);
    print_row("all", all_);
    for (const auto& [status, count] : statuses_) fmt::print("  {:<20} {}\n", status, count);
    for (const auto& [index, what] : failures_)
      fmt::print(
          "FAILED {}\n       build/bin/population --seed {} --knee {} --compare {} --mirror {} --keep out/knee\n", what,
          options_.seed, index, options_.compare > 0 ? 1 : 0, options_.mirror > 0 ? 1 : 0);
    fmt::print(
        "{} knees from number {} of seed {}: {} solved, {} diagnosed, {} refused, {} failed; {} poses judged, {} "
        "compared, {} in the "
        "mirror ({} knees within their error bars only)\n",
        all_.knees, options_.first, options_.seed, all_.solved, all_.diagnosed, all_.refused, all_.failed, all_.poses,
        all_.compared, all_.mirrored, all_.within_bars);
    constexpr int kOneIn = 1000;
    return all_.grave == 0 && all_.failed * kOneIn <= all_.knees ? 0 : 1;
  }

  Options options_;
  std::vector<bool> compared_;
  std::atomic<int> next_ = 0;
  std::mutex mutex_;
  std::map<std::string, Tally> tallies_;
  std::map<std::string, int> statuses_;
  std::map<int, std::string> failures_;
  Tally all_;
};

int run(Options options) {
  namespace fs = std::filesystem;
  const char* data = std::getenv("GENU_DATA");
  options.trial.data = data != nullptr ? std::string(data) : genu::test::data_default();
  if (!fs::exists(options.trial.data + "/ssm")) {
    options.trial.data.clear();
    fmt::print("no public knee data here (GENU_DATA): measured knees are left out\n");
  }
  if (!options.these.empty()) options.knees = static_cast<int>(options.these.size());
  options.trial.keep = !options.keep.empty();
  options.trial.folder = options.keep;
  if (!options.trial.keep)
    options.trial.folder = (fs::temp_directory_path() / fmt::format("genu-population-{}", getpid())).string();
  fs::create_directories(options.trial.folder);
  const int code = Population(options).run();
  if (!options.trial.keep) fs::remove_all(options.trial.folder);
  return code;
}

}  // namespace
}  // namespace genu::population

int main(int argc, char** argv) {
  using namespace genu::population;
  Options options;
  options.trial.genu = genu::test::program();
  CLI::App app{"Random knees from a seed: solved, judged, compared with another method"};
  app.add_option("--knees", options.knees, "how many")->check(CLI::Range(1, 10'000'000));
  app.add_option("--first", options.first, "number of the first one")->check(CLI::NonNegativeNumber);
  app.add_option("--seed", options.seed, "what they are drawn from");
  app.add_option("--knee", options.these, "these alone")->check(CLI::NonNegativeNumber);
  app.add_option("--compare", options.compare, "so many are compared with a minimisation of energy")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--mirror", options.mirror, "so many are solved as their mirror images too")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--jobs", options.jobs, "so many at a time")->check(CLI::Range(1, 256));
  app.add_option("--keep", options.keep, "leave scenes, meshes and results in this folder");
  app.add_option("--genu", options.trial.genu, "the program to try");
  CLI11_PARSE(app, argc, argv);
  return run(options);
}
