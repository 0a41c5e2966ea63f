// What a laxity test is asked for, and what it finds.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "genu/assemble/solution.h"
#include "genu/study/laxity_loads.h"

namespace genu {

struct LaxityChoice {
  std::vector<double> flexions;   ///< rad, positive where the knee bends, of the joint's first rotation
  std::vector<LaxityTest> tests;  ///< at most one of each kind
  double compression = 0;         ///< N, in all poses
  int increments = 10;            ///< from 0 to the full load
  bool back = true;               ///< false: from the neutral pose to each full load alone
  bool envelope = false;          ///< the full loads are held while the knee bends as well
  Cancelled cancelled;
};

/// A pose on a curve.
struct LaxityRow {
  double load = 0;  ///< N or N m
  PoseRecord record;
  KneeMotion motion;
  /// m/N or rad/(N m): exact derivative of the test's displacement to its load, one-sided where a contact or ligament
  /// changes at the pose; NaN where there is none.
  double compliance = std::numeric_limits<double>::quiet_NaN();
};

struct LaxityCurve {
  LaxityTest test;
  std::vector<LaxityRow> rows;     ///< solved, on the branch of the neutral pose; first the neutral pose
  std::vector<std::string> ended;  ///< one sentence for each leg that ends before its full load

  /// The first pose at a load; null where the curve ends before it.
  const LaxityRow* at(double load) const;
  /// m or rad: largest difference between two poses at one load, forth and back; NaN for a curve that
  /// ends before it comes back.
  double loop() const;
};

struct LaxityAngle {
  double flexion = 0;  ///< rad
  LaxityRow neutral;
  bool solved = false;             ///< the neutral pose
  std::vector<std::string> notes;  ///< why not, or what happened on the way to it
  std::vector<LaxityCurve> curves;
  std::vector<StepPlan> steps;  ///< that were solved: those of the neutral pose, then of each curve
};

/// A load that is held while the knee bends.
struct EnvelopePath {
  struct Row {
    double flexion = 0;  ///< rad
    LaxityRow pose;
  };
  LaxityTest test;        ///< of the load that is held; nothing where that is 0
  double held = 0;        ///< N or N m; 0: the path without load
  std::vector<Row> rows;  ///< solved, on the branch of the first pose; flexion grows
  std::string ended;      ///< where and why it ends before the largest flexion
  std::vector<StepPlan> steps;

  const LaxityRow* at(double flexion) const;
};

struct LaxityOfScene {
  std::string name;  ///< "as written", "without ACL*"
  LaxityJoint knee;  ///< its steps are those of the test, angle by angle; each pose has the number of its own
  std::vector<LaxityAngle> angles;
  std::vector<EnvelopePath> envelope = {};  ///< first the path without load; empty where it was not asked for
};

struct LaxityResult {
  std::vector<LaxityOfScene> scenes;  ///< as written, then as changed
  std::string title, text;            ///< text: the tables that are printed
  std::vector<std::string> verdict;
  std::string folder;
};

}  // namespace genu
