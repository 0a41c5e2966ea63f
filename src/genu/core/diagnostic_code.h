// What kind of mistake a diagnostic reports. Programs and the advice of the command line look at the code, never at the
// words: those are for people, and change.
#pragma once

#include <array>

namespace genu {

/// One for each thing a user can do about it; meaning in diagnostic_codes.def.
enum class Code {
#define GENU_CODE(name, text, meaning) name,
#include "genu/core/diagnostic_codes.def"
#undef GENU_CODE
};

/// All of them, in the order of their values.
inline constexpr std::array kAllCodes = {
#define GENU_CODE(name, text, meaning) Code::name,
#include "genu/core/diagnostic_codes.def"
#undef GENU_CODE
};

/// Words joined by dashes: "no-such-file".
const char* to_string(Code code);

}  // namespace genu
