#include "genu/judge/findings.h"

#include <fmt/format.h>

namespace genu::judge {
namespace {

/// Value relative to its tolerance: over 1 it fails.
double badness(double worst, double tolerance) {
  if (!std::isfinite(worst)) return std::numeric_limits<double>::infinity();
  if (worst == 0) return 0;
  return tolerance > 0 ? worst / tolerance : std::numeric_limits<double>::infinity();
}

}  // namespace

Finding& Findings::of(const std::string& check, const std::string& unit) {
  const auto [place, fresh] = index_.emplace(check, all_.size());
  if (fresh) all_.push_back({.check = check, .unit = unit, .where = {}, .rejected = {}});
  return all_[place->second];
}

void Findings::expect(const std::string& check, const std::string& unit, double error, double tolerance,
                      const std::string& object) {
  Finding& f = of(check, unit);
  f.poses = 1;
  ++f.judged;
  const double bad = badness(error, tolerance);
  if (f.where.empty() || bad > badness(f.worst, f.tolerance)) {
    f.worst = error;
    f.tolerance = tolerance;
    f.where = fmt::format("row {}{}{}", row_ + 1, object.empty() ? "" : ", ", object);
  }
  if (!(error <= tolerance)) f.rejected.insert(row_);
}

void Findings::merge(const Findings& other) {
  for (const Finding& o : other.all_) {
    Finding& f = of(o.check, o.unit);
    if (f.judged == 0 || badness(o.worst, o.tolerance) > badness(f.worst, f.tolerance)) {
      f.worst = o.worst;
      f.tolerance = o.tolerance;
      f.where = o.where;
    }
    f.judged += o.judged;
    f.poses += o.poses;
    f.rejected.insert(o.rejected.begin(), o.rejected.end());
  }
  skipped_.insert(other.skipped_.begin(), other.skipped_.end());
}

}  // namespace genu::judge
