// report.html: a solved joint to look at, in one file that needs nothing else. It shows what is handed to it and
// computes nothing but changes of unit; the page's own program (src/report_page) draws.
#pragma once

#include <string>
#include <vector>

#include "genu/results/report_page.h"
#include "genu/results/report_run.h"

namespace genu {

/// The page. Everything that depends on time or machine is in one line, the element `genu-times`: the rest
/// is the same for the same runs.
std::string report_html(const std::vector<ReportRun>& runs, const std::vector<ReportPicture>& pictures = {});

}  // namespace genu
