#include "genu/scene/read_numbers.h"

#include "genu/core/units.h"
#include "scene/scene_text.h"

namespace genu::scene_test {
namespace {

struct Thing {
  double size = 5, least = 7;
  Vec3 place = Vec3::Ones();
};
constexpr NumberOf<Thing> kThingNumbers[] = {
    {.row = {.key = "size", .unit = Unit::length}, .values = [](Thing& t) { return &t.size; }},
    {.row = {.key = "least", .unit = Unit::angle, .presence = NumberRow::Presence::optional, .otherwise = 3},
     .values = [](Thing& t) { return &t.least; },
     .fault = [](const Thing& t) -> const char* { return t.least < 1 ? nullptr : "must be < 1 rad"; }},
    {.row = {.key = "place",
             .unit = Unit::force_per_length,
             .range = NumberRow::Range::any,
             .presence = NumberRow::Presence::optional,
             .size = 3,
             .with = "least",
             .reason = "needs `least`",
             .in_motion = true},
     .values = [](Thing& t) { return t.place.data(); }}};
constexpr KindOf<Thing> kThing{"thing", "a thing", kThingNumbers};

struct Read {
  Thing thing;
  std::vector<std::string> messages;
};

Read read(const std::string& text, const NumbersOf& how = {}, bool in_motion = true) {
  Read out;
  Diagnostics diagnostics;
  Scene scene;
  scene.length_unit = units::kMillimetre;
  scene.angle_unit = units::kDegree;
  ReadContext context("", diagnostics, scene);
  context.in_motion = in_motion;
  const auto document = parse_toml("[t]\n" + text, "", diagnostics);
  Section section(context, Item{document->member("t"), "t"}, "a thing");
  read_numbers(context, section, kThing, out.thing, how);
  section.finish();
  for (const Diagnostic& d : diagnostics.items()) out.messages.push_back(d.key + ": " + d.rule);
  return out;
}

using Messages = std::vector<std::string>;

TEST(ReadNumbers, InSiUnitsByTheirRows) {
  const Read all = read("size = 20\nleast = 30\nplace = [1, 2, -3]\n");
  EXPECT_EQ(all.messages, Messages{});
  EXPECT_DOUBLE_EQ(all.thing.size, 0.02);
  EXPECT_DOUBLE_EQ(all.thing.least, 30 * units::kDegree);
  EXPECT_EQ(all.thing.place, Vec3(1e3, 2e3, -3e3));
  const Read few = read("size = 20\n");
  EXPECT_EQ(few.messages, Messages{});
  EXPECT_EQ(few.thing.least, 3) << "as the row has it, not as the object does";
  EXPECT_EQ(few.thing.place, Vec3::Zero());
}

TEST(ReadNumbers, RefusesWhatARowDoesNotAllow) {
  EXPECT_EQ(read("").messages, Messages{"t.size: is missing: a thing needs it"});
  EXPECT_EQ(read("", {.none_required = true}).messages, Messages{});
  EXPECT_EQ(read("size = 0").messages, Messages{"t.size: must be > 0 mm"});
  EXPECT_EQ(read("size = 1\nleast = 60").messages, Messages{"t.least: must be < 1 rad"});
  EXPECT_EQ(read("size = 0\nleast = 60").messages, Messages{"t.size: must be > 0 mm"}) << "one thing after the other";
  EXPECT_EQ(read("size = 1\nleast = 1\nplace = 4").messages,
            Messages{"t.place: must be three numbers [x, y, z], in N/mm"});
  EXPECT_EQ(read("size = 1\nplace = [1, 1, 1]").messages, Messages{"t.place: needs `least`"});
  EXPECT_EQ(read("size = 1\nplac = 1").messages,
            Messages{"t.plac: is no key of a thing; did you mean \"place\"? (its keys: size, least, place)"});
  EXPECT_EQ(read("size = 1\nleast = 1\nplace = [1, 1, 1]", {.objects = "things"}, false).messages,
            Messages{"t.place: place of things has an effect only in a scene with [dynamics]"});
}

TEST(ReadNumbers, KnowsTheKeysOfAKind) {
  Diagnostics diagnostics;
  Scene scene;
  ReadContext context("", diagnostics, scene);
  const auto document = parse_toml("size = 1\nplace = 3\nmore = 1\n", "", diagnostics);
  Section section(context, Item{&*document, ""}, "a thing");
  const auto given = given_numbers(section, kThing);
  ASSERT_EQ(given.size(), 2u);
  EXPECT_EQ(given[1].path, "place");
  know_numbers(section, kThing);
  section.finish();
  ASSERT_EQ(diagnostics.items().size(), 1u);
  EXPECT_EQ(diagnostics.items()[0].key, "more");
}

}  // namespace
}  // namespace genu::scene_test
