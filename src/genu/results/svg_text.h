// Pieces of an SVG: its opening, words and straight lines.
#pragma once

#include <string>

#include <fmt/format.h>

namespace genu {

/// With what XML reserves escaped, and without the control characters that XML 1.0 does not have.
inline std::string svg_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20)
      out += c;
  }
  return out;
}

/// The letters of all charts, for the style of an SVG.
inline constexpr const char* kSvgLetters =
    "text{font:11.5px 'Helvetica Neue',Helvetica,Arial,'Liberation Sans',sans-serif;fill-opacity:1}";

/// The opening tag, the style and a white ground; sizes in pixels. "</svg>" ends it.
inline std::string svg_opening(double width, double height, const std::string& style) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\">\n"
      "<style>{2}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      width, height, style);
}

/// Words at (x, y) in pixels; `attributes` such as class="title", or none.
inline std::string svg_text(double x, double y, const std::string& words, const std::string& attributes = {}) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}{}>{}</text>\n", x, y, attributes.empty() ? "" : " ", attributes,
                     svg_escaped(words));
}

/// A straight line, in pixels, of a class of the style.
inline std::string svg_line(double x1, double y1, double x2, double y2, const char* style) {
  return fmt::format("<path class=\"{}\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", style, x1, y1, x2, y2);
}

}  // namespace genu
