// The refusal of what an option of the command line says.
#pragma once

#include <string>

#include "genu/core/diagnostics.h"
#include "genu/scene/words.h"

namespace genu {

inline void refuse_option(Diagnostics& out, Code code, const std::string& option, const std::string& found,
                          const std::string& rule) {
  out.add(error_at({}, code, option, with_quotes(found), rule));
}

}  // namespace genu
