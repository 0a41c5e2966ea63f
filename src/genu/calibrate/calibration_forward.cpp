#include "genu/calibrate/calibration_forward.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "genu/assemble/parameter_values.h"
#include "genu/calibrate/tolerances.h"
#include "genu/results/outputs.h"
#include "genu/scene/toml_document.h"

namespace genu {
namespace {

bool starts_with_name(const std::string& column, const std::string& name) {
  return column.size() > name.size() && column.compare(0, name.size(), name) == 0 && column[name.size()] == '.';
}

/// Coordinates of free joints, and forces of contacts with their regions.
std::vector<std::string> kept_columns(const Prepared& p) {
  std::vector<std::string> kept;
  for (const Output& o : outputs_of(p.scene, p.model, p.steps, 1)) {
    const auto& joints = p.scene.joints;
    const auto& pairs = p.model.pairs;
    const bool of_joint = std::any_of(joints.begin(), joints.end(),
                                      [&](const JointDef& joint) { return starts_with_name(o.column, joint.name); }) &&
                          (o.unit == "deg" || o.unit == "mm");
    const bool of_pair = o.column.ends_with(".force_N") &&
                         std::any_of(pairs.begin(), pairs.end(),
                                     [&](const auto& pair) { return starts_with_name(o.column, pair.name); });
    if (of_joint || of_pair) kept.push_back(o.column);
  }
  return kept;
}

/// "\"a\", \"b\""
std::string quoted(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += fmt::format("{}\"{}\"", out.empty() ? "" : ", ", word);
  return out;
}

/// Members together as [vary] of a study names them.
std::string vary_key(const CalibrationUnknown& unknown) {
  std::string key;
  for (const auto& member : unknown.members) key += (key.empty() ? "" : "+") + member.parameter.name;
  return unknown.members.size() > 1 ? key + ":together" : key;
}

}  // namespace

ResultTable result_errors(const ScenesUnknowns& unknowns, const Prepared& fitted, const VecX& u,
                          const std::vector<PoseRecord>& records, const MatX& covariance) {
  const std::vector<Output> outputs = outputs_of(fitted.scene, fitted.model, fitted.steps, 1);
  ResultTable table;
  for (const char* column : {"step", "increment"}) table.add_column(column);
  for (const Output& o : outputs) table.add_column(o.column);
  Sensitivity sensitivity(fitted.scene, fitted.model);
  for (const PoseRecord& record : records) {
    table.add_row();
    table.set("step", static_cast<long>(record.point.step));
    table.set("increment", static_cast<long>(record.point.increment));
    const auto rates = unknowns.rates(sensitivity, u, record.point, outputs);
    if (!rates) continue;
    for (std::size_t o = 0; o < outputs.size(); ++o) {
      const auto g = rates->row(static_cast<Eigen::Index>(o));
      table.set(o + 2, std::sqrt(std::max(0.0, g.dot(g * covariance))));
    }
  }
  return table;
}

std::string sweep_study(const Prepared& fitted, const std::string& scene_file, const std::string& scene_text,
                        const std::vector<CalibrationUnknown>& unknowns, const VecX& deviations,
                        const MatX& correlation) {
  Diagnostics unused;
  const auto document = parse_toml(scene_text, scene_file, unused);
  if (!document || fitted.scene.dynamics || fitted.steps.empty()) return {};
  std::string vary, left_out;
  std::vector<std::string> factors;
  std::vector<Eigen::Index> chosen;
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    const CalibrationUnknown& unknown = unknowns[k];
    const auto i = static_cast<Eigen::Index>(k);
    const double s = deviations[i];
    if (!std::isfinite(s) || !(s > 0)) {
      left_out += fmt::format("# {} is not determined, and keeps its number.\n", unknown.name);
      continue;
    }
    factors.push_back(vary_key(unknown));
    chosen.push_back(i);
    if (unknown.share) {
      const double mean = std::exp(s * s / 2);  // u is normal, with mean 0 here: exp(u) is lognormal
      vary += fmt::format("\"{}\" = {{ lognormal = {}, sd = {}, relative = true }}\n", factors.back(), mean,
                          mean * std::sqrt(std::expm1(s * s)));
    } else {
      const double unit = parameter_place(fitted.source, unknown.members.front().parameter, *document).file_unit;
      vary += fmt::format("\"{}\" = {{ normal = 0, sd = {}, add = true }}\n", factors.back(), s * unknown.scale / unit);
    }
  }
  if (factors.empty()) return {};
  std::string out =
      "# The fitted scene with its numbers drawn as uncertain as the fit left them: genu sweep study.toml\n" +
      left_out +
      fmt::format(
          "format = 1\ntitle = \"{}: uncertain as fitted\"\nscene = \"{}\"\nsamples = {}\nseed = 1\n"
          "\n[vary]\n{}\n",
          "fitted scene", scene_file, kForwardSamples, vary);
  if (factors.size() > 1) {
    out += fmt::format("[correlation]\nfactors = [{}]\nmatrix = [\n", quoted(factors));
    for (const Eigen::Index i : chosen) {
      std::string row;
      for (const Eigen::Index j : chosen)
        row += fmt::format("{}{}", row.empty() ? "" : ", ", i == j ? 1.0 : correlation(std::max(i, j), std::min(i, j)));
      out += "  [" + row + "],\n";
    }
    out += "]\n\n";
  }
  return out + fmt::format("[[keep]]\ncolumns = [{}]\nat = \"all\"\n", quoted(kept_columns(fitted)));
}

}  // namespace genu
