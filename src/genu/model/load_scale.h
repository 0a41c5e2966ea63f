// A function of time or of a joint coordinate: multiplies a load in addition to its step factor, or gives the course of
// a driven coordinate. A curve through points, a sine, or a smooth step. Feedback is a function of both: with the
// course r of its target, gain (r(t) - q) + rate_gain (r'(t) - q'); the second term acts in motion only.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "genu/law/monotone_table.h"
#include "genu/scene/scene.h"

namespace genu {

class LoadScale {
 public:
  struct Value {
    double factor = 1;
    double slope = 0;      ///< d factor / d x, per rad, m or s
    double curvature = 0;  ///< d2 factor / d x2
  };

  /// Empty where the definition is invalid; `why` then gives the reason.
  [[nodiscard]] static std::optional<LoadScale> make(const ScaleDef& def, std::string& why);

  /// The coordinate (rad, m) that it depends on; empty: the time (s).
  const std::optional<CoordinateRef>& coordinate() const { return coordinate_; }

  /// A table is the monotone curve through its points (MonotoneTable), constant beyond its ends. Its slope may jump at
  /// the ends, where the outer slope 0 is returned; likewise at the start of a sine. A step of zero duration has its
  /// second value from its start on.
  Value evaluate(double x) const;

  /// The same at a time (s): x is the coordinate, where there is one. Of feedback without its term with rates.
  Value evaluate(double x, double time) const;

  /// d factor / d time (1/s) at a fixed pose; `slope` as evaluate() gave it.
  double rate_in_time(double time, double slope) const;

  bool is_feedback() const { return target_ != nullptr; }

  /// Whether feedback depends on the coordinate's rate.
  bool has_rate() const { return rate_gain_ != 0; }
  /// That term, at a time (s) and a rate of the coordinate (rad/s, m/s).
  double rate_term(double time, double rate) const;

  /// Times (s) where the factor or a derivative may jump; empty for a scale over a coordinate.
  std::vector<double> nonsmooth_points_in_time() const;

  /// Where the slope jumps: the ends of a table over a coordinate (rad, m); none for other scales.
  struct NonsmoothPoint {
    double x = 0, below = 0, above = 0;  ///< slopes on both sides
  };
  std::vector<NonsmoothPoint> nonsmooth_points_over_coordinate() const;

  /// Of a sine, s; else 0.
  double period() const;

  /// The largest |factor|.
  double largest() const { return largest_; }

 private:
  Value table(double x) const;
  Value sine(double x) const;
  Value step(double x) const;

  ScaleDef::Kind kind_ = ScaleDef::Kind::over_time;
  std::optional<CoordinateRef> coordinate_;
  std::optional<MonotoneTable> table_;
  double first_ = 0, last_ = 0;  ///< x of the table's ends
  std::vector<double> knots_;    ///< x of its points, the sine's start, or the step's start and end
  double offset_ = 0, amplitude_ = 0, angular_frequency_ = 0, start_ = 0;
  double from_ = 0, to_ = 1, rise_ = 0;
  double largest_ = 0;
  double gain_ = 0, rate_gain_ = 0;          ///< feedback
  std::shared_ptr<const LoadScale> target_;  ///< feedback
};

}  // namespace genu
