// Pieces of an SVG: its opening, words and straight lines.
#pragma once

#include <string>

namespace genu {

/// With what XML reserves escaped, and without the control characters that XML 1.0 does not have.
std::string svg_escaped(const std::string& text);

/// The letters of all charts, for the style of an SVG.
inline constexpr const char* kSvgLetters =
    "text{font:11.5px 'Helvetica Neue',Helvetica,Arial,'Liberation Sans',sans-serif;fill-opacity:1}";

/// The opening tag, the style and a white ground; sizes in pixels. "</svg>" ends it.
std::string svg_opening(double width, double height, const std::string& style);

/// Words at (x, y) in pixels; `attributes` such as class="title", or none.
std::string svg_text(double x, double y, const std::string& words, const std::string& attributes = {});

/// A straight line, in pixels, of a class of the style.
std::string svg_line(double x1, double y1, double x2, double y2, const char* style);

}  // namespace genu
