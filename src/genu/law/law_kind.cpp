#include "genu/law/law_kind.h"

namespace genu {

std::optional<double> slack_length_at(std::optional<double> e, double length) {
  if (!e || *e <= -1) return std::nullopt;
  return length / (1 + *e);
}

}  // namespace genu
