// Several report.html as one page: what each holds, put side by side.
#pragma once

#include <string>
#include <vector>

namespace genu {

/// A page as it was read, and what to call its result.
struct NamedReport {
  std::string name;
  std::string page;
};

/// Whether a text is a report.html of this format: if not, why, in words that follow its name; else empty.
std::string why_no_report(const std::string& page);

/// The page that compares them, the first with all others. Each must be one (why_no_report); a page of several results
/// brings all of them.
std::string merged_report(const std::vector<NamedReport>& reports);

}  // namespace genu
