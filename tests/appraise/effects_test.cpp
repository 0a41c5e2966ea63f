// A scene pays for the effects that it names, and for no other: counted.
#include "genu/appraise/effects.h"

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "genu/study/run_motion.h"
#include "genu/study/run_scene.h"
#include "support/data.h"
#include "support/judged.h"
#include "support/places.h"

namespace genu {
namespace {

constexpr Effect kEvery[] = {Effect::prescribed, Effect::held,    Effect::joint_springs,  Effect::ligaments,
                             Effect::loads,      Effect::weights, Effect::rigid_contacts, Effect::contact_search,
                             Effect::layers,     Effect::inertia, Effect::damping,        Effect::bushings};
static_assert(std::size(kEvery) == kEffects);

struct Counted {
  std::set<Effect> evaluated;
  RunSummary summary;
};

Counted count(const std::string& file) {
  SCOPED_TRACE(file);
  Diagnostics out;
  const auto prepared = prepare(file, out);
  EXPECT_TRUE(prepared.has_value());
  if (!prepared) return {};
  Counted counted;
  if (prepared->scene.dynamics) {
    counted.summary = solve_motion(*prepared, {}).summary;
  } else {
    ContactField field(prepared->model);
    counted.summary = test::judged(*prepared, solve(*prepared, field, {})).summary;
  }
  EXPECT_EQ(counted.summary.exit_code, kExitOk);
  for (const Effect effect : kEvery) {
    if (prepared->model.meter->evaluations(effect) > 0) counted.evaluated.insert(effect);
    EXPECT_EQ(prepared->model.meter->evaluations(effect) > 0, prepared->model.meter->seconds(effect) > 0);
  }
  return counted;
}

const std::string kMeshes = genu::test::source_folder() + "/meshes/";

TEST(Effects, TheDortmansKneeEvaluatesNothingItDoesNotName) {
  const Counted knee = count(kMeshes + "dortmans1984/scene.toml");
  const std::set<Effect> named{Effect::prescribed, Effect::ligaments, Effect::rigid_contacts, Effect::contact_search};
  EXPECT_EQ(knee.evaluated, named);
  // Two contacts, seven ligaments, one coordinate: each linearization evaluates all of them.
  std::map<std::string, std::int64_t> evaluations;
  for (const auto& e : knee.summary.effects)
    if (e.evaluations) evaluations[e.name] = *e.evaluations / e.count;
  EXPECT_GE(evaluations["ligaments"], knee.summary.iterations);
  EXPECT_EQ(evaluations["ligaments"], evaluations["prescribed coordinates"]);
  EXPECT_GT(evaluations["search for contacts"], 0);
}

TEST(Effects, TheThreeBoneKneeEvaluatesNothingItDoesNotName) {
  const Counted knee = count(kMeshes + "leskovar2019/scene.toml");
  const std::set<Effect> named{Effect::held,  Effect::joint_springs, Effect::ligaments,
                               Effect::loads, Effect::inertia,       Effect::damping};
  EXPECT_EQ(knee.evaluated, named);
}

TEST(Effects, EachIsCountedWhereItIsNamed) {
  std::set<Effect> seen;
  for (const char* file : {"dortmans1984/scene.toml", "dortmans1984/scene-moment.toml", "leskovar2019/scene.toml",
                           "leskovar2019/scene-without-joints.toml"})
    seen.merge(count(kMeshes + file).evaluated);
  EXPECT_FALSE(seen.contains(Effect::bushings));
  seen.merge(count(test::source_folder() + "/tests/appraise/bushing.toml").evaluated);
  EXPECT_EQ(seen.size() + 1, kEffects) << "all but layers";
  EXPECT_FALSE(seen.contains(Effect::layers));
}

TEST(Effects, AKneeOnLayersHasNoRigidContact) {
  GENU_NEEDS_DATA("../scenes/lenhart_cartilage.toml");
  const Counted knee = count(test::data_path("../scenes/lenhart_cartilage.toml"));
  EXPECT_TRUE(knee.evaluated.contains(Effect::layers));
  EXPECT_FALSE(knee.evaluated.contains(Effect::rigid_contacts));
  EXPECT_FALSE(knee.evaluated.contains(Effect::contact_search));
  EXPECT_FALSE(knee.evaluated.contains(Effect::inertia));
}

}  // namespace
}  // namespace genu
