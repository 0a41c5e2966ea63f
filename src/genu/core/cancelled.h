// How work that may take long is told to stop.
#pragma once

#include <functional>

namespace genu {

/// Asked now and then by what may take long, maybe by several threads at once; once true it stays true. Empty: nobody
/// ever stops it.
using Cancelled = std::function<bool()>;

inline bool asked_to_stop(const Cancelled& cancelled) { return cancelled && cancelled(); }

}  // namespace genu
