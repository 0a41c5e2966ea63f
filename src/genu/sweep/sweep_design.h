// The draws of every sample, from (seed, sample) alone.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/core/input_files.h"
#include "genu/sweep/sweep_def.h"
#include "genu/sweep/sweep_factors.h"
#include "genu/sweep/unit_cube.h"

namespace genu {

class SweepDesign {
 public:
  SweepDesign() = default;
  /// The design of a study over these factors. Empty, with the reasons in `out`: correlations of names that are no
  /// factors, columns of a points file that are none, too many samples or dimensions.
  [[nodiscard]] static std::optional<SweepDesign> make(const SweepDef& sweep, const std::vector<Factor>& factors,
                                                       InputFiles& files, Diagnostics& out);

  std::uint64_t samples() const { return samples_; }
  /// Samples of a block of Saltelli's scheme: A, B, then A with the column of each factor from B; 1 without it.
  std::uint64_t block() const { return block_; }
  /// A number for each factor, as its distribution gives it.
  std::vector<double> draws(std::uint64_t sample) const;

 private:
  void divide(const SweepDef& sweep, const std::vector<Factor>& factors, Diagnostics& out);
  /// Of a factor at a coordinate of the unit cube; of a mesh's error a whole number below 2^53.
  double draw(std::size_t factor, double unit, std::uint64_t sample, std::uint32_t dimension) const;
  double unit(std::uint64_t sample, std::uint32_t dimension) const;
  std::vector<double> random_draws(std::uint64_t sample) const;
  std::vector<double> scheme_draws(std::uint64_t sample) const;
  std::vector<double> factorial_draws(std::uint64_t sample) const;
  std::vector<double> fractional_draws(std::uint64_t sample) const;
  std::vector<double> one_at_a_time_draws(std::uint64_t sample) const;

  DesignKind kind_ = DesignKind::monte_carlo;
  std::uint64_t samples_ = 1, block_ = 1, seed_ = 1;
  std::vector<Distribution> distributions_;  // of each factor
  std::vector<bool> mesh_errors_;            // of each factor: its draws name random fields
  std::vector<std::vector<double>> levels_;  // of each factor, in a factorial or one-at-a-time design
  std::vector<std::uint32_t> words_;         // of each factor, in a fractional factorial (fraction.h)
  std::vector<std::size_t> correlated_;      // factors
  MatX cholesky_;                            // of their correlations
  std::vector<std::vector<double>> points_;
  std::optional<SobolSequence> sobol_;
};

}  // namespace genu
