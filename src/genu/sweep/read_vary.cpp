#include "genu/sweep/read_vary.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "genu/sweep/tolerances.h"

namespace genu {
namespace {

constexpr const char* kTogether = ":together";
constexpr std::array kKinds = {"normal", "lognormal", "uniform", "values"};

void split_name(ReadContext& context, const Item& item, VaryDef& vary) {
  std::string names = vary.name;
  vary.together = names.ends_with(kTogether);
  if (vary.together) names.resize(names.size() - std::string_view(kTogether).size());
  std::stringstream parts(names);
  for (std::string part; std::getline(parts, part, '+');) vary.patterns.push_back(part);
  if (vary.patterns.size() > 1 && !vary.together)
    context.error(item.node->key_where, Code::wrong_form, item.path, {},
                  "names several patterns: end it with :together, or give each an entry of its own");
}

std::optional<std::pair<double, double>> read_range(ReadContext& context, const Item& item) {
  if (!item || !is_array(context, item, "[low, high]", 2)) return std::nullopt;
  const auto low = read_number(context, item.element(0)), high = read_number(context, item.element(1));
  if (!low || !high) return std::nullopt;
  if (*low < *high) return std::pair(*low, *high);
  refuse(context, item, Code::out_of_range, "must be [low, high] with low < high");
  return std::nullopt;
}

void read_normal(ReadContext& context, Section& table, bool logarithmic, VaryDef& vary) {
  Distribution& d = vary.distribution;
  const NumberRule any, above_0 = positive(any);
  const auto mean = read_number(context, table.find(logarithmic ? "lognormal" : "normal"), logarithmic ? above_0 : any);
  const auto sd = read_number(context, table.require("sd"), above_0);
  const Item bounds = table.find("truncated");
  const auto range = read_range(context, bounds);
  if (!mean || !sd) return;
  if (logarithmic)
    d = lognormal(*mean, *sd);
  else
    d.kind = Distribution::Kind::normal, d.mean = *mean, d.sd = *sd;
  if (!range) return;
  if (logarithmic && range->first < 0)
    refuse(context, bounds, Code::out_of_range, "must not reach below 0, where no lognormal number is");
  d.low = range->first;
  d.high = range->second;
  const double low = logarithmic ? std::log(std::max(d.low, 0.0)) : d.low,
               high = logarithmic ? std::log(d.high) : d.high;
  if (low > d.mean + kFarthestTruncation * d.sd || high < d.mean - kFarthestTruncation * d.sd)
    refuse(context, bounds, Code::out_of_range,
           fmt::format("leaves nothing of the distribution: it is more than {:g} standard deviations away",
                       kFarthestTruncation));
}

void read_values(ReadContext& context, Section& table, VaryDef& vary) {
  Distribution& d = vary.distribution;
  d.kind = Distribution::Kind::values;
  const auto numbers = [&](const Item& item, const NumberRule& rule) {
    std::vector<double> out;
    if (!item || !is_array(context, item, "an array of numbers")) return out;
    for (std::size_t k = 0; k < item.node->children.size(); ++k)
      if (const auto number = read_number(context, item.element(k), rule)) out.push_back(*number);
    return out;
  };
  const Item values = table.find("values"), weights = table.find("weights");
  d.values = numbers(values, {});
  d.weights = weights ? numbers(weights, positive({})) : std::vector<double>(d.values.size(), 1.0);
  if (d.values.empty()) refuse(context, values, Code::missing_key, "names no value");
  if (weights && weights.node->children.size() != values.node->children.size())
    refuse(context, weights, Code::wrong_form,
           fmt::format("must have {} numbers, one for each of `values`", values.node->children.size()));
}

/// sd and correlation_length, or estimated = true.
void read_mesh_error(ReadContext& context, Section& table, const SweepDef& sweep, VaryDef& vary) {
  MeshErrorDef error;
  const NumberRule any;
  NumberRule from_0;
  from_0.at_least = 0;
  const Item estimated = table.find("estimated");
  error.estimated = read_bool(context, estimated).value_or(false);
  const Item sd = error.estimated ? table.find("sd") : table.require("sd"),
             length = error.estimated ? table.find("correlation_length") : table.require("correlation_length");
  for (const Item& item : {sd, length})
    if (error.estimated && item) refuse(context, item, Code::conflict, "excludes `estimated`, which gives it");
  error.sd = read_number(context, sd, positive(any)).value_or(1);
  error.correlation_length = read_number(context, length, from_0).value_or(0);
  if (!is_random(sweep.design))
    table.error(
        Code::conflict, "",
        std::string("has no levels: the error of a mesh needs the design monte_carlo, latin_hypercube or sobol, "
                    "not ") +
            to_string(sweep.design));
  vary.mesh_error = error;
}

void read_how(ReadContext& context, Section& table, VaryDef& vary) {
  const bool relative = read_bool(context, table.find("relative")).value_or(false);
  const bool add = read_bool(context, table.find("add")).value_or(false);
  if (relative && add)
    table.error(Code::conflict, "add", "excludes `relative`: the draw multiplies the number, or is added");
  vary.how = relative ? VaryDef::How::relative : add ? VaryDef::How::added : VaryDef::How::absolute;
}

VaryDef read_entry(ReadContext& context, const Item& item, const SweepDef& sweep) {
  const bool from_points = sweep.design == DesignKind::points;
  VaryDef vary;
  vary.name = item.node->key;
  vary.where = item.node->key_where;
  split_name(context, item, vary);
  if (!is_table(context, item)) return vary;
  const auto of_mesh = [](const std::string& pattern) { return pattern.ends_with(kMeshError); };
  if (std::any_of(vary.patterns.begin(), vary.patterns.end(), of_mesh)) {
    Section table(context, item, "the error of a mesh");
    read_mesh_error(context, table, sweep, vary);
    table.finish();
    if (!std::all_of(vary.patterns.begin(), vary.patterns.end(), of_mesh))
      context.error(vary.where, Code::conflict, item.path, {},
                    "names meshes and numbers: give each an entry of its own");
    return vary;
  }
  Section table(context, item, "a varied number");
  std::vector<std::string> kinds;
  for (const char* kind : kKinds)
    if (table.has(kind)) kinds.emplace_back(kind);
  read_how(context, table, vary);
  if (from_points && !kinds.empty())
    table.error(Code::conflict, kinds.front(), "has no effect: the design `points` has the numbers");
  else if (!from_points && kinds.size() != 1)
    table.error(kinds.empty() ? Code::missing_key : Code::conflict, "",
                "must have one of normal, lognormal, uniform, values");
  if (kinds.size() == 1 && !from_points) {
    if (kinds[0] == "normal" || kinds[0] == "lognormal") read_normal(context, table, kinds[0] == "lognormal", vary);
    if (kinds[0] == "values") read_values(context, table, vary);
    if (kinds[0] == "uniform") {
      vary.distribution.kind = Distribution::Kind::uniform;
      const auto range = read_range(context, table.find("uniform")).value_or(std::pair(0.0, 1.0));
      std::tie(vary.distribution.low, vary.distribution.high) = range;
    }
  }
  table.finish();
  return vary;
}

}  // namespace

void read_vary(ReadContext& context, const Item& table, SweepDef& sweep) {
  if (!table || !is_table(context, table)) return;
  for (const TomlNode& child : table.node->children)
    sweep.vary.push_back(read_entry(context, table.member(child), sweep));
}

std::vector<std::pair<std::string, SourceLocation>> read_texts(ReadContext& context, const Item& item) {
  std::vector<std::pair<std::string, SourceLocation>> texts;
  if (!item) return texts;
  if (item.node->kind == TomlNode::Kind::string) return {{item.node->text, item.node->where}};
  if (!is_array(context, item, "a text or an array of texts")) return texts;
  for (std::size_t k = 0; k < item.node->children.size(); ++k)
    if (const auto text = read_string(context, item.element(k)))
      texts.emplace_back(*text, item.node->children[k].where);
  return texts;
}

void read_correlation(ReadContext& context, const Item& item, SweepDef& sweep) {
  if (!item || !is_table(context, item)) return;
  Section table(context, item, "correlations");
  CorrelationDef correlation;
  correlation.where = item.node->key_where;
  for (const auto& [name, where] : read_texts(context, table.require("factors"))) {
    correlation.factors.push_back(name);
    correlation.places.push_back(where);
  }
  const Item rows = table.require("matrix");
  table.finish();
  const std::size_t n = correlation.factors.size();
  const std::string form = fmt::format("{} rows of {} numbers, one for each of `factors`", n, n);
  if (!rows || !is_array(context, rows, form, n)) return;
  correlation.matrix = MatX::Identity(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  for (std::size_t r = 0; r < n; ++r) {
    const Item row = rows.element(r);
    if (!is_array(context, row, form, n)) return;
    for (std::size_t c = 0; c < n; ++c) {
      const auto number = read_number(context, row.element(c));
      if (!number) return;
      correlation.matrix(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = *number;
    }
  }
  if (n == 0) return refuse(context, rows, Code::missing_key, "correlates nothing");
  const MatX& m = correlation.matrix;
  const double off_one = (m.diagonal().array() - 1).abs().maxCoeff();
  if (!(off_one <= kCorrelationRounding) || !((m - m.transpose()).cwiseAbs().maxCoeff() <= kCorrelationRounding))
    return refuse(context, rows, Code::out_of_range, "is no correlation matrix: symmetric, with 1 on its diagonal");
  const double least = Eigen::SelfAdjointEigenSolver<MatX>(m).eigenvalues().minCoeff();
  if (!(least >= kLeastCorrelationEigenvalue))
    return refuse(context, rows, Code::out_of_range,
                  fmt::format("is no correlation matrix: its smallest eigenvalue is {:.3g}, and must be > 0", least));
  sweep.correlation = std::move(correlation);
}

}  // namespace genu
