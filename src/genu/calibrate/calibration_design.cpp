#include "genu/calibrate/calibration_design.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "genu/calibrate/tolerances.h"
#include "genu/core/decompositions.h"
#include "genu/scene/words.h"

namespace genu {
namespace {

class DesignRanker {
 public:
  DesignRanker(const std::vector<CalibrationUnknown>& unknowns, const VecX& u, const MatX& information,
               const std::vector<DesignCandidate>& candidates, const std::vector<std::string>& named)
      : unknowns_(unknowns), u_(u), candidates_(candidates), before_(information), measure_(u.size()) {
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      const auto same = [&](const std::string& name) {
        return name == unknowns[k].name || matches(name, unknowns[k].name);
      };
      if (named.empty() || std::any_of(named.begin(), named.end(), same)) named_.push_back(k);
      const auto i = static_cast<Eigen::Index>(k);
      measure_[i] = kUnknownBefore * unknowns[k].standard_change();
      if (!unknowns[k].prior) before_(i, i) += 1 / (measure_[i] * measure_[i]);
    }
  }

  CalibrationDesign rank() {
    find_information();
    for (ResultTable* table : {&out_.ranked, &out_.order}) begin(*table);
    const VecX now = errors(before_);
    add(out_.ranked, "none", 1, now);
    std::vector<std::size_t> order = possible_;
    std::vector<double> narrowing(candidates_.size());
    for (const std::size_t k : possible_) narrowing[k] = narrows(now, errors(before_ + information_[k]));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return narrowing[a] < narrowing[b]; });
    for (const std::size_t k : order)
      add(out_.ranked, candidates_[k].name, narrowing[k], errors(before_ + information_[k]));
    add_order(now, order);
    write();
    return std::move(out_);
  }

 private:
  /// J_k^T J_k of each candidate; those that cannot be computed are said.
  void find_information() {
    information_.resize(candidates_.size());
    std::vector<std::string> failed(candidates_.size());
    tbb::parallel_for(std::size_t{0}, candidates_.size(), [&](std::size_t k) {
      const CalibrationExperiment& e = *candidates_[k].experiment;
      const CalibrationPrediction p = e.predict(u_, true);
      failed[k] = p.failed;
      if (failed[k].empty() && p.derivatives.size() == 0) failed[k] = "its columns have no exact derivatives";
      if (failed[k].empty())
        information_[k] = (e.scales().cwiseInverse().asDiagonal() * p.derivatives).transpose() *
                          (e.scales().cwiseInverse().asDiagonal() * p.derivatives);
    });
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      if (failed[k].empty())
        possible_.push_back(k);
      else
        said_ += fmt::format("  {:<12}{}: {}\n", "not ranked", candidates_[k].name, failed[k]);
    }
  }

  /// Standard errors of the named unknowns, as they are shown.
  VecX errors(const MatX& information) const {
    const auto eigen = symmetric_eigen(MatX(measure_.asDiagonal() * information * measure_.asDiagonal()));
    VecX out(static_cast<Eigen::Index>(named_.size()));
    for (std::size_t n = 0; n < named_.size(); ++n) {
      const auto i = static_cast<Eigen::Index>(named_[n]);
      const double variance = eigen.vectors.row(i).array().square().matrix().dot(eigen.values.cwiseInverse());
      out[static_cast<Eigen::Index>(n)] =
          measure_[i] * std::sqrt(variance) * std::abs(unknowns_[named_[n]].shown_slope(u_[i]));
    }
    return out;
  }

  static double narrows(const VecX& from, const VecX& to) { return std::exp((to.array() / from.array()).log().mean()); }

  void begin(ResultTable& table) const {
    for (const char* column : {"test", "narrowing"}) table.add_column(column);
    for (const std::size_t k : named_) table.add_column(unknowns_[k].name);
  }

  void add(ResultTable& table, const std::string& name, double narrowing, const VecX& errors) const {
    table.add_row();
    table.set("test", name);
    table.set("narrowing", narrowing);
    for (std::size_t n = 0; n < named_.size(); ++n)
      table.set(unknowns_[named_[n]].name, errors[static_cast<Eigen::Index>(n)]);
  }

  /// Each time the candidate that narrows most beside those chosen before.
  void add_order(const VecX& now, std::vector<std::size_t> left) {
    MatX information = before_;
    for (int chosen = 0; chosen < kDesignSteps && !left.empty(); ++chosen) {
      const auto best = std::min_element(left.begin(), left.end(), [&](std::size_t a, std::size_t b) {
        return narrows(now, errors(information + information_[a])) <
               narrows(now, errors(information + information_[b]));
      });
      information += information_[*best];
      add(out_.order, candidates_[*best].name, narrows(now, errors(information)), errors(information));
      left.erase(best);
    }
  }

  void write() {
    const auto lines = [&](const ResultTable& table, const char* title) {
      out_.text += fmt::format("  {:<12}{}\n", "design", title);
      for (std::size_t row = 0; row < table.rows(); ++row) {
        std::string errors;
        for (const std::size_t k : named_)
          errors += fmt::format("{}{} {:.2g}", errors.empty() ? "" : ", ", unknowns_[k].name,
                                table.number(row, unknowns_[k].name));
        out_.text += fmt::format("  {:<12}{:<24} {:6.3f}  {}\n", "", std::get<std::string>(table.at(row, 0)),
                                 table.number(row, "narrowing"), errors);
      }
    };
    lines(out_.ranked, "one more test, the best first: standard errors over those of today, and each of them");
    lines(out_.order, "tests one after another, each the best beside those before");
    out_.text += said_;
  }

  const std::vector<CalibrationUnknown>& unknowns_;
  const VecX& u_;
  const std::vector<DesignCandidate>& candidates_;
  MatX before_;
  VecX measure_;  ///< of each unknown, so that eigenvalues are comparable
  std::vector<std::size_t> named_, possible_;
  std::vector<MatX> information_;
  std::string said_;
  CalibrationDesign out_;
};

}  // namespace

CalibrationDesign rank_candidates(const std::vector<CalibrationUnknown>& unknowns, const VecX& u,
                                  const MatX& information, const std::vector<DesignCandidate>& candidates,
                                  const std::vector<std::string>& named) {
  return DesignRanker(unknowns, u, information, candidates, named).rank();
}

}  // namespace genu
