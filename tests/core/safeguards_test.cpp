// Each safeguard has a name of its own, and switching one off leaves the others.
#include "genu/core/safeguards.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace genu {
namespace {

TEST(Safeguards, HaveNamesAndWordsOfTheirOwn) {
  std::set<std::string> names, words;
  for (const Safeguard s : all_safeguards()) {
    names.insert(to_string(s));
    words.insert(describe(s));
    EXPECT_EQ(safeguard_named(to_string(s)), s);
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(Safeguard::count));
  EXPECT_EQ(words.size(), names.size());
  EXPECT_FALSE(safeguard_named("no such thing"));
}

TEST(Safeguards, AreSwitchedOffOneByOne) {
  EXPECT_TRUE(Safeguards().has(Safeguard::merging));
  for (const Safeguard off : all_safeguards()) {
    const Safeguards rest = Safeguards::without(off);
    for (const Safeguard s : all_safeguards()) EXPECT_EQ(rest.has(s), s != off) << to_string(s);
  }
}

}  // namespace
}  // namespace genu
