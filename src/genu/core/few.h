// At most N values, in place: no allocation, and what is not there is not initialised.
#pragma once

#include <cassert>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>

namespace genu {

template <typename T, std::size_t N>
class Few {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  Few() {}  // NOLINT(modernize-use-equals-default): the storage stays as it is
  explicit Few(std::size_t count) { resize(count); }
  Few(const Few& other) { assign(other); }
  Few& operator=(const Few& other) {
    if (this != &other) assign(other);
    return *this;
  }
  ~Few() = default;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  bool full() const { return size_ == N; }

  T* data() { return &values_[0]; }
  const T* data() const { return &values_[0]; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  T& operator[](std::size_t i) { return values_[i]; }
  const T& operator[](std::size_t i) const { return values_[i]; }

  /// Asks for size() < N.
  T& push_back(const T& value) {
    assert(size_ < N);
    return *std::construct_at(data() + size_++, value);
  }
  /// To a smaller size, or with default values to one of at most N.
  void resize(std::size_t count) {
    assert(count <= N);
    for (; size_ < count; ++size_) std::construct_at(data() + size_);
    size_ = count;
  }

  operator std::span<T>() { return {data(), size_}; }
  operator std::span<const T>() const { return {data(), size_}; }

 private:
  void assign(const Few& other) {
    size_ = 0;
    for (const T& value : other) push_back(value);
  }

  std::size_t size_ = 0;
  union {
    T values_[N];
  };
};

}  // namespace genu
