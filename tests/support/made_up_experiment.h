// An experiment without a scene: what it predicts is up to the test.
#pragma once

#include "genu/calibrate/calibration_experiment.h"

namespace genu::test {

class MadeUpExperiment : public CalibrationExperiment {
 public:
  std::vector<std::string> place_columns() const override { return {}; }
  void set_place(std::size_t, ResultTable&) const override {}
  std::vector<std::pair<std::string, Chart>> pictures(const VecX&, const VecX&) const override { return {}; }
  std::string label(std::size_t) const override { return ""; }
};

}  // namespace genu::test
