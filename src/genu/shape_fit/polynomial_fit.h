// Least squares of polynomials h = sum c u^i v^j of total degree d, i + j <= d, well conditioned for high degrees.
//
// The columns are products of Legendre polynomials over the box that the samples fill, which are nearly orthogonal
// there; one Householder QR serves all degrees up to the highest, because the columns are ordered by degree. Only the
// result is written out in powers of u and v.
//
// The degree is chosen by cross-validation that leaves out blocks of the box and not single samples: noise of a
// segmentation is alike over some mm, and a neighbour that stays in would vouch for it.
#pragma once

#include <vector>

#include "genu/core/types.h"
#include "genu/surface/analytic.h"
#include "genu/surface/surface_chart.h"

namespace genu {

inline constexpr int kLowestFitDegree = 1;
inline constexpr int kHighestFitDegree = 12;

/// A sample of the height h over (u, v), and what it counts for.
struct HeightSample {
  double u = 0, v = 0, h = 0;
  double weight = 1;
};

/// How well a degree predicts blocks it has not seen.
struct DegreeScore {
  int degree = 0;
  double left_out_rms = 0;  ///< of h, weighted, m
  double fitted_rms = 0;    ///< the same of all samples when all take part, m
};

class PolynomialFit {
 public:
  /// Prepares fits of degrees up to `highest`; the box sets the scale of u and v.
  PolynomialFit(const std::vector<HeightSample>& samples, const ChartBox& box, int highest);

  /// The highest degree that the samples determine (at least kSamplesForEach samples a coefficient); -1 for none.
  int highest() const { return highest_; }

  /// The best polynomial of a degree from 0 to highest(), in powers of u and v.
  std::vector<PolynomialTerm> terms(int degree) const;

  /// Cross-validation of degrees `lowest` to highest(), in blocks of `block_u` x `block_v`.
  std::vector<DegreeScore> scores(int lowest, double block_u, double block_v) const;

  /// Of h, weighted, with the best polynomial of a degree.
  double rms(int degree) const;

 private:
  const std::vector<HeightSample>& samples_;
  ChartBox box_;
  int highest_ = -1;
  double weight_ = 0;
  MatX Q_, R_;  ///< of the weighted columns: orthonormal, and triangular
  VecX right_, Qh_;
};

/// Of a polynomial written down before: the lowest degree from kLowestFitDegree that leaves no more than the highest,
/// where that leaves at most `resolution` (m, rms); -1 where it leaves more.
int exact_degree(const PolynomialFit& fit, double resolution);

/// The lowest degree whose left-out rms is within 5 % of the best (plus `floor`, m: what no mesh file resolves).
int choose_degree(const std::vector<DegreeScore>& scores, double floor);

}  // namespace genu
