// A search from a cold start that ends with surfaces deep in each other, though at the start they are apart and nothing
// of one lies opposite the other: in truth contact runs over an edge there.
#pragma once

#include <string>

#include "genu/model/contact_field.h"

namespace genu {

/// In words, of the first pair where that is so at `start`; else empty.
std::string contact_past_edge(const JointModel& model, ContactField& field, const State& start);

}  // namespace genu
