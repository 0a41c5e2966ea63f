// What the writers of mesh files share.
#pragma once

#include <cstring>
#include <string>

namespace genu {

/// The bytes of a number as this machine has them.
template <class T>
void append_bytes(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

/// One line, whatever is in the title.
inline std::string one_line(std::string title) {
  for (char& c : title)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return title;
}

}  // namespace genu
