#include "genu/calibrate/calibration_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "genu/calibrate/tolerances.h"
#include "genu/core/decompositions.h"

namespace genu {

namespace {

class FindingsWriter {
 public:
  FindingsWriter(const CalibrationProblem& problem, const CalibrationSearch& search)
      : problem_(problem), search_(search), unknowns_(problem.unknowns()) {}

  CalibrationFindings write() {
    find_errors();
    add_parameters();
    add_directions();
    add_fit();
    add_slack();
    add_starts();
    add_values();
    out_.covariance = covariance_;
    return std::move(out_);
  }

 private:
  /// Unknowns at a bound stay there: the errors are those of the others.
  bool at_bound(std::size_t k) const {
    const double u = search_.fit.x[static_cast<Eigen::Index>(k)];
    return u <= unknowns_[k].lower || u >= unknowns_[k].upper;
  }

  void find_errors() {
    const MatX& J = search_.jacobian;
    MatX free(J.rows(), 0);
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
      if (at_bound(k)) continue;
      free.conservativeResize(Eigen::NoChange, free.cols() + 1);
      free.rightCols(1) = J.col(static_cast<Eigen::Index>(k));
      free_.push_back(static_cast<Eigen::Index>(k));
    }
    const double noise = derivative_noise(search_.exact);
    const auto variance = problem_.has_stated_errors() ? std::optional(1.0) : std::nullopt;
    const VecX& r = search_.at_end.residuals;
    errors_ = least_squares_uncertainty(free, r, noise, variance);
    const Eigen::Index rows = problem_.target_rows();
    of_target_ = least_squares_uncertainty(MatX(free.topRows(rows)), r.head(rows), noise, variance);
    const auto n = static_cast<Eigen::Index>(unknowns_.size());
    covariance_ = MatX::Zero(n, n);
    out_.report.correlation = MatX::Identity(n, n);
    for (std::size_t i = 0; i < free_.size(); ++i)
      for (std::size_t j = 0; j < free_.size(); ++j) {
        const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(j);
        covariance_(free_[i], free_[j]) = errors_.covariance(a, b);
        out_.report.correlation(free_[i], free_[j]) = errors_.correlation(a, b);
      }
  }

  void add_parameters() {
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
      const CalibrationUnknown& unknown = unknowns_[k];
      const double u = search_.fit.x[static_cast<Eigen::Index>(k)];
      CalibrationReport::Parameter p{unknown.name, unknown.unit, unknown.shown(0), unknown.shown(u), 0, {}, 0};
      const auto place = std::find(free_.begin(), free_.end(), static_cast<Eigen::Index>(k));
      if (place == free_.end())
        p.note = "at its bound";
      else
        p.deviation = errors_.deviation[place - free_.begin()] * std::abs(unknown.shown_slope(u));
      if (unknown.prior) p.prior = unknown.prior->deviation;
      if (unknown.prior && p.deviation > kPriorRules * p.prior) p.note = "its prior alone holds it";
      const bool slack = std::find(search_.slack.begin(), search_.slack.end(), k) != search_.slack.end();
      if (slack) p.note = "slack in every pose";
      out_.report.parameters.push_back(p);
    }
  }

  /// "j1.damping", or the parameters that change together.
  std::string direction(const VecX& v) const {
    std::string together;
    int count = 0;
    for (Eigen::Index k = 0; k < v.size(); ++k) {
      if (std::abs(v[k]) < kNamedComponent) continue;
      const std::string& name = unknowns_[static_cast<std::size_t>(free_[static_cast<std::size_t>(k)])].name;
      together += (count++ > 0 ? ", " : "") + fmt::format("{} {:+.2f}", name, v[k]);
      if (std::abs(v[k]) > 1 - kNamedComponent * kNamedComponent) return name;
    }
    return "a change of " + together + " together (shares of themselves)";
  }

  void add_directions() {
    for (const VecX& v : of_target_.undetermined) out_.report.undetermined.push_back(direction(v));
    const Eigen::Index n = errors_.covariance.rows();
    if (n < 2 || !out_.report.undetermined.empty()) return;
    const auto eigen = symmetric_eigen(errors_.covariance);
    const double best = std::sqrt(eigen.values.minCoeff());
    Eigen::Index worst = 0;
    const double largest = std::sqrt(eigen.values.maxCoeff(&worst));
    VecX v = eigen.vectors.col(worst);
    if (!(largest > kPoorDirection * best)) return;
    Eigen::Index most = 0;
    v.cwiseAbs().maxCoeff(&most);
    if (v[most] < 0) v = -v;
    out_.report.poorest = direction(v);
    out_.report.poorest_deviation = largest;
  }

  void add_fit() {
    CalibrationReport& r = out_.report;
    r.stop = to_string(search_.fit.stop);
    r.converged = converged(search_.fit.stop);
    r.iterations = search_.fit.iterations;
    r.exact = search_.exact;
    const auto rms = [](const VecX& v) { return std::sqrt(v.squaredNorm() / static_cast<double>(v.size())); };
    const Eigen::Index rows = problem_.target_rows();
    r.rms = rms(search_.at_end.residuals.head(rows));
    if (search_.at_start.residuals.size() > 0) r.start_rms = rms(search_.at_start.residuals.head(rows));
    add_misfit();
  }

  void add_misfit() {
    const auto share = problem_.misfit(search_.at_end.residuals, static_cast<Eigen::Index>(free_.size()));
    if (!share) return;
    out_.report.misfit = fmt::format(
        "the scene does not follow the target: the residuals are {:.2g} times the stated errors, which cannot be "
        "chance",
        std::sqrt(*share));
  }

  void add_slack() {
    CalibrationReport& r = out_.report;
    std::string names;
    for (const std::size_t k : search_.slack) {
      const CalibrationUnknown& unknown = unknowns_[k];
      const auto column = static_cast<Eigen::Index>(k);
      std::string sentence = unknown.name + " is slack in every pose of the target, which does not depend on it";
      std::vector<CalibrationPrediction::Stretch> longest(unknown.members.size());
      for (const CalibrationPrediction& p : search_.at_end.predictions)
        for (std::size_t m = 0; !p.stretch.empty() && m < longest.size(); ++m)
          longest[m].longest = std::max(longest[m].longest, p.stretch[k][m].longest);
      CalibrationUnknown unbounded = unknown;
      unbounded.lower = -std::numeric_limits<double>::infinity();
      unbounded.upper = std::numeric_limits<double>::infinity();
      if (const auto taut = taut_start(unbounded, search_.fit.x[column], longest, 0))
        sentence += fmt::format("; it would from {:.4g} {} on", unknown.shown(*taut), unknown.unit);
      r.slack.push_back(sentence);
      names += (names.empty() ? "" : ", ") + unknown.name;
    }
    if (names.empty()) return;
    r.converged = false;
    r.stop = "not converged: " + names + (search_.slack.size() == 1 ? " is" : " are") +
             " slack in every pose, also from a taut start";
  }

  std::vector<double> shown(const VecX& u) const {
    std::vector<double> out;
    for (std::size_t k = 0; k < unknowns_.size(); ++k)
      out.push_back(unknowns_[k].shown(u[static_cast<Eigen::Index>(k)]));
    return out;
  }

  void add_starts() {
    for (const CalibrationStart& s : search_.starts)
      out_.report.starts.push_back({s.name, to_string(s.stop), shown(s.start), shown(s.end), s.rms, s.iterations});
  }

  /// Standard errors of values that follow from those of the unknowns.
  VecX deviations(const MatX& derivatives) const {
    VecX out(derivatives.rows());
    for (Eigen::Index k = 0; k < out.size(); ++k)
      out[k] = std::sqrt(std::max(0.0, derivatives.row(k).dot(derivatives.row(k) * covariance_)));
    return out;
  }

  void add_values() {
    ResultTable& table = out_.comparison;
    const auto& experiments = problem_.experiments();
    const bool several = experiments.size() > 1;
    if (several) table.add_column("file");
    for (const auto& e : experiments)
      for (const std::string& name : e->place_columns())
        if (!table.has_column(name)) table.add_column(name);
    for (const char* name : {"column", "target", "scene", "difference", "standard_error"}) table.add_column(name);
    Eigen::Index first = 0;
    for (std::size_t e = 0; e < experiments.size(); ++e) {
      const CalibrationExperiment& experiment = *experiments[e];
      const CalibrationPrediction p =
          experiment.held_out ? experiment.predict(search_.fit.x, search_.exact) : search_.at_end.predictions[e];
      const Eigen::Index rows = static_cast<Eigen::Index>(experiment.values().size());
      MatX J;
      if (p.derivatives.size() > 0)
        J = p.derivatives;
      else if (!experiment.held_out && search_.jacobian.size() > 0)
        J = experiment.scales().asDiagonal() * search_.jacobian.middleRows(first, rows);
      if (!experiment.held_out) first += rows;
      if (p.values.size() == 0) continue;
      const VecX errors = J.size() > 0 ? deviations(J) : VecX();
      add_rows(experiment, p.values, errors, several);
      for (std::size_t c = 0; c < experiment.columns().size(); ++c)
        out_.report.columns.push_back(column(experiment, c, p.values));
      const std::string number = several ? fmt::format("-{}", e + 1) : "";
      for (const auto& [word, chart] : experiment.pictures(p.values, errors))
        out_.pictures.emplace_back("fit" + number + (word.empty() ? "" : "-" + word) + ".svg", to_svg(chart));
    }
  }

  void add_rows(const CalibrationExperiment& experiment, const VecX& values, const VecX& errors, bool several) {
    ResultTable& table = out_.comparison;
    for (std::size_t k = 0; k < experiment.values().size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      const CalibrationExperiment::Value& v = experiment.values()[k];
      table.add_row();
      if (several) table.set("file", experiment.file);
      experiment.set_place(k, table);
      table.set("column", experiment.columns()[v.column].name);
      table.set("target", v.wanted);
      table.set("scene", values[row]);
      table.set("difference", v.wanted - values[row]);
      if (errors.size() > 0) table.set("standard_error", errors[row]);
    }
  }

  static CalibrationReport::Column column(const CalibrationExperiment& experiment, std::size_t c, const VecX& values) {
    const CalibrationExperiment::Column& own = experiment.columns()[c];
    CalibrationReport::Column out{own.name, 0, 0, own.scale, experiment.file, own.stated, experiment.held_out};
    for (std::size_t k = 0; k < experiment.values().size(); ++k) {
      if (experiment.values()[k].column != c) continue;
      ++out.values;
      out.rms += std::pow(values[static_cast<Eigen::Index>(k)] - experiment.values()[k].wanted, 2);
    }
    out.rms = std::sqrt(out.rms / static_cast<double>(std::max<std::size_t>(1, out.values)));
    return out;
  }

  const CalibrationProblem& problem_;
  const CalibrationSearch& search_;
  const std::vector<CalibrationUnknown>& unknowns_;
  std::vector<Eigen::Index> free_;  ///< unknowns that are at no bound
  LeastSquaresUncertainty errors_, of_target_;
  MatX covariance_;
  CalibrationFindings out_;
};

}  // namespace

CalibrationFindings find_out(const CalibrationProblem& problem, const CalibrationSearch& search) {
  return FindingsWriter(problem, search).write();
}

}  // namespace genu
