// A compartment of a joint, [compartment.NAME]: contacts that carry a load side by side, directly or through a
// meniscus.
#pragma once

#include <string>
#include <vector>

#include "genu/core/source_location.h"

namespace genu {

struct CompartmentDef {
  std::string name;
  std::vector<std::string> direct;    ///< contacts, or regions of contacts: "tibiofemoral.medial"
  std::vector<std::string> meniscal;  ///< those of the menisci with one of the two bones
  SourceLocation where;
};

}  // namespace genu
