#include "studies/dortmans_family.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>
#include <random>
#include <sstream>

#include <fmt/format.h>

#include "genu/scene/reader.h"

namespace genu::studies {
namespace {

constexpr double kEndSpan = 5;  // mm
constexpr double kStrainSpan = 0.06;
constexpr double kStiffer = 2;      // and as much softer
constexpr double kSpacingSpan = 4;  // mm
constexpr double kSlopeSpan = 7;    // deg
constexpr int kSearchIncrements = 14;
constexpr double kUnsolved = 1e3;  // missed by a scene that is not solved throughout

constexpr std::size_t kOfSpring = 6;

double beyond(double value, double low, double high) { return std::max({0.0, low - value, value - high}); }

struct Shares {
  double worst_difference = 0, whole = 0, fall = 0, growth = std::numeric_limits<double>::infinity();
};

/// Of both contacts: paths against each other, and how the share of sliding changes over seven equal stretches.
Shares shares_of(const DortmansReading& r) {
  Shares out;
  const std::size_t rows = r.flexion.size() - 1;
  for (const ContactShift& s : r.shifts) {
    out.worst_difference = std::max(out.worst_difference, std::abs(s.tibia.back() / s.femur.back() - 1));
    out.whole = std::max(out.whole, sliding_share(s, 0, rows));
    double before = 0, first = 0;
    for (std::size_t k = 0; k < 7; ++k) {
      const double share = sliding_share(s, k * rows / 7, (k + 1) * rows / 7);
      if (k == 0) first = share;
      if (k > 0) out.fall = std::max(out.fall, before - share);
      before = share;
    }
    out.growth = std::min(out.growth, before - first);
  }
  return out;
}

double cost(const Scene& scene, const std::vector<double>& set) {
  double outside = 0;
  std::vector<double> inside = set;
  for (double& x : inside) {
    outside += std::pow(beyond(x, -1, 1), 2);
    x = std::clamp(x, -1.0, 1.0);
  }
  Diagnostics problems;
  const auto reading = solve_reading(with_numbers(scene, inside), problems);
  if (!reading) return kUnsolved + outside;
  double sum = outside;
  for (const DortmansStatement& s : statements_of(*reading)) sum += s.missed * s.missed;
  return sum;
}

}  // namespace

std::vector<FreeNumber> free_numbers(const Scene& scene) {
  std::vector<FreeNumber> out;
  for (const LigamentDef& l : scene.ligaments) {
    for (const char* end : {".from.y_mm", ".from.z_mm", ".to.y_mm", ".to.z_mm"})
      out.push_back({l.name + end, kEndSpan});
    out.push_back({l.name + ".reference_strain", kStrainSpan});
    out.push_back({l.name + ".stiffness", kStiffer});
  }
  out.push_back({"spacing_mm", kSpacingSpan});
  out.push_back({"slope_deg", kSlopeSpan});
  return out;
}

Scene with_numbers(Scene scene, const std::vector<double>& set) {
  constexpr double kMillimetre = 1e-3;
  for (std::size_t k = 0; k < scene.ligaments.size(); ++k) {
    LigamentDef& l = scene.ligaments[k];
    const double* x = &set[kOfSpring * k];
    l.from.point.y() += kMillimetre * kEndSpan * x[0];
    l.from.point.z() += kMillimetre * kEndSpan * x[1];
    l.to.point.y() += kMillimetre * kEndSpan * x[2];
    l.to.point.z() += kMillimetre * kEndSpan * x[3];
    l.rest_value += kStrainSpan * x[4];
    l.numbers[0].value *= std::pow(kStiffer, x[5]);
  }
  const double spacing = kMillimetre * kSpacingSpan * set[kOfSpring * scene.ligaments.size()];
  const double slope = M_PI / 180 * kSlopeSpan * set[kOfSpring * scene.ligaments.size() + 1];
  for (SurfaceDef& s : scene.surfaces) {
    s.placement.p.x() += s.placement.p.x() < 0 ? -spacing : spacing;
    if (s.shape == SurfaceDef::Shape::plane) s.placement.R = exp_rotation(Vec3(slope, 0, 0)) * s.placement.R;
  }
  return scene;
}

std::vector<DortmansStatement> statements_of(const DortmansReading& r) {
  std::vector<DortmansStatement> out;
  const bool complete =
      r.all_stable && r.shifts[0].femur.size() == r.flexion.size() && r.shifts[1].femur.size() == r.flexion.size();
  out.push_back({"every pose to 70 deg is solved and stable, with both contacts", complete ? "yes" : "no",
                 complete ? 0 : kUnsolved});
  if (!complete) return out;
  const auto [least, most] = std::minmax_element(r.exorotation.begin(), r.exorotation.end());
  out.push_back({"the femur exorotates a little: by 0.5 to 5 deg at most, never inward by more than 0.5",
                 fmt::format("{:.2f} to {:.2f} deg", *least + 0.0, *most),
                 beyond(*most, 0.5, 5) + beyond(*least, -0.5, 5)});
  out.push_back({"the moment is -1 N m in extension (to 5 %)", fmt::format("{:.3f} N m", r.moment.front()),
                 10 * beyond(r.moment.front(), -1.05, -0.95)});
  out.push_back({"and 0.5 N m at 70 deg (to 5 %)", fmt::format("{:.3f} N m", r.moment.back()),
                 10 * beyond(r.moment.back(), 0.475, 0.525)});
  const Shares shares = shares_of(r);
  out.push_back({"the contacts' paths on tibia and femur are not much different: by at most 25 %",
                 fmt::format("{:.0f} %", 100 * shares.worst_difference),
                 10 * beyond(shares.worst_difference, 0, 0.25)});
  out.push_back({"mainly rolling: sliding is less than half of the femur's path",
                 fmt::format("{:.0f} %", 100 * shares.whole), 10 * beyond(shares.whole, 0, 0.5)});
  out.push_back(
      {"sliding grows: by 10 % or more over the seven stretches of 10 deg, and falls by no more than 2 % between two",
       fmt::format("by {:+.0f} %, falls by {:.0f} %", 100 * shares.growth, 100 * shares.fall),
       10 * beyond(shares.growth, 0.1, 1) + 10 * beyond(shares.fall, 0, 0.02)});
  return out;
}

std::optional<DortmansReading> solve_reading(const Scene& scene, Diagnostics& out) {
  const auto solved = solve_scene(scene, out);
  if (!solved) return std::nullopt;
  return reading_of(*solved);
}

FamilyMember search_family(const Scene& full, std::uint64_t seed, int generations) {
  Scene scene = full;
  scene.steps[0].increments = kSearchIncrements;
  const std::size_t n = free_numbers(scene).size();
  const double N = static_cast<double>(n);
  const int lambda = 4 + static_cast<int>(3 * std::log(N)), mu = lambda / 2;
  std::vector<double> weight;
  for (int i = 0; i < mu; ++i) weight.push_back(std::log(mu + 0.5) - std::log(i + 1.0));
  const double total = std::accumulate(weight.begin(), weight.end(), 0.0);
  double squares = 0;
  for (double& w : weight) w /= total, squares += w * w;
  const double mueff = 1 / squares, cs = (mueff + 2) / (N + mueff + 5), ds = 1 + cs, cc = 4 / (N + 4);
  const double c1 = 2 / ((N + 1.3) * (N + 1.3) + mueff) * (N + 2) / 3;
  const double cmu = std::min(1 - c1, 2 * (mueff - 2 + 1 / mueff) / ((N + 2) * (N + 2) + mueff) * (N + 2) / 3);
  const double expected = std::sqrt(N) * (1 - 1 / (4 * N) + 1 / (21 * N * N));
  std::mt19937_64 random(seed);
  const auto normal = [&] {  // Box and Muller: the same on every library
    const auto uniform = [&] { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; };
    const double u = uniform(), v = uniform();
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * M_PI * v);
  };
  std::vector<double> mean(n, 0.0), variance(n, 1.0), path(n, 0.0), evolution(n, 0.0);
  double sigma = 0.15;
  if (seed > 0)
    for (double& m : mean) m = std::clamp(0.3 * normal(), -0.8, 0.8);
  FamilyMember best{mean, cost(scene, mean)};
  for (int g = 0; g < generations && best.missed > 0; ++g) {
    struct Child {
      std::vector<double> step;
      double missed;
    };
    std::vector<Child> children;
    for (int k = 0; k < lambda; ++k) {
      Child child{std::vector<double>(n), 0};
      std::vector<double> set(n);
      for (std::size_t i = 0; i < n; ++i) {
        child.step[i] = std::sqrt(variance[i]) * normal();
        set[i] = mean[i] + sigma * child.step[i];
      }
      child.missed = cost(scene, set);
      if (child.missed < best.missed) best = {set, child.missed};
      children.push_back(std::move(child));
    }
    std::sort(children.begin(), children.end(), [](const Child& a, const Child& b) { return a.missed < b.missed; });
    double length = 0;
    std::vector<double> move(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (int k = 0; k < mu; ++k)
        move[i] += weight[static_cast<std::size_t>(k)] * children[static_cast<std::size_t>(k)].step[i];
      mean[i] += sigma * move[i];
      path[i] = (1 - cs) * path[i] + std::sqrt(cs * (2 - cs) * mueff) * move[i] / std::sqrt(variance[i]);
      length += path[i] * path[i];
    }
    for (std::size_t i = 0; i < n; ++i) {
      evolution[i] = (1 - cc) * evolution[i] + std::sqrt(cc * (2 - cc) * mueff) * move[i];
      double spread = 0;
      for (int k = 0; k < mu; ++k)
        spread += weight[static_cast<std::size_t>(k)] * std::pow(children[static_cast<std::size_t>(k)].step[i], 2);
      variance[i] = (1 - c1 - cmu) * variance[i] + c1 * evolution[i] * evolution[i] + cmu * spread;
    }
    sigma *= std::exp(cs / ds * (std::sqrt(length) / expected - 1));
  }
  for (double& x : best.set) x = std::round(1e4 * std::clamp(x, -1.0, 1.0)) / 1e4;
  return best;
}

std::vector<KeptMember> read_family(const std::string& file, Diagnostics& out) {
  std::vector<KeptMember> members;
  std::ifstream in(file);
  if (!in) out.error(Code::not_applicable, file, "cannot be read");
  std::string line, cell;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    KeptMember m;
    std::getline(cells, m.scene, ',');
    std::getline(cells, cell, ',');
    m.seed = std::stoi(cell);
    while (std::getline(cells, cell, ',')) m.set.push_back(std::stod(cell));
    members.push_back(std::move(m));
  }
  return members;
}

std::string family_text(const std::vector<KeptMember>& members, const std::vector<FreeNumber>& numbers) {
  std::string out = "scene,seed";
  for (const FreeNumber& n : numbers) out += "," + n.name;
  out += "\n";
  for (const KeptMember& m : members) {
    out += fmt::format("{},{}", m.scene, m.seed);
    for (const double x : m.set) out += fmt::format(",{:g}", x + 0.0);
    out += "\n";
  }
  return out;
}

namespace {

constexpr const char* kScenes[] = {"scene.toml", "scene-outer-15.toml"};
constexpr const char* kWords[] = {"ring 15 mm, tube 5 mm", "outer radius 15 mm, tube 5 mm"};
constexpr const char* kFamily = "/family.csv";

bool all_hold(const DortmansReading& r) {
  const auto statements = statements_of(r);
  return std::all_of(statements.begin(), statements.end(), [](const auto& s) { return s.holds(); });
}

std::string yes(bool holds) { return holds ? "holds" : "**does not hold**"; }

std::string statement_table(const DortmansReading& first, const DortmansReading& second) {
  std::string out = fmt::format("| statement | {} | | {} | |\n|---|---|---|---|---|\n", kWords[0], kWords[1]);
  const auto a = statements_of(first), b = statements_of(second);
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
    out += fmt::format("| {} | {} | {} | {} | {} |\n", a[k].words, a[k].measured, yes(a[k].holds()), b[k].measured,
                       yes(b[k].holds()));
  return out;
}

std::string strain_table(const DortmansReading& first, const DortmansReading& second) {
  std::string out =
      "| strain less that in extension at | 10 | 30 | 50 | 70 deg | 10 | 30 | 50 | 70 deg |\n"
      "|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  for (std::size_t k = 0; k < first.springs.size(); ++k) {
    out += "| " + first.springs[k];
    for (const DortmansReading* r : {&first, &second})
      for (const std::size_t row : {10U, 30U, 50U, 70U}) out += fmt::format(" | {:+.4f}", r->strains[k][row]);
    out += " |\n";
  }
  return out;
}

/// Least and largest of some values, "-1.2 to 3.4".
std::string spread(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return fmt::format("{:.3g} to {:.3g}", *least + 0.0, *most + 0.0);
}

double change_of(const FreeNumber& n, double entry) {
  return n.name.ends_with(".stiffness") ? std::pow(n.span, entry) : n.span * entry;
}

}  // namespace

Files searched_family(const std::string& folder, int seeds, int generations, Diagnostics& out) {
  std::vector<KeptMember> members;
  std::vector<FreeNumber> numbers;
  for (const char* file : kScenes) {
    const auto scene = read_scene(folder + "/" + file, out);
    if (!scene) return {};
    numbers = free_numbers(*scene);
    for (int seed = 0; seed < seeds; ++seed) {
      const FamilyMember found = search_family(*scene, static_cast<std::uint64_t>(seed), generations);
      const auto solved = solve_reading(with_numbers(*scene, found.set), out);
      const bool holds = solved && all_hold(*solved);
      fmt::print("{} seed {}: {}\n", file, seed, holds ? "every statement holds" : "misses");
      if (holds) members.push_back({file, seed, found.set});
    }
  }
  return {{kFamily + 1, family_text(members, numbers)}};
}

Files family_files(const std::string& folder, Diagnostics& out) {
  const std::vector<KeptMember> members = read_family(folder + kFamily, out);
  const auto own = solve_dortmans(folder, out);
  if (out.has_errors() || own.size() < 2) return {};
  std::string text =
      "# Every statement of the report, in numbers\n\n"
      "Written by `tools/figures`; do not edit. The report's words are in [SOURCE.md](SOURCE.md), its figures in "
      "[STUDY.md](STUDY.md). Where\nwords have no number (\"a little\", \"not much different\"), the bound is chosen "
      "here, and is part of the statement.\n\n## With the numbers of the two scenes\n\n";
  text += statement_table(own[0], own[1]) + fmt::format("\nStrains, left {}, right {}:\n\n", kWords[0], kWords[1]) +
          strain_table(own[0], own[1]);
  text +=
      "\n## With other numbers\n\nThe report's table of springs is lost. Free are both ends of each spring in the "
      "sagittal plane (by 5 mm), its reference strain\n(by 0.06) and stiffness (twice or half), half the condyles' "
      "distance (by 4 mm) and the slope of the plateaus (by 7 deg, backward\nnegative). `studies family` searches from "
      "several seeds for sets with which every statement holds; `family.csv` keeps them, in\nshares of these spans. "
      "Each is solved anew for this page, at 71 poses.\n";
  for (std::size_t k = 0; k < 2; ++k) {
    const auto scene = read_scene(folder + "/" + kScenes[k], out);
    if (!scene) return {};
    std::vector<DortmansReading> solved;
    std::vector<std::vector<double>> sets;
    for (const KeptMember& m : members) {
      if (m.scene != kScenes[k]) continue;
      if (auto r = solve_reading(with_numbers(*scene, m.set), out)) {
        solved.push_back(std::move(*r));
        sets.push_back(m.set);
      }
    }
    const auto holding = std::count_if(solved.begin(), solved.end(), all_hold);
    text += fmt::format("\n### {}: {} of {} sets hold every statement\n\n", kWords[k], holding, solved.size());
    if (solved.empty()) continue;
    const auto over = [&](const auto& value) {
      std::vector<double> values;
      for (const DortmansReading& r : solved) values.push_back(value(r));
      return spread(values);
    };
    text += "| over the family | from and to |\n|---|---|\n";
    text += "| largest exorotation deg | " +
            over([](const auto& r) { return *std::max_element(r.exorotation.begin(), r.exorotation.end()); }) + " |\n";
    text += "| moment in extension N m | " + over([](const auto& r) { return r.moment.front(); }) + " |\n";
    text += "| moment at 70 deg N m | " + over([](const auto& r) { return r.moment.back(); }) + " |\n";
    text += "| paths apart by | " + over([](const auto& r) { return shares_of(r).worst_difference; }) + " |\n";
    text += "| sliding, share of the whole path | " + over([](const auto& r) { return shares_of(r).whole; }) + " |\n";
    for (std::size_t i = 0; i < solved[0].springs.size(); ++i)
      text += fmt::format("| {} strain at 70 deg less that in extension | {} |\n", solved[0].springs[i],
                          over([i](const auto& r) { return r.strains[i].back(); }));
    text += "\n| free number, change | from and to |\n|---|---|\n";
    const auto numbers = free_numbers(*scene);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      std::vector<double> changes;
      for (const auto& set : sets) changes.push_back(change_of(numbers[i], set[i]));
      text += fmt::format("| {}{} | {} |\n", numbers[i].name, numbers[i].name.ends_with(".stiffness") ? ", times" : "",
                          spread(changes));
    }
  }
  return {{"FAMILY.md", text}};
}

}  // namespace genu::studies
