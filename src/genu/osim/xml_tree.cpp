#include "genu/osim/xml_tree.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "genu/osim/tolerances.h"
#include "genu/scene/utf8.h"

namespace genu::osim {
namespace {

constexpr const char* kCure = "correct it there, or open the model in OpenSim and save it again";

std::string trimmed_text(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t from = text.find_first_not_of(kBlanks);
  if (from == std::string_view::npos) return {};
  return std::string(text.substr(from, text.find_last_not_of(kBlanks) - from + 1));
}

/// Where a byte of the text is, by line and column.
class Places {
 public:
  explicit Places(std::string_view text) {
    for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1))
      ends_.push_back(at);
  }
  SourceLocation of(std::size_t byte) const {
    const auto line = std::lower_bound(ends_.begin(), ends_.end(), byte) - ends_.begin();
    const std::size_t begin = line == 0 ? 0 : ends_[static_cast<std::size_t>(line - 1)] + 1;
    return {static_cast<int>(line) + 1, static_cast<int>(byte - begin) + 1};
  }

 private:
  std::vector<std::size_t> ends_;
};

/// The end of what begins at `at` with `open` and ends with `close`: past it, or 0 where something else begins there.
std::size_t past(std::string_view text, std::size_t at, std::string_view open, std::string_view close) {
  if (text.substr(at, open.size()) != open) return 0;
  const std::size_t end = text.find(close, at + open.size());
  return end == std::string_view::npos ? text.size() : end + close.size();
}

/// The first & that begins no reference of XML: pugixml lets it pass, XML does not. npos where there is none.
std::size_t bare_ampersand(std::string_view text) {
  for (std::size_t at = text.find_first_of("<&"); at != std::string_view::npos; at = text.find_first_of("<&", at)) {
    std::size_t end = std::max(past(text, at, "<!--", "-->"), past(text, at, "<![CDATA[", "]]>"));
    if (text[at] == '&') {
      const std::string_view rest = text.substr(at + 1, 12);
      const std::string_view word = rest.substr(0, rest.find(';'));
      constexpr std::array<std::string_view, 5> kKnown = {"amp", "lt", "gt", "quot", "apos"};
      const bool known = std::find(kKnown.begin(), kKnown.end(), word) != kKnown.end();
      const bool number = word.size() > 1 && word[0] == '#';
      if (word.size() == rest.size() || !(known || number)) return at;
    }
    at = std::max(end, at + 1);
  }
  return std::string_view::npos;
}

/// Copies the tree of pugixml, which must not be trusted to be shallow.
class TreeBuilder {
 public:
  TreeBuilder(const std::string& file, const Places& places, Diagnostics& out)
      : file_(file), places_(places), out_(out) {}

  bool build(const pugi::xml_node& node, int depth, XmlElement& element) {
    element.tag = node.name();
    // offset_debug() is where the tag's name begins, behind its <.
    element.where = places_.of(static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug() - 1, 0)));
    if (depth > kMaxDepth)
      return refuse(element, Code::too_large, fmt::format("is nested more than {} elements deep", kMaxDepth));
    if (!copy_attributes(node, element)) return false;
    std::string text;
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) text += child.value();
      if (child.type() != pugi::node_element) continue;
      element.children.emplace_back();
      if (!build(child, depth + 1, element.children.back())) return false;
    }
    element.text = trimmed_text(text);
    return true;
  }

 private:
  bool copy_attributes(const pugi::xml_node& node, XmlElement& element) {
    for (const pugi::xml_attribute& a : node.attributes()) {
      for (const auto& [key, value] : element.attributes)
        if (key == a.name())
          return refuse(element, Code::duplicate, fmt::format("has the attribute \"{}\" twice; {}", key, kCure));
      element.attributes.emplace_back(a.name(), a.value());
    }
    return true;
  }

  bool refuse(const XmlElement& element, Code code, const std::string& rule) {
    out_.add(error_at({file_, element.where}, code, element.tag, {}, rule));
    return false;
  }

  const std::string& file_;
  const Places& places_;
  Diagnostics& out_;
};

}  // namespace

std::string XmlElement::attribute(std::string_view key) const {
  for (const auto& [name, value] : attributes)
    if (name == key) return value;
  return {};
}

const XmlElement* XmlElement::child(std::string_view wanted) const {
  for (const XmlElement& c : children)
    if (c.tag == wanted) return &c;
  return nullptr;
}

const XmlElement* XmlElement::objects_of(std::string_view list) const {
  const XmlElement* set = child(list);
  return set == nullptr ? nullptr : set->child("objects");
}

std::optional<XmlElement> parse_xml(const std::string& bytes, const std::string& file, Diagnostics& out) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  const std::string_view text =
      std::string_view(bytes).substr(bytes.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
  const Places places(text);
  const auto refuse = [&](Code code, const SourceLocation& where, const std::string& rule) {
    out.add(error_at({file, where}, code, {}, {}, rule));
    return std::nullopt;
  };
  if (const auto bad = first_invalid_utf8(text)) return refuse(Code::not_utf8, *bad, "is no UTF-8 text");
  pugi::xml_document document;
  const pugi::xml_parse_result parsed =
      document.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_doctype, pugi::encoding_utf8);
  const auto wrong = [&](std::size_t byte, const std::string& what) {
    return refuse(Code::broken_file, places.of(byte), fmt::format("is no well-formed XML: {}; {}", what, kCure));
  };
  for (const pugi::xml_node& node : document.children())
    if (node.type() == pugi::node_doctype)
      return refuse(Code::broken_file, places.of(text.find("<!DOCTYPE")),
                    "has a document type, which OpenSim's files never have and which may define entities: take it out");
  if (const std::size_t at = bare_ampersand(text);
      at < text.size() && (parsed || at < static_cast<std::size_t>(parsed.offset)))
    return wrong(at, "a & that begins no &amp; &lt; &gt; &quot; &apos; or &#...;");
  if (!parsed) return wrong(static_cast<std::size_t>(parsed.offset), parsed.description());
  XmlElement root;
  int roots = 0;
  for (const pugi::xml_node& node : document.children()) {
    if (node.type() != pugi::node_element) continue;
    if (++roots > 1) return wrong(static_cast<std::size_t>(node.offset_debug()), "a second root element");
    if (!TreeBuilder(file, places, out).build(node, 1, root)) return std::nullopt;
  }
  return root;
}

}  // namespace genu::osim
