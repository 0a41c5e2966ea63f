// Results of checks: for each kind of check its worst value, the place, and the number of poses that fail.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace genu::judge {

/// One kind of check over all poses.
struct Finding {
  std::string check;               ///< "balance of forces"
  std::string unit;                ///< of worst and tolerance
  std::size_t judged = 0;          ///< numbers compared
  std::size_t poses = 0;           ///< in which
  double worst = 0;                ///< the value farthest beyond its tolerance, or nearest to it
  double tolerance = 0;            ///< the tolerance of that value
  std::string where;               ///< of the worst
  std::set<std::size_t> rejected;  ///< rows, from 0

  bool good() const { return rejected.empty(); }
};

/// Findings of one row or of many, in the order of first appearance.
class Findings {
 public:
  Findings() = default;
  explicit Findings(std::size_t row) : row_(row) {}

  /// `error` >= 0 must be at most `tolerance`; NaN and infinity fail. `object`: what the number belongs to.
  void expect(const std::string& check, const std::string& unit, double error, double tolerance,
              const std::string& object);
  /// Notes something that cannot be judged; repeated notes count once.
  void skip(const std::string& what) { skipped_.insert(what); }

  /// Adds the findings of another row; `place` names it: "row 3".
  void merge(const Findings& other);

  const std::vector<Finding>& all() const { return all_; }
  const std::set<std::string>& skipped() const { return skipped_; }

 private:
  Finding& of(const std::string& check, const std::string& unit);
  std::size_t row_ = 0;
  std::vector<Finding> all_;
  std::map<std::string, std::size_t> index_;
  std::set<std::string> skipped_;
};

}  // namespace genu::judge
