#include "genu/store/compare.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "genu/assemble/solution.h"
#include "genu/core/atomic_output.h"
#include "genu/core/file_text.h"
#include "genu/results/report_merge.h"
#include "genu/results/report_page.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

/// The folder's own name, or the file's without its ending; the path as given where that is taken.
std::string name_of(const std::string& result, const std::vector<NamedReport>& others) {
  fs::path path = fs::path(result).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  if (path.filename() == "report.html" && path.has_parent_path()) path = path.parent_path();
  std::string name = path.extension() == ".html" ? path.stem().string() : path.filename().string();
  if (name.empty() || name == "." || name == "..") name = result;
  const auto taken = [&](const NamedReport& r) { return r.name == name; };
  return std::any_of(others.begin(), others.end(), taken) ? result : name;
}

std::optional<std::string> page_of(const std::string& result, Diagnostics& out) {
  std::error_code ignored;
  const bool folder = fs::is_directory(result, ignored);
  const fs::path file = folder ? fs::path(result) / "report.html" : fs::path(result);
  Diagnostics unread;
  auto page = text_of_file(file.string(), unread);
  if (!page && folder) {
    out.error(Code::no_report_page, result, "holds no report.html: let genu run write one (without --no-report)");
    return std::nullopt;
  }
  for (const Diagnostic& d : unread.items()) out.add(d);
  if (!page) return std::nullopt;
  if (const std::string why = why_no_report(*page); !why.empty()) {
    out.error(Code::no_report_page, file.string(), why);
    return std::nullopt;
  }
  return page;
}

}  // namespace

int compare_results(const std::vector<std::string>& results, const std::string& file, Diagnostics& out) {
  std::vector<NamedReport> reports;
  for (const std::string& result : results)
    if (auto page = page_of(result, out)) reports.push_back({name_of(result, reports), std::move(*page)});
  if (!file.ends_with(".html")) out.error(Code::usage, file, "is a page: choose a name that ends with .html");
  for (const std::string& result : results) {
    std::error_code unknown;
    const fs::path folder = fs::path(file).parent_path() / ".";
    if (!fs::equivalent(folder, result, unknown) && !fs::equivalent(file, result, unknown)) continue;
    out.error(Code::page_in_result, file, "lies in a result that is compared: choose another folder");
    break;
  }
  if (const auto kept = why_not_replaced(file, kReportMark)) out.error(kept->code, {}, kept->text);
  if (results.size() < 2) out.error(Code::usage, file, "needs two results at least to compare");
  if (out.has_errors()) return kExitRefused;
  if (const std::string error = write_file_atomically(file, merged_report(reports)); !error.empty()) {
    out.error(Code::cannot_write, {}, error);
    return kExitFailed;
  }
  return kExitOk;
}

}  // namespace genu
