#include "genu/results/report_page.h"

#include <algorithm>

#include "genu/results/packed_numbers.h"
#include "genu/results/report_template.h"
#include "genu/results/svg_text.h"

namespace genu {

namespace {

/// The SVG as an image, so that nothing in it is part of the page.
std::string figure(const ReportPicture& picture) {
  const std::string title = svg_escaped(picture.title);
  std::string lines;
  for (std::size_t from = 0; from < picture.text.size();) {
    const std::size_t end = std::min(picture.text.find('\n', from), picture.text.size());
    lines += svg_escaped(picture.text.substr(from, end - from)) + "\n";
    from = end + 1;
  }
  return "<figure><figcaption><h2>" + title + "</h2></figcaption>\n<img alt=\"" + title +
         "\" src=\"data:image/svg+xml;base64," + packed_text(picture.svg) + "\">\n<pre>" + lines + "</pre></figure>\n";
}

}  // namespace

std::string report_page(const std::string& title, const std::string& data, const std::string& times,
                        const std::vector<ReportPicture>& pictures) {
  std::string out;
  for (const ReportTemplatePart& part : report_template()) {
    out += part.text;
    if (part.then == "title") out += svg_escaped(title);
    if (part.then == "more")
      for (const ReportPicture& picture : pictures) out += figure(picture);
    if (part.then == "data") out += data;
    if (part.then == "times") out += times;
  }
  return out;
}

std::string html_safe_json(const std::string& json) {
  std::string out;
  out.reserve(json.size() + json.size() / 64);
  for (const char c : json) {
    if (c == '<')
      out += "\\u003c";
    else if (c == '>')
      out += "\\u003e";
    else if (c == '&')
      out += "\\u0026";
    else
      out += c;
  }
  return out;
}

}  // namespace genu
