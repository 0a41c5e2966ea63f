// What the API's classes share behind their headers. Not installed.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "genu/api/problem.h"
#include "genu/assemble/prepare.h"
#include "genu/core/diagnostics.h"

namespace genu::api {

/// In the order of their files. An option of the command line is named without its dashes.
std::vector<Problem> problems_of(Diagnostics diagnostics);

/// Throws SceneError if there is an error.
void check(const Diagnostics& diagnostics);

/// Throws SceneError with one error.
[[noreturn]] void refuse(Code code, const std::string& key, const std::string& found, const std::string& rule);

/// A joint ready to be solved, by one thread at a time: evaluations of a model are counted.
struct Ready {
  Prepared prepared;
  std::mutex running;
};

/// Calls f(prepared): with `ready` itself, or while another thread uses that, with a copy.
template <typename F>
auto use(Ready& ready, const F& f) {
  const std::unique_lock<std::mutex> alone(ready.running, std::try_to_lock);
  if (alone) return f(ready.prepared);
  Prepared copy = ready.prepared;
  copy.model.meter = std::make_shared<EffectMeter>();
  return f(copy);
}

}  // namespace genu::api
