#include "genu/results/calibration_table.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace genu {
namespace {

CalibrationReport report() {
  CalibrationReport r;
  r.parameters = {{"j1.stiffness", "Nm/deg", 0.8, 0.5535, 1e-4},
                  {"j1.damping", "Nm s/deg", 0.002, 0.001, std::numeric_limits<double>::infinity()}};
  r.correlation = MatX::Identity(2, 2);
  r.correlation(0, 1) = r.correlation(1, 0) = -0.995;
  r.undetermined = {"j1.damping"};
  r.columns = {{"j1.angle_deg", 201, 0.05, 20}};
  r.stop = "converged: for the test";
  r.iterations = 7;
  r.runs = 40;
  return r;
}

TEST(CalibrationTable, OneRowAParameter) {
  const ResultTable table = calibration_table(report());
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.to_csv().substr(0, table.to_csv().find('\n')),
            "parameter,unit,start,value,standard_error,correlation.j1.stiffness,correlation.j1.damping");
  EXPECT_EQ(std::get<std::string>(table.at(0, 0)), "j1.stiffness");
  EXPECT_EQ(table.number(0, "value"), 0.5535);
  EXPECT_EQ(table.number(0, "correlation.j1.damping"), -0.995);
  EXPECT_TRUE(std::isnan(table.number(1, "standard_error"))) << "an empty cell: it is not known";
}

TEST(CalibrationTable, TextSaysWhatIsNotDetermined) {
  const std::string text = to_text(report());
  for (const char* piece : {"0.5535", "undetermined", "converged: for the test; 7 iterations, 40 runs", "-0.9950",
                            "j1.angle_deg: rms 0.05 over 201 values", "j1.damping: the target does not depend on it"})
    EXPECT_NE(text.find(piece), std::string::npos) << piece << "\n" << text;
  CalibrationReport good = report();
  good.correlation(0, 1) = good.correlation(1, 0) = 0.5;
  EXPECT_EQ(to_text(good).find("correlated"), std::string::npos);
}

}  // namespace
}  // namespace genu
