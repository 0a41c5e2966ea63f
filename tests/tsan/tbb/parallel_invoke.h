// team.h
#pragma once

#include "team.h"

namespace tbb {

template <class A, class B>
void parallel_invoke(const A& a, const B& b) {
  team::each(2, [&](int k) {
    if (k == 0)
      a();
    else
      b();
  });
}

}  // namespace tbb
