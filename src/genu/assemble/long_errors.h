// Errors and warnings of a long file: the first ones as they are, then how many more there are.
#pragma once

#include <string>

#include "genu/core/diagnostics.h"

namespace genu {

class LongErrors {
 public:
  LongErrors(std::string path, Diagnostics& out) : path_(std::move(path)), out_(&out) {}
  ~LongErrors();
  LongErrors(const LongErrors&) = delete;
  LongErrors& operator=(const LongErrors&) = delete;

  void add(SourceLocation where, Code code, const std::string& key, const std::string& found, const std::string& rule);
  void warn(SourceLocation where, Code code, const std::string& key, const std::string& found, const std::string& rule);
  std::size_t count() const { return count_; }  ///< of errors

 private:
  static constexpr std::size_t kProblemsListed = 20, kWarningsListed = 5;
  std::string path_;
  Diagnostics* out_;
  std::size_t count_ = 0, warnings_ = 0;
};

}  // namespace genu
