// The tables of numbers of surfaces, loads, joints and bodies: complete, and each number is documented and fuzzed.
#include <fstream>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "genu/law/laws.h"
#include "genu/scene/scene.h"
#include "support/places.h"

namespace genu {
namespace {

/// Calls f(kind, def) for each kind of object, with an object of that kind.
template <class F>
void for_kinds(const F& f) {
  for (int shape = 0; shape < static_cast<int>(std::size(kSurfaceKinds)); ++shape) {
    SurfaceDef def;
    def.shape = static_cast<SurfaceDef::Shape>(shape);
    f(kSurfaceKinds[shape], def);
  }
  for (int type = 0; type < static_cast<int>(std::size(kJointKinds)); ++type) {
    JointDef def;
    def.type = static_cast<JointDef::Type>(type);
    def.limits = JointDef::Limits{};
    f(kJointKinds[type], def);
  }
  for (int kind = 0; kind < static_cast<int>(std::size(kLoadKinds)); ++kind) {
    LoadDef def;
    def.kind = static_cast<LoadDef::Kind>(kind < 3 ? kind : kind - 1);  // of a load on a coordinate there are two
    def.coordinate.index = kind == 3 ? 3 : 0;
    f(kLoadKinds[kind], def);
  }
  f(kBodyKinds[0], BodyDef());
}

std::string text_of(const std::string& path) {
  std::ifstream in(test::source_folder() + "/" + path);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

TEST(NumberTables, BelongToTheKindOfTheObject) {
  for_kinds([](const auto& kind, const auto& def) { EXPECT_EQ(&kind_of(def), &kind) << kind.what; });
}

TEST(NumberTables, HavePlacesOfTheirOwnInTheObject) {
  for_kinds([](const auto& kind, auto def) {
    std::set<const double*> places;
    std::set<std::string> keys, names;
    for (const auto& number : kind.numbers) {
      const NumberRow& row = number.row;
      EXPECT_TRUE(row.size == 1 || row.size == 3) << row.key;
      EXPECT_TRUE(keys.insert(std::string(row.table ? row.table : "") + "." + row.key).second) << row.key;
      EXPECT_TRUE(names.insert(row.parameter()).second) << row.parameter();
      EXPECT_EQ(row.with == nullptr, row.reason == nullptr) << row.key;
      for (int i = 0; i < row.size; ++i)
        EXPECT_TRUE(places.insert(number.values(def) + i).second) << kind.what << " " << row.key;
    }
  });
}

/// A point that a scene may give is moved with the origin of its body (centre_bodies.h).
TEST(NumberTables, HaveAFrameForEachPoint) {
  for_kinds([](const auto&, const auto& def) {
    for (const auto& number : kind_of(def).numbers)
      if (number.row.unit == Unit::length && number.row.range == NumberRow::Range::any) {
        EXPECT_NE(number.frame, nullptr) << number.row.key;
      }
  });
}

TEST(NumberTables, AreDocumentedAndFuzzed) {
  const std::string reference = text_of("docs/scene-reference.md"), words = text_of("tests/fuzz/toml.dict");
  const auto expect = [&](const std::string& key) {
    const auto has = [&](const std::string& text) { return reference.find(text) != std::string::npos; };
    EXPECT_TRUE(has("`" + key) || has(key + " =")) << key;
    EXPECT_NE(words.find("\"" + key + "\""), std::string::npos) << key;
  };
  for_kinds([&](const auto& kind, const auto&) {
    for (const auto& number : kind.numbers) expect(number.row.key);
  });
  for (const auto& law : kLaws) {
    EXPECT_NE(words.find("\"" + law().name + "\""), std::string::npos) << law().name;
    for (const NumberRow& row : law().numbers) expect(row.key);
  }
}

}  // namespace
}  // namespace genu
