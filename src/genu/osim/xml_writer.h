// The text of XML elements, indented.
#pragma once

#include <string>

#include <fmt/format.h>

#include "genu/core/types.h"

namespace genu::osim {

/// With & < > " as entities, and blanks for control characters.
inline std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  return out;
}

class XmlWriter {
 public:
  /// <tag name="NAME">; without a name <tag>.
  void open(const std::string& tag, const std::string& name = {}) {
    line(name.empty() ? "<" + tag + ">" : fmt::format("<{} name=\"{}\">", tag, xml_text(name)));
    ++depth_;
  }
  void close(const std::string& tag) {
    --depth_;
    line("</" + tag + ">");
  }
  void text(const std::string& tag, const std::string& value) {
    line(fmt::format("<{0}>{1}</{0}>", tag, xml_text(value)));
  }
  /// As many digits as bring back the same double.
  void number(const std::string& tag, double value) { text(tag, fmt::format("{}", value)); }
  void flag(const std::string& tag, bool value) { text(tag, value ? "true" : "false"); }
  void vector(const std::string& tag, const Vec3& v) { text(tag, fmt::format("{} {} {}", v.x(), v.y(), v.z())); }
  /// What another writer wrote, as deep as this one is.
  void add(const XmlWriter& inner) {
    std::size_t from = 0;
    for (std::size_t end = 0; (end = inner.out_.find('\n', from)) != std::string::npos; from = end + 1)
      line(inner.out_.substr(from, end - from));
  }
  const std::string& str() const { return out_; }

 private:
  void line(const std::string& words) { out_ += std::string(static_cast<std::size_t>(2 * depth_), ' ') + words + '\n'; }
  std::string out_;
  int depth_ = 0;
};

}  // namespace genu::osim
