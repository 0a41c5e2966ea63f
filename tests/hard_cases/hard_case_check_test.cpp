// A result that differs from what is expected in any one way is a miss, and the same result without it is none.
#include "hard_cases/hard_case_check.h"

#include <string>

#include <gtest/gtest.h>

namespace genu {
namespace {

CaseResult solved_twice() {
  CaseResult r;
  r.solution.summary.verdict = {"Every pose is solved."};
  for (const char* column : {"status", "x", "y"}) r.solution.poses.add_column(column);
  for (const double x : {1.0, 2.0}) {
    r.solution.poses.add_row();
    r.solution.poses.set("status", std::string("ok"));
    r.solution.poses.set("x", x);
    r.solution.poses.set("y", x * x);
  }
  r.solution.event_rows.add_column("event");
  r.solution.event_rows.add_column("t");
  r.solution.event_rows.add_row();
  r.solution.event_rows.set("event", std::string("taut"));
  r.solution.event_rows.set("t", 0.25);
  return r;
}

ExpectedValue number(const std::string& column, const std::string& value, std::optional<int> row = {}) {
  ExpectedValue v;
  v.column = column;
  v.value = value;
  v.row = row;
  v.tolerance = 1e-9;
  return v;
}

std::size_t count(const Expectation& e) { return misses(e, solved_twice()).size(); }

TEST(HardCaseCheck, WhatIsAsExpectedIsNoMiss) {
  Expectation e;
  e.statuses = {{"ok", 2}};
  e.events = {{"taut", 1}, {"slack", 0}};
  e.says = {"Every pose"};
  e.says_not = {"overlap"};
  e.values = {number("y", "[x]^2"), number("x", "2", -1), number("x", "1", 1)};
  ExpectedValue t = number("t", "1 / 4", 1);
  t.table = ExpectedValue::Table::events;
  t.event = "taut";
  e.values.push_back(t);
  EXPECT_EQ(count(e), 0u);
}

TEST(HardCaseCheck, EachDifferenceIsAMiss) {
  const auto one = [](auto change) {
    Expectation e;
    change(e);
    return count(e);
  };
  EXPECT_EQ(one([](Expectation& e) { e.exit_code = 2; }), 1u);
  EXPECT_EQ(one([](Expectation& e) { e.statuses = {{"ok", 1}}; }), 1u);
  EXPECT_EQ(one([](Expectation& e) { e.statuses = {{"overlap", 0}}; }), 1u) << "two rows are something else";
  EXPECT_EQ(one([](Expectation& e) { e.events = {{"taut", 2}}; }), 1u);
  EXPECT_EQ(one([](Expectation& e) { e.says = {"snap"}; }), 1u);
  EXPECT_EQ(one([](Expectation& e) { e.most_iterations = -1; }), 1u);
  EXPECT_EQ(one([](Expectation& e) { e.says_not = {"solved"}; }), 1u);
  EXPECT_EQ(one([](Expectation& e) { e.values = {number("y", "[x]")}; }), 1u);
  EXPECT_EQ(one([](Expectation& e) { e.values = {number("z", "1")}; }), 1u) << "no such column";
  EXPECT_EQ(one([](Expectation& e) { e.values = {number("x", "1", 3)}; }), 1u) << "no such row";
  EXPECT_EQ(one([](Expectation& e) { e.values = {number("x", "[z]", 1)}; }), 1u) << "no such name";
  EXPECT_EQ(one([](Expectation& e) {
              e.values = {number("status", "overlap", 1)};
              e.values[0].is_word = true;
            }),
            1u);
}

}  // namespace
}  // namespace genu
