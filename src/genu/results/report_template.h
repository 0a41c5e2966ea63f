// The page itself, without data: bundle/page.html of src/report_page, in pieces. CMake makes the source of it
// (cmake/report_page.cmake), so that a program finds its page wherever it is.
#pragma once

#include <span>
#include <string_view>

namespace genu {

/// A piece of the page, and the slot between it and the next: "title", "data", "times", or nothing.
struct ReportTemplatePart {
  std::string_view text;
  std::string_view then;
};

std::span<const ReportTemplatePart> report_template();

}  // namespace genu
