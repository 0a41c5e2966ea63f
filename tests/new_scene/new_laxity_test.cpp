#include "genu/new_scene/new_laxity.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/assemble/with_numbers.h"
#include "genu/core/units.h"
#include "genu/study/laxity.h"
#include "support/bundled_knee.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

NewKneeLaxity usual_knee() {
  const double degree = 1 / to::kDegree;
  NewKneeLaxity knee{{3e-3, 7e-3}, {4 * degree, 8 * degree}, {20 * degree, 40 * degree}, 12, 32, {}};
  knee.values.push_back({3e-3, 2e-3, 10e-3, 0.5e-3, VecX::Zero(1)});
  return knee;
}

TEST(NewLaxity, IsUsualWhereAllIsWithinItsRange) {
  EXPECT_TRUE(usual_knee().usual());
  EXPECT_EQ(
      usual_knee().text(),
      "anterior 3.0 to 7.0 mm at 134 N, varus and valgus 4.0 to 8.0 deg at 10 N m, rotation 20 to 40 deg at 5 N m");
  NewKneeLaxity knee = usual_knee();
  EXPECT_TRUE(knee.usual(1.9));
  EXPECT_FALSE(knee.usual(2.1)) << "1 mm inside is two margins";
  knee.values.push_back({std::nan(""), 0, 1, 0.1, VecX::Zero(1)});
  EXPECT_FALSE(knee.usual());
}

TEST(NewLaxity, ACurveThatEndsIsSaid) {
  NewKneeLaxity ended = usual_knee();
  ended.complete = 11;
  EXPECT_FALSE(ended.usual());
  EXPECT_EQ(ended.missing_curves(), 1);
  EXPECT_NE(ended.text().find("; 11 of 12 curves complete; not all as of usual knees"), std::string::npos);
  ended.complete = 12, ended.cut_complete = 30;
  EXPECT_FALSE(ended.usual());
  EXPECT_NE(ended.text().find("; 30 of 32 with a ligament cut"), std::string::npos);
}

class NewLaxityOfAKnee : public testing::Test {
 protected:
  void SetUp() override {
    Diagnostics out;
    file_ = folder_.write("scene.toml", test::bundled_knee());
    prepared_ = prepare(file_, out);
    ASSERT_TRUE(prepared_) << test::messages(out);
    share_search(*prepared_);
  }

  /// All slack lengths of the ACL longer by a factor, and all stiffnesses of the MCL larger.
  std::vector<NumberRates> directions() const {
    std::vector<NumberRates> out(2);
    for (const Parameter& p : parameters_of(prepared_->source)) {
      const LigamentDef& ligament = prepared_->source.ligaments[static_cast<std::size_t>(std::max(0, p.object))];
      if (p.kind == Parameter::Kind::slack_length && p.name.starts_with("ACL"))
        out[0].emplace_back(p, ligament.rest_value);
      if (p.name.starts_with("MCL") && p.name.ends_with(".stiffness"))
        out[1].emplace_back(p, ligament.number("stiffness"));
    }
    return out;
  }

  NewKneeLaxity changed(const NumberRates& rates, double by) const {
    std::vector<NewNumber> numbers;
    for (const auto& [parameter, rate] : rates) numbers.emplace_back(parameter, rate * (1 + by));
    Diagnostics out;
    const auto other = with_numbers(*prepared_, numbers, out);
    return other ? laxity_of_new(*other, {}, {}) : NewKneeLaxity{};
  }

  test::TemporaryFolder folder_;
  std::string file_;
  std::optional<Prepared> prepared_;
};

TEST_F(NewLaxityOfAKnee, HasTheDerivativesOfFiniteDifferences) {
  const auto along = directions();
  const NewKneeLaxity found = laxity_of_new(*prepared_, along, {});
  ASSERT_EQ(found.values.size(), 28u);
  EXPECT_TRUE(found.all_complete());
  constexpr double kStep = 1e-5;
  for (std::size_t k = 0; k < along.size(); ++k) {
    ASSERT_FALSE(along[k].empty());
    const NewKneeLaxity up = changed(along[k], kStep), down = changed(along[k], -kStep);
    ASSERT_EQ(up.values.size(), 28u);
    double largest = 0;
    for (std::size_t v = 0; v < found.values.size(); ++v) {
      const double rate = (up.values[v].value - down.values[v].value) / (2 * kStep);
      largest = std::max(largest, std::abs(rate));
      EXPECT_NEAR(found.values[v].rates[static_cast<Eigen::Index>(k)], rate, 1e-3 * std::abs(rate) + 1e-5)
          << "value " << v << ", direction " << k;
    }
    EXPECT_GT(largest, 1e-3);
  }
}

/// What a cut ligament adds, by the command that leaves it out of the scene.
TEST_F(NewLaxityOfAKnee, CutsALigamentAsLeavingItOutDoes) {
  const NewKneeLaxity found = laxity_of_new(*prepared_, {}, {});
  LaxityChoice choice;
  for (const double angle : {0, 30, 60, 90}) choice.flexions.push_back(angle / to::kDegree);
  choice.tests = {{LaxityTest::Kind::drawer, 134}};
  choice.increments = 3;
  Diagnostics out;
  LaxityResult result;
  static_cast<void>(run_laxity({file_, {{"PCL*"}, {}}}, {}, choice, out, result));
  ASSERT_EQ(result.scenes.size(), 2u) << test::messages(out);
  double sum = 0;
  for (std::size_t a = 0; a < 4; ++a) {
    double moved[2];
    for (std::size_t s = 0; s < 2; ++s) {
      const LaxityCurve& curve = result.scenes[s].angles[a].curves.front();
      ASSERT_NE(curve.at(-134), nullptr);
      moved[s] = curve.test.displacement(curve.at(-134)->motion) - curve.test.displacement(curve.rows.front().motion);
    }
    sum += (moved[0] - moved[1]) / 4;
  }
  EXPECT_NEAR(found.values[16].value, sum, 1e-8);
  EXPECT_GT(sum, 0.5e-3);
}

}  // namespace
}  // namespace genu
