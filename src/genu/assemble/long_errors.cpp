#include "genu/assemble/long_errors.h"

#include <fmt/format.h>

namespace genu {

LongErrors::~LongErrors() {
  if (count_ > kProblemsListed)
    out_->error(Code::broken_file, path_, fmt::format("{} more errors like these", count_ - kProblemsListed));
  if (warnings_ > kWarningsListed)
    out_->warning(Code::broken_file, path_, fmt::format("{} more warnings like these", warnings_ - kWarningsListed));
}

void LongErrors::add(SourceLocation where, Code code, const std::string& key, const std::string& found,
                     const std::string& rule) {
  if (++count_ > kProblemsListed) return;
  out_->add(error_at({path_, where}, code, key, found, rule));
}

void LongErrors::warn(SourceLocation where, Code code, const std::string& key, const std::string& found,
                      const std::string& rule) {
  if (++warnings_ > kWarningsListed) return;
  out_->add(warning_at({path_, where}, code, key, found, rule));
}

}  // namespace genu
