// Something measured that a calibration follows: a target and the scene that is to reproduce it. Implementations: rows
// of a run (run_experiment.h), a laxity table (laxity_experiment.h).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "genu/calibrate/calibration_unknowns.h"
#include "genu/results/chart.h"
#include "genu/results/outputs.h"

namespace genu {

/// What the scene gives at values u of the unknowns.
struct CalibrationPrediction {
  /// A member of an unknown that is a number of a ligament's slack length, over all poses.
  struct Stretch {
    double longest = 0;  ///< largest length over its slack length; 0 for other members
    bool slack = true;   ///< carries no force anywhere
  };
  VecX values;       ///< in the units of the target; empty where a pose is missing
  MatX derivatives;  ///< exact, values by unknowns, per unit of u; empty where they were not asked for or do not exist
  std::vector<std::vector<Stretch>> stretch;  ///< of each unknown's members
  std::string failed;                         ///< why values are missing
  /// Where values are empty because some of them do not exist: the others. 0 where `there` is false.
  struct Part {
    VecX values;
    MatX derivatives;
    std::vector<bool> there;  ///< of each value
  };
  Part part = {};
};

/// A scene that has some members of the unknowns: those with the names that its own parameters have.
class ScenesUnknowns {
 public:
  /// `unknowns` must outlive this.
  ScenesUnknowns(Prepared base, const std::vector<CalibrationUnknown>& unknowns);

  const Prepared& base() const { return base_; }
  bool none() const { return none_; }  ///< it has no member of any unknown

  /// The scene with the numbers at u; empty where its laws cannot be.
  std::optional<Prepared> with(const VecX& u) const;
  /// Derivatives of outputs at a pose in the outputs' units, outputs by unknowns; empty where one does not exist.
  /// `sensitivity`: of the scene at u; one for all poses in turn remembers where layers touch, which saves most of the
  /// time.
  std::optional<MatX> derivatives(Sensitivity& sensitivity, const VecX& u, const PosePoint& point,
                                  const std::vector<Output>& outputs) const;
  /// The same with NaN where an output has none; empty where the pose has none.
  std::optional<MatX> rates(Sensitivity& sensitivity, const VecX& u, const PosePoint& point,
                            const std::vector<Output>& outputs) const;
  /// Takes a pose into account.
  void note_stretch(const Prepared& at_u, const State& state, CalibrationPrediction& out) const;
  std::vector<std::vector<CalibrationPrediction::Stretch>> no_stretch() const;

 private:
  Prepared base_;
  const std::vector<CalibrationUnknown>& unknowns_;
  std::vector<std::vector<std::optional<Parameter>>> own_;  ///< of each unknown's members
  bool none_ = true;
};

class CalibrationExperiment {
 public:
  struct Column {
    std::string name;  ///< with its unit
    double scale = 1;  ///< its residuals are divided by this: the stated error, or how much its values spread
    bool stated = false;
  };
  struct Value {
    std::size_t column = 0;
    double wanted = 0;
  };

  virtual ~CalibrationExperiment() = default;

  /// Calls from several threads are safe.
  virtual CalibrationPrediction predict(const VecX& u, bool derivatives) const = 0;
  /// Columns that say where a value was measured, and those of value k.
  virtual std::vector<std::string> place_columns() const = 0;
  virtual void set_place(std::size_t k, ResultTable& table) const = 0;
  /// Pictures of target and scene, each with a word for its file's name; `deviations` of the values may be empty.
  virtual std::vector<std::pair<std::string, Chart>> pictures(const VecX& values, const VecX& deviations) const = 0;
  /// What two values have in common that are one measurement with two ends: "30 deg, drawer".
  virtual std::string label(std::size_t k) const = 0;

  const std::vector<Column>& columns() const { return columns_; }
  const std::vector<Value>& values() const { return values_; }
  /// Sets the errors of columns that match "NAME=SIGMA" texts; a later one holds.
  void state_errors(const std::vector<std::pair<std::string, double>>& errors);
  VecX wanted() const;
  VecX scales() const;  ///< of each value

  std::string file;       ///< of the target
  bool held_out = false;  ///< not fitted: predicted

 protected:
  std::vector<Column> columns_;
  std::vector<Value> values_;
};

}  // namespace genu
