// Colours of words in a terminal.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <string>

namespace genu::cli {

enum class Colour { none = 0, red = 31, green = 32, yellow = 33 };

/// Whether what goes to a stream (STDOUT_FILENO, STDERR_FILENO) may have colours: it is a terminal, NO_COLOR is unset
/// or empty (https://no-color.org) and TERM is not "dumb".
inline bool has_colours(int stream) {
  const char *no = std::getenv("NO_COLOR"), *term = std::getenv("TERM");
  return isatty(stream) != 0 && (no == nullptr || *no == 0) && (term == nullptr || std::string(term) != "dumb");
}

/// `text` in a colour, where the stream has them.
inline std::string painted(const std::string& text, Colour colour, int stream) {
  if (colour == Colour::none || !has_colours(stream)) return text;
  return "\x1b[" + std::to_string(static_cast<int>(colour)) + "m" + text + "\x1b[0m";
}

}  // namespace genu::cli
