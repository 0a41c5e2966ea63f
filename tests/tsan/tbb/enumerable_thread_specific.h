// team.h
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "team.h"

namespace tbb {

/// One T for each thread that asks. No lock: a lock here would bring threads in step and hide races.
template <class T>
class enumerable_thread_specific {
 public:
  template <class Make>
  explicit enumerable_thread_specific(Make make) : make_([make] { return std::unique_ptr<T>(new T(make())); }) {}

  T& local() {
    std::unique_ptr<T>& mine = each_[static_cast<std::size_t>(team::Slot::mine())];
    if (!mine) mine = make_();
    return *mine;
  }

 private:
  std::function<std::unique_ptr<T>()> make_;
  std::vector<std::unique_ptr<T>> each_ = std::vector<std::unique_ptr<T>>(team::kMostSlots);
};

}  // namespace tbb
