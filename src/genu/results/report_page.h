// The page of report.html filled with a title, data and times.
#pragma once

#include <string>
#include <vector>

namespace genu {

/// Of the data: a page of another format is not understood.
inline constexpr int kReportFormat = 2;

/// In every page, and in no other file.
inline constexpr const char* kReportMark = "id=\"genu-notices\"";

/// A picture below the joint and its curves, and the lines that go with it.
struct ReportPicture {
  std::string title;
  std::string svg;   ///< a whole SVG
  std::string text;  ///< shown as it is, lines and blanks kept
};

/// `data` and `times` are html_safe_json().
std::string report_page(const std::string& title, const std::string& data, const std::string& times,
                        const std::vector<ReportPicture>& pictures = {});

/// JSON that an HTML parser takes for nothing but text: every <, > and & escaped.
std::string html_safe_json(const std::string& json);

}  // namespace genu
