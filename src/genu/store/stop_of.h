// Work that may run out of memory, or meet an error that is nobody's input: how it ended, so that what was found before
// can be kept.
#pragma once

#include <exception>
#include <new>
#include <string>
#include <vector>

#include "genu/path/path.h"
#include "genu/store/tolerances.h"

namespace genu {

/// Does `work`; what ended it before its end in words, else an empty text.
template <typename Work>
std::string stop_of(const Work& work) {
  std::vector<char> reserve;
  try {
    reserve.reserve(kStopReserve);
    work();
    return {};
  } catch (const std::bad_alloc&) {
    return "out of memory";
  } catch (const SavedElsewhere&) {
    throw;  // that is input
  } catch (const std::exception& error) {
    return std::string("internal error: ") + error.what();
  }
}

}  // namespace genu
