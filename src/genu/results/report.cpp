#include "genu/results/report.h"

#include "genu/results/report_data.h"
#include "genu/results/report_page.h"

namespace genu {

std::string report_html(const std::vector<ReportRun>& runs, const std::vector<ReportPicture>& pictures) {
  std::string title = "genu";
  if (!runs.empty()) {
    const RunSummary& s = *runs.front().summary;
    title = s.title.empty() ? s.scene_file : s.title;
  }
  return report_page(title, report_data(runs), report_times(runs), pictures);
}

}  // namespace genu
