#include "calls.h"

namespace genu::python {
namespace {

constexpr auto kBetweenLooks = std::chrono::milliseconds(20);  // for Ctrl-C; a look takes Python's lock

}  // namespace

Call::Call(py::object progress) : progress_(std::move(progress)) {
  if (progress_.is_none()) return;
  if (py::isinstance<py::bool_>(progress_))
    progress_ = progress_.cast<bool>() ? py::module_::import("genu._progress").attr("bar")() : py::none();
  else if (PyCallable_Check(progress_.ptr()) == 0)
    throw py::type_error("progress must be True, False, None or a function of (done, asked)");
}

template <typename F>
void Call::in_python(const F& f) {
  const py::gil_scoped_acquire locked;
  try {
    f();
  } catch (py::error_already_set& error) {
    error_.emplace(std::move(error));
    stopped_ = true;
  }
}

bool Call::look() {
  if (stopped_ || std::this_thread::get_id() != caller_) return stopped_;
  const auto now = std::chrono::steady_clock::now();
  if (now - looked_ < kBetweenLooks) return false;
  looked_ = now;
  in_python([] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  });
  return stopped_;
}

std::function<bool()> Call::cancelled() {
  return [this] { return look(); };
}

std::function<void(int, int)> Call::progress() {
  if (progress_.is_none()) return {};
  return [this](int done, int asked) {
    if (!stopped_ && std::this_thread::get_id() == caller_) in_python([&] { progress_(done, asked); });
  };
}

}  // namespace genu::python
