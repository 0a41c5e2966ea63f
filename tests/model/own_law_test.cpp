// The README's example of a law of one's own: compiled here, and held to be the README's text.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <memory>

#include <gtest/gtest.h>

#include "genu/model/build_model.h"
#include "genu/model/ligament_pieces.h"
#include "support/places.h"
#include "support/scene_model.h"

namespace genu {
namespace {

std::string between(const std::string& file, const std::string& begin, const std::string& end) {
  std::ifstream in(genu::test::source_folder() + file);
  const std::string all{std::istreambuf_iterator<char>(in), {}};
  const auto from = all.find(begin);
  if (from == std::string::npos) return {};
  std::string out = all.substr(from + begin.size(), all.find(end, from + begin.size()) - from - begin.size());
  out.erase(std::remove_if(out.begin(), out.end(), [](unsigned char c) { return std::isspace(c) != 0; }), out.end());
  return out;
}

TEST(OwnLaw, OfTheReadmePullsAsItSays) {
  test::SceneModel s =
      test::scene_model(test::bone_on_ground("{ z = 10 }") + test::spring("s", "[0, 0, 0]", "[0, 0, -20]", 1, 20));
  JointModel& model = s.model;
  const int femur = 1, tibia = 0;
  const Vec3 p_femur = Vec3::Zero(), p_tibia(0, 0, -0.02);
  // The example begins.
  class PowerLaw final : public genu::ForceLaw {  // F = K e^n for e = L / L0 - 1 > 0: a toe region without an end
   public:
    genu::LawValue evaluate(double L) const override {
      const double e = L / L0 - 1;
      if (e <= 0) return {};
      const double F = K * std::pow(e, n);
      return {F, n * F / (e * L0), F * e * L0 / (n + 1)};  // N, N/m, J
    }
    std::vector<genu::LawBreak> breaks() const override { return {{L0, {0, 0, true}, {0, 0}}}; }
    std::optional<double> slack_length() const override { return L0; }
    const double L0 = 0.022, K = 8000, n = 2.5;
  };

  std::string why;
  const auto law = genu::LigamentLaw::custom(std::make_shared<PowerLaw>(), why);  // checks the breaks; empty: see why
  genu::add_ligament(model, {"own", genu::LigamentPath({{femur, p_femur}, {tibia, p_tibia}}), *law});  // m
  // The example ends.
  const LigamentShown shown = show_ligament(model, reference_state(model), 1);
  EXPECT_NEAR(shown.length, 0.03, 1e-16);
  EXPECT_NEAR(shown.strain, 8.0 / 22, 1e-14);
  EXPECT_NEAR(shown.force, 8000 * std::pow(8.0 / 22, 2.5), 1e-10);
}

TEST(OwnLaw, OfTheReadmeIsTheOneCompiledHere) {
  const std::string readme = between("/src/genu/model/README.md", "```cpp\n", "```");
  EXPECT_FALSE(readme.empty());
  EXPECT_EQ(readme, between("/tests/model/own_law_test.cpp", "// The example begins.\n", "// The example ends.\n"));
}

}  // namespace
}  // namespace genu
