// The small model of these tests, and copies of it with something changed.
#pragma once

#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "genu/osim/read_model.h"
#include "support/places.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu::test {

inline std::string leg_path() { return source_folder() + "/tests/osim/model/leg.osim"; }
inline std::string leg_text() { return read_file(leg_path()); }

/// The text with the first `from` after `after` replaced.
inline std::string leg_with(const std::string& from, const std::string& to, const std::string& after = "") {
  std::string text = leg_text();
  const std::size_t start = text.find(after), at = text.find(from, start);
  EXPECT_NE(start, std::string::npos) << after;
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// The model of a text that has no errors.
inline osim::Model model_of(const std::string& text) {
  Diagnostics out;
  auto model = osim::parse_model(text, "leg.osim", out);
  EXPECT_FALSE(out.has_errors()) << to_string(out.items().front());
  return model.value_or(osim::Model());
}

/// A coupler: dependent = 0.5 + independent.
inline std::string leg_coupler(const std::string& independent, const std::string& dependent) {
  return "<CoordinateCouplerConstraint name=\"" + dependent +
         "_follows\"><coupled_coordinates_function><LinearFunction><coefficients>1 0.5</coefficients></LinearFunction>"
         "</coupled_coordinates_function><independent_coordinate_names>" +
         independent + "</independent_coordinate_names><dependent_coordinate_name>" + dependent +
         "</dependent_coordinate_name></CoordinateCouplerConstraint>";
}

inline osim::Model leg() { return model_of(leg_text()); }

/// The first message about a text that is refused; empty, with a failure, where it is not.
inline std::string refusal_of(const std::string& text) {
  Diagnostics out;
  const auto model = osim::parse_model(text, "leg.osim", out);
  EXPECT_FALSE(model.has_value());
  EXPECT_TRUE(out.has_errors());
  return out.items().empty() ? std::string() : to_string(out.items().front());
}

/// The line of a text, from 1, where `part` begins first.
inline int line_of(const std::string& text, const std::string& part) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  int line = 1;
  for (std::size_t k = 0; k < std::min(at, text.size()); ++k) line += text[k] == '\n';
  return line;
}

}  // namespace genu::test
