// Which of two bodies move: derivatives by the twist of one that is fixed are asked for by nobody.
#pragma once

namespace genu {

struct WhichMove {
  bool a = true, b = true;

  bool operator[](int body) const { return body == 0 ? a : b; }
};

}  // namespace genu
