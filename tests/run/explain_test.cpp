// The counts of the system, against those of the papers.
#include "genu/run/explain.h"

#include <functional>

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "run/scenes.h"

namespace genu {
namespace {

std::string explained(const std::function<void(Scene&)>& change = [](Scene&) {}) {
  Diagnostics out;
  auto scene = read_scene(test::dortmans_file(), out);
  EXPECT_TRUE(scene.has_value()) << test::messages(out);
  if (!scene) return {};
  change(*scene);
  return explain(*scene);
}

void expect_said(const std::string& text, const std::string& piece) {
  EXPECT_NE(text.find(piece), std::string::npos) << "\"" << piece << "\" is not in\n" << text;
}

TEST(Explain, TheTorusKneeIsSeventeenEquations) {
  const std::string text = explained();
  expect_said(text, "7 + 5 N in all (6B + M + 5N: B = 1, M = 1); room for N <= 4; N = 2: 17 x 17");
  expect_said(text, "reaction of knee.flexion (moment)");
  expect_said(text, "angles flexion about x");
  expect_said(text, "off           loads");
}

TEST(Explain, WithoutContactTheSystemIsTheBodysAndTheConstraints) {
  const std::string text = explained([](Scene& s) {
    s.contacts.clear();
    s.steps[0].prescribe.push_back({{0, 3}, 0, 1e-3});
  });
  expect_said(text, "   8  in all");
  expect_said(text, "knee.x from 0 to 1 mm");
  expect_said(text, "off           rigid contact");
}

}  // namespace
}  // namespace genu
