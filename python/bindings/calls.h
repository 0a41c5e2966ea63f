// Work without Python's lock: other threads run, Ctrl-C stops it, and progress is reported.
#pragma once

#include <atomic>
#include <chrono>
#include <thread>

#include "bindings.h"

namespace genu::python {

class Call {
 public:
  /// `progress`: None, True, or a callable (done, asked).
  explicit Call(py::object progress = py::none());

  std::function<bool()> cancelled();
  std::function<void(int, int)> progress();

  /// f() without the lock. KeyboardInterrupt, or whatever the progress has thrown, is thrown when it has come back.
  template <typename F>
  auto run(const F& f) {
    auto found = [&] {
      const py::gil_scoped_release free;
      return f();
    }();
    if (error_) throw py::error_already_set(std::move(*error_));
    return found;
  }

 private:
  bool look();
  template <typename F>
  void in_python(const F& f);

  py::object progress_;
  std::thread::id caller_ = std::this_thread::get_id();
  std::chrono::steady_clock::time_point looked_ = std::chrono::steady_clock::now();
  std::atomic<bool> stopped_ = false;
  std::optional<py::error_already_set> error_;
};

}  // namespace genu::python
