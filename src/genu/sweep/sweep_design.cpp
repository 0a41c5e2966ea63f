#include "genu/sweep/sweep_design.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include "genu/assemble/long_errors.h"
#include "genu/assemble/pose_file.h"
#include "genu/scene/words.h"
#include "genu/sweep/fraction.h"
#include "genu/sweep/normal_quantile.h"
#include "genu/sweep/philox.h"
#include "genu/sweep/sobol_numbers.h"
#include "genu/sweep/tolerances.h"

namespace genu {
namespace {

std::vector<std::string> names_of(const std::vector<Factor>& factors) {
  std::vector<std::string> names;
  for (const Factor& factor : factors) names.push_back(factor.name);
  return names;
}

std::optional<double> to_number(const std::string& text) {
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// A row of numbers for each sample, in the order of the factors.
std::vector<std::vector<double>> read_points(const SweepDef& sweep, const std::vector<Factor>& factors,
                                             InputFiles& files, Diagnostics& out) {
  const auto bytes = files.bytes(sweep.points);  // the same that the study's hash has seen
  const auto file = bytes ? parse_pose_file(*bytes, sweep.points, out) : read_pose_file(sweep.points, out);
  if (!file) return {};
  LongErrors errors(sweep.points, out);
  const std::vector<std::string> names = names_of(factors);
  std::vector<std::size_t> column(names.size(), file->names.cells.size());
  for (std::size_t c = 0; c < file->names.cells.size(); ++c) {
    const PoseFile::Cell& cell = file->names.cells[c];
    const auto name = std::find(names.begin(), names.end(), cell.text);
    if (name == names.end())
      errors.add({file->names.line, cell.column}, Code::unknown_name, cell.text, {},
                 "is no factor of this study" + did_you_mean(cell.text, names));
    else
      column[static_cast<std::size_t>(name - names.begin())] = c;
  }
  for (std::size_t f = 0; f < names.size(); ++f)
    if (column[f] == file->names.cells.size())
      errors.add({file->names.line, 1}, Code::missing_key, names[f], {}, "has no column here");
  if (errors.count() > 0) return {};
  std::vector<std::vector<double>> points;
  for (const PoseFile::Row& row : file->rows) {
    points.emplace_back();
    for (std::size_t f = 0; f < names.size(); ++f) {
      const PoseFile::Cell& cell = row.cells[column[f]];
      const auto number = to_number(cell.text);
      if (!number)
        errors.add({row.line, cell.column}, Code::wrong_form, names[f], with_quotes(cell.text), "is no number");
      points.back().push_back(number.value_or(0));
    }
  }
  return points;
}

/// The levels of a factor, its centre first where one at a time is varied.
std::vector<double> levels_of(const Distribution& d, const std::vector<double>& probabilities, bool centre) {
  if (d.kind == Distribution::Kind::values) return d.values;
  std::vector<double> levels;
  if (centre) levels.push_back(d.quantile(0.5));
  for (const double p : probabilities) levels.push_back(d.quantile(p));
  return levels;
}

bool find_correlated(const SweepDef& sweep, const std::vector<Factor>& factors, std::vector<std::size_t>& correlated,
                     Diagnostics& out) {
  const CorrelationDef& c = *sweep.correlation;
  const std::vector<std::string> names = names_of(factors);
  bool good = true;
  const auto refuse = [&](SourceLocation where, Code code, const std::string& found, const std::string& rule) {
    out.add(error_at({sweep.file, where}, code, "correlation.factors", found, rule));
    good = false;
  };
  for (std::size_t k = 0; k < c.factors.size(); ++k) {
    const auto place = std::find(names.begin(), names.end(), c.factors[k]);
    const auto f = static_cast<std::size_t>(place - names.begin());
    if (place == names.end())
      refuse(c.places[k], Code::unknown_name, with_quotes(c.factors[k]),
             "is no factor of this study" + did_you_mean(c.factors[k], names) +
                 " (a factor is a number, or an entry of [vary] that ends with :together)");
    else if (std::find(correlated.begin(), correlated.end(), f) != correlated.end())
      refuse(c.places[k], Code::duplicate, with_quotes(c.factors[k]), "is given twice");
    else if (factors[f].mesh_error)
      refuse(c.places[k], Code::not_applicable, with_quotes(c.factors[k]),
             "is no amount that could correlate: meshes that are moved :together err alike");
    correlated.push_back(f);
  }
  if (sweep.indices)
    refuse(c.where, Code::conflict, {}, "excludes `indices`: Sobol indices belong to independent factors");
  if (!is_random(sweep.design))
    refuse(c.where, Code::conflict, {}, std::string("has no effect on the design ") + to_string(sweep.design));
  return good;
}

}  // namespace

std::optional<SweepDesign> SweepDesign::make(const SweepDef& sweep, const std::vector<Factor>& factors,
                                             InputFiles& files, Diagnostics& out) {
  SweepDesign d;
  d.kind_ = sweep.design;
  d.seed_ = sweep.seed;
  const std::size_t before = out.count(Diagnostic::Severity::error);
  for (const Factor& factor : factors) {
    d.distributions_.push_back(sweep.vary[factor.vary].distribution);
    d.mesh_errors_.push_back(factor.mesh_error);
  }
  const auto refuse = [&](Code code, const std::string& rule) { out.error(code, sweep.file, rule); };
  const std::uint64_t count = factors.size();
  d.block_ = sweep.indices ? count + 2 : 1;
  d.samples_ = sweep.samples * d.block_;
  if (sweep.correlation && find_correlated(sweep, factors, d.correlated_, out))
    d.cholesky_ = sweep.correlation->matrix.llt().matrixL();
  if (sweep.design == DesignKind::sobol) {
    const std::uint64_t dimensions = sweep.indices ? 2 * count : count;
    if (dimensions > kMaxSobolDimensions)
      refuse(Code::too_large, fmt::format("needs {} dimensions, and the sequence has {}: vary fewer numbers or move "
                                          "them :together, or use latin_hypercube",
                                          dimensions, kMaxSobolDimensions));
    else
      d.sobol_.emplace(sweep.seed, static_cast<std::uint32_t>(dimensions));
  }
  if (sweep.indices && count == 0) refuse(Code::missing_key, "varies nothing, and `indices` are those of factors");
  if (sweep.design == DesignKind::points) {
    d.points_ = read_points(sweep, factors, files, out);
    d.samples_ = d.points_.size();
  }
  if (sweep.design == DesignKind::fractional_factorial) d.divide(sweep, factors, out);
  if (sweep.design == DesignKind::factorial || sweep.design == DesignKind::one_at_a_time) {
    const bool centre = sweep.design == DesignKind::one_at_a_time;
    double product = 1, sum = 1;
    for (const Distribution& distribution : d.distributions_) {
      d.levels_.push_back(levels_of(distribution, sweep.probabilities, centre));
      product *= static_cast<double>(d.levels_.back().size());
      sum += static_cast<double>(d.levels_.back().size() - 1);
    }
    const double all = centre ? sum : product;
    d.samples_ = all > static_cast<double>(kMaxSamples) ? 0 : static_cast<std::uint64_t>(all);
  }
  if (out.count(Diagnostic::Severity::error) == before &&
      (d.samples_ == 0 || d.samples_ > static_cast<std::uint64_t>(kMaxSamples)))
    refuse(Code::too_large, fmt::format("has more than {} samples", kMaxSamples));
  if (out.count(Diagnostic::Severity::error) > before) return std::nullopt;
  return d;
}

double SweepDesign::unit(std::uint64_t sample, std::uint32_t dimension) const {
  if (kind_ == DesignKind::sobol) return sobol_->coordinate(sample, dimension);
  if (kind_ == DesignKind::latin_hypercube) return latin_hypercube_coordinate(seed_, sample, dimension, samples_);
  return monte_carlo_coordinate(seed_, sample, dimension);
}

double SweepDesign::draw(std::size_t factor, double unit, std::uint64_t sample, std::uint32_t dimension) const {
  constexpr int kDropped = 11;  // 53 bits are a double and a decimal number
  if (mesh_errors_[factor])
    return static_cast<double>(random_bits(seed_, sample, dimension, DrawPurpose::mesh_error) >> kDropped);
  return distributions_[factor].quantile(unit);
}

std::vector<double> SweepDesign::random_draws(std::uint64_t sample) const {
  std::vector<double> u;
  for (std::uint32_t f = 0; f < distributions_.size(); ++f) u.push_back(unit(sample, f));
  VecX z(static_cast<Eigen::Index>(correlated_.size()));
  for (std::size_t k = 0; k < correlated_.size(); ++k)
    z[static_cast<Eigen::Index>(k)] = normal_quantile(u[correlated_[k]]);
  if (!correlated_.empty()) z = cholesky_ * z;
  for (std::size_t k = 0; k < correlated_.size(); ++k)
    u[correlated_[k]] = inside_unit(normal_probability(z[static_cast<Eigen::Index>(k)]));
  std::vector<double> draws;
  for (std::uint32_t f = 0; f < distributions_.size(); ++f) draws.push_back(draw(f, u[f], sample, f));
  return draws;
}

std::vector<double> SweepDesign::scheme_draws(std::uint64_t sample) const {
  const std::uint64_t base = sample / block_, member = sample % block_;
  const auto count = static_cast<std::uint32_t>(distributions_.size());
  std::vector<double> draws;
  for (std::uint32_t f = 0; f < count; ++f) {
    const bool from_b = member == 1 || member == f + 2;
    const std::uint32_t dimension = from_b ? count + f : f;
    draws.push_back(draw(f, unit(base, dimension), base, dimension));
  }
  return draws;
}

std::vector<double> SweepDesign::factorial_draws(std::uint64_t sample) const {
  std::vector<double> draws(levels_.size());
  for (std::size_t f = levels_.size(); f-- > 0;) {  // the last factor changes fastest
    draws[f] = levels_[f][sample % levels_[f].size()];
    sample /= levels_[f].size();
  }
  return draws;
}

void SweepDesign::divide(const SweepDef& sweep, const std::vector<Factor>& factors, Diagnostics& out) {
  for (std::size_t f = 0; f < factors.size(); ++f) {
    levels_.push_back(levels_of(distributions_[f], sweep.probabilities, false));
    if (levels_.back().size() == 2) continue;
    const VaryDef& vary = sweep.vary[factors[f].vary];
    out.add(error_at({sweep.file, vary.where}, Code::wrong_form, "vary." + vary.name, {},
                     "must have two values: every factor of a fractional factorial design has two levels"));
  }
  if (const auto fraction = find_fraction(factors.size(), sweep.resolution)) {
    words_ = fraction->words;
    samples_ = std::uint64_t{1} << fraction->bits;
  } else {
    out.error(
        Code::too_large, sweep.file,
        fmt::format("has {} factors, and a fraction of resolution {} for them has more than {} samples: ask for a "
                    "lower resolution, or move numbers :together",
                    factors.size(), sweep.resolution, 1 << kMostFractionBits));
  }
}

std::vector<double> SweepDesign::fractional_draws(std::uint64_t sample) const {
  std::vector<double> draws;
  for (std::size_t f = 0; f < levels_.size(); ++f) draws.push_back(levels_[f][second_level(words_[f], sample) ? 1 : 0]);
  return draws;
}

std::vector<double> SweepDesign::one_at_a_time_draws(std::uint64_t sample) const {
  std::vector<double> draws;
  std::uint64_t first = 1;  // the sample with this factor's second level
  for (const std::vector<double>& levels : levels_) {
    const std::uint64_t others = levels.size() - 1;
    const bool mine = sample >= first && sample < first + others;
    draws.push_back(levels[mine ? sample - first + 1 : 0]);
    first += others;
  }
  return draws;
}

std::vector<double> SweepDesign::draws(std::uint64_t sample) const {
  if (kind_ == DesignKind::points) return points_[sample];
  if (kind_ == DesignKind::factorial) return factorial_draws(sample);
  if (kind_ == DesignKind::fractional_factorial) return fractional_draws(sample);
  if (kind_ == DesignKind::one_at_a_time) return one_at_a_time_draws(sample);
  return block_ > 1 ? scheme_draws(sample) : random_draws(sample);
}

}  // namespace genu
