// An XML file as a tree of elements, each with its place in the file.
//
// Read strictly: a file that is not well-formed is refused with line and column, and so is what an OpenSim file never
// has and an attack does: a document type (entities), elements nested without end, huge files.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/core/source_location.h"

namespace genu::osim {

struct XmlElement {
  std::string tag;
  std::string text;  ///< between its tags, without blanks at both ends
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlElement> children;
  SourceLocation where;

  /// The value of an attribute; empty where there is none.
  std::string attribute(std::string_view key) const;
  std::string name() const { return attribute("name"); }
  /// The first child of that tag, or null.
  const XmlElement* child(std::string_view wanted) const;
  /// The child `list`, then its child `objects`: how OpenSim writes sets. Null where either is missing.
  const XmlElement* objects_of(std::string_view list) const;
};

/// The root element. Empty, with an error in `out`, where the text is no XML that OpenSim could have written.
[[nodiscard]] std::optional<XmlElement> parse_xml(const std::string& text, const std::string& file, Diagnostics& out);

}  // namespace genu::osim
