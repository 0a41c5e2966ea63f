// The laws that a scene can name, in the order in which messages list them. A new law is a file beside this one and a
// line in this one.
#pragma once

#include <string>
#include <vector>

#include "genu/law/law_kind.h"

namespace genu {

const LawKind& quadratic_law();
const LawKind& linear_law();
const LawKind& blankevoort_law();
const LawKind& spring_law();
const LawKind& table_law();
const LawKind& abdel_rahman_law();
const LawKind& exponential_law();

inline constexpr const LawKind& (*kLaws[])() = {quadratic_law, linear_law,       blankevoort_law, spring_law,
                                                table_law,     abdel_rahman_law, exponential_law};

/// nullptr where there is no law of this name.
const LawKind* find_law(const std::string& name);

/// The keys of the numbers of all laws, each once.
std::vector<std::string> law_keys();

}  // namespace genu
