#include "genu/api/problem.h"

#include <algorithm>

namespace genu::api {
namespace {

std::string text_of(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& p : problems)
    if (!p.warning) text += (text.empty() ? "" : "\n") + p.text;
  return text;
}

}  // namespace

SceneError::SceneError(std::vector<Problem> problems)
    : std::runtime_error(text_of(problems)), problems_(std::move(problems)) {}

const Problem& SceneError::first() const {
  return *std::find_if(problems_.begin(), problems_.end(), [](const Problem& p) { return !p.warning; });
}

}  // namespace genu::api
