// Threads in the place of oneTBB's, for the thread sanitizer: it sees what the program does, not what a library does
// that was built without it, and so takes everything that oneTBB hands from thread to thread for a race. Here are plain
// std::threads, begun and joined at each loop; what they share without one of genu's own locks is a race indeed.
#pragma once

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

namespace tbb::team {

inline constexpr int kMostThreads = 4;   // of a loop
inline constexpr int kMostSlots = 1024;  // threads alive at a time

inline std::atomic<int>& limit() {
  static std::atomic<int> threads = kMostThreads;
  return threads;
}

/// How deep loops stand in loops on this thread: those within one get two threads each.
inline int& depth() {
  thread_local int loops = 0;
  return loops;
}

/// Numbers of the threads that are alive, for what each has of its own. Taken and given back at a thread's beginning
/// and end, where it is in step with others anyway.
class Slot {
 public:
  Slot() {
    const std::lock_guard lock(guard());
    for (number_ = 0; taken()[static_cast<std::size_t>(number_)];) ++number_;
    taken()[static_cast<std::size_t>(number_)] = true;
  }
  ~Slot() {
    const std::lock_guard lock(guard());
    taken()[static_cast<std::size_t>(number_)] = false;
  }
  Slot(const Slot&) = delete;
  Slot& operator=(const Slot&) = delete;

  static int mine() {
    thread_local Slot slot;
    return slot.number_;
  }

 private:
  static std::mutex& guard() {
    static std::mutex mutex;
    return mutex;
  }
  static std::vector<bool>& taken() {
    static std::vector<bool> slots(kMostSlots, false);
    return slots;
  }
  int number_ = 0;
};

/// Calls run(k) once for each k from 0 to count - 1. Who takes which is settled without bringing threads in step.
template <class Run>
void each(int count, const Run& run) {
  const int threads = std::min({count, limit().load(), depth() > 0 ? 2 : kMostThreads});
  std::atomic<int> next = 0;
  const auto work = [&](int loops) {
    depth() = loops;
    for (int k = next.fetch_add(1, std::memory_order_relaxed); k < count;
         k = next.fetch_add(1, std::memory_order_relaxed))
      run(k);
  };
  const int before = depth();
  std::vector<std::thread> others;
  for (int k = 1; k < threads; ++k) others.emplace_back(work, before + 1);
  work(before + 1);
  depth() = before;
  for (std::thread& other : others) other.join();
}

}  // namespace tbb::team
