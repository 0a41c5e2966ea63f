#include "genu/core/diagnostic_code.h"

#include <cstddef>

namespace genu {

const char* to_string(Code code) {
  static constexpr std::array kTexts = {
#define GENU_CODE(name, text, meaning) text,
#include "genu/core/diagnostic_codes.def"
#undef GENU_CODE
  };
  return kTexts[static_cast<std::size_t>(code)];
}

}  // namespace genu
