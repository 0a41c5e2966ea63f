// team.h
#pragma once

#include <cstddef>

#include "team.h"

namespace tbb {

class global_control {
 public:
  enum parameter { max_allowed_parallelism };
  global_control(parameter, std::size_t threads)
      : before_(team::limit().exchange(static_cast<int>(std::max<std::size_t>(threads, 1)))) {}
  ~global_control() { team::limit() = before_; }
  global_control(const global_control&) = delete;
  global_control& operator=(const global_control&) = delete;

 private:
  int before_;
};

}  // namespace tbb
