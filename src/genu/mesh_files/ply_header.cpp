#include "genu/mesh_files/ply_header.h"

#include <array>
#include <optional>

#include "genu/mesh_files/mesh_formats.h"
#include "genu/mesh_files/text_words.h"
#include "genu/mesh_files/tolerances.h"

namespace genu {
namespace {

std::optional<PlyType> type_of(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, PlyType>, 16> kNames{{{"char", PlyType::int8},
                                                                         {"int8", PlyType::int8},
                                                                         {"uchar", PlyType::uint8},
                                                                         {"uint8", PlyType::uint8},
                                                                         {"short", PlyType::int16},
                                                                         {"int16", PlyType::int16},
                                                                         {"ushort", PlyType::uint16},
                                                                         {"uint16", PlyType::uint16},
                                                                         {"int", PlyType::int32},
                                                                         {"int32", PlyType::int32},
                                                                         {"uint", PlyType::uint32},
                                                                         {"uint32", PlyType::uint32},
                                                                         {"float", PlyType::float32},
                                                                         {"float32", PlyType::float32},
                                                                         {"double", PlyType::float64},
                                                                         {"float64", PlyType::float64}}};
  for (const auto& [name, type] : kNames)
    if (name == word) return type;
  return std::nullopt;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view text, PlyHeader& header) : text_(text), words_(text), header_(header) {}

  std::string read() {
    if (words_.next() != "ply") return "does not start with \"ply\": it is damaged or no PLY at all; export it again";
    bool format = false;
    for (std::string_view word = words_.next(); word != "end_header"; word = words_.next()) {
      if (word.empty()) return "has a PLY header without \"end_header\": it is truncated; copy or export it again";
      if (word == "format")
        read_format(), format = true;
      else if (word == "element")
        read_element();
      else if (word == "property")
        read_property();
      else if (word != "comment" && word != "obj_info")
        found(word, "\"format\", \"element\", \"property\" or \"end_header\"");
      if (!problem_.empty()) return problem_;
      words_.skip_line();
    }
    if (!format) return "has a PLY header without \"format\": it is damaged; export it again";
    return end();
  }

 private:
  void found(std::string_view word, const std::string& wanted) {
    if (!problem_.empty()) return;
    problem_ = "has " + (word.empty() ? "nothing" : in_quotes(word)) + " in line " + std::to_string(words_.line()) +
               " where " + wanted + " should stand: it is damaged; export it again";
  }

  void read_format() {
    const std::string_view word = words_.next_in_line();
    header_.ascii = word == "ascii";
    header_.big_endian = word == "binary_big_endian";
    if (!header_.ascii && !header_.big_endian && word != "binary_little_endian")
      found(word, "\"ascii\", \"binary_little_endian\" or \"binary_big_endian\"");
  }

  void read_element() {
    PlyElement element;
    element.name = words_.next_in_line();
    const std::string_view count = words_.next_in_line();
    if (!TextWords::number(count, element.count) || element.count > kMaxMeshCount)
      found(count, "a count from 0 to " + std::to_string(kMaxMeshCount));
    header_.elements.push_back(std::move(element));
  }

  PlyType read_type() {
    const std::string_view word = words_.next_in_line();
    const auto type = type_of(word);
    if (!type) found(word, "a type such as \"float\"");
    return type.value_or(PlyType::float32);
  }

  void read_property() {
    PlyProperty property;
    TextWords ahead = words_;
    if (ahead.next_in_line() == "list") {
      words_.next_in_line();
      property.list = true;
      property.count_type = read_type();
      if (property.count_type == PlyType::float32 || property.count_type == PlyType::float64)
        found("list", "a list whose length is a whole number");
    }
    property.type = read_type();
    property.name = words_.next_in_line();
    if (property.name.empty()) found("", "the property's name");
    if (header_.elements.empty()) return found("property", "an element");
    header_.elements.back().properties.push_back(std::move(property));
  }

  /// The body starts right after the line of "end_header".
  std::string end() {
    words_.skip_line();
    std::size_t at = text_.size() - words_.rest().size();
    const bool carriage = at < text_.size() && text_[at] == '\r';
    if (carriage) ++at;
    if (at < text_.size() && text_[at] == '\n') ++at;
    header_.size = at;
    header_.lines = words_.line();
    for (const PlyElement& e : header_.elements)
      if (e.properties.empty() && e.count > 0)
        return "has an element " + in_quotes(e.name) + " without properties: it is damaged; export it again";
    return {};
  }

  std::string_view text_;
  TextWords words_;
  PlyHeader& header_;
  std::string problem_;
};

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::float64:
      return 8;
    default:
      return 4;
  }
}

int PlyElement::index(std::string_view property) const {
  for (std::size_t k = 0; k < properties.size(); ++k)
    if (properties[k].name == property) return static_cast<int>(k);
  return -1;
}

std::string read_ply_header(std::string_view text, PlyHeader& header) { return HeaderReader(text, header).read(); }

}  // namespace genu
