// Fields as bytes and back, to the last bit, within one program on one kind of machine: numbers, enumerations, texts,
// pairs, arrays, vectors, optional values and Eigen's matrices of doubles; other types have serialize(archive, x) or
// x.serialize(archive), which call archive(fields ...). No format for files that other programs read.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "genu/core/types.h"

namespace genu {

/// The bytes are too few for what they should hold.
struct BrokenArchive : std::runtime_error {
  BrokenArchive() : std::runtime_error("broken archive") {}
};

namespace archive_detail {

template <typename T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <typename T>
concept EigenMatrix = std::is_base_of_v<Eigen::MatrixBase<T>, T> && std::is_same_v<typename T::Scalar, double>;

template <typename Archive, typename T>
struct Fields {
  static void walk(Archive& a, T& x) {
    if constexpr (Plain<T>) {
      a.raw(&x, sizeof x);
    } else if constexpr (EigenMatrix<T>) {
      if constexpr (T::SizeAtCompileTime == Eigen::Dynamic) {
        std::int64_t rows = x.rows(), columns = x.cols();
        a(rows, columns);
        a.expect(rows, columns, sizeof(double));
        x.resize(rows, columns);
      }
      a.raw(x.data(), static_cast<std::size_t>(x.size()) * sizeof(double));
    } else if constexpr (std::is_array_v<T>) {
      for (auto& item : x) a(item);
    } else if constexpr (requires { x.serialize(a); }) {
      x.serialize(a);
    } else {
      serialize(a, x);
    }
  }
};

template <typename Archive, typename T>
struct Fields<Archive, std::vector<T>> {
  static void walk(Archive& a, std::vector<T>& x) {
    std::uint64_t count = x.size();
    a(count);
    if constexpr (Plain<T>) {
      a.expect(count, sizeof(T));
      x.resize(count);
      a.raw(x.data(), count * sizeof(T));
    } else {
      a.expect(count);  // a byte each at least
      x.resize(count);
      for (T& item : x) a(item);
    }
  }
};

template <typename Archive>
struct Fields<Archive, std::string> {
  static void walk(Archive& a, std::string& x) {
    std::uint64_t count = x.size();
    a(count);
    a.expect(count);
    x.resize(count);
    a.raw(x.data(), count);
  }
};

template <typename Archive, typename T, std::size_t N>
struct Fields<Archive, std::array<T, N>> {
  static void walk(Archive& a, std::array<T, N>& x) {
    if constexpr (Plain<T>)
      a.raw(x.data(), sizeof x);
    else
      for (T& item : x) a(item);
  }
};

template <typename Archive, typename A, typename B>
struct Fields<Archive, std::pair<A, B>> {
  static void walk(Archive& a, std::pair<A, B>& x) { a(x.first, x.second); }
};

template <typename Archive, typename T>
struct Fields<Archive, std::optional<T>> {
  static void walk(Archive& a, std::optional<T>& x) {
    bool there = x.has_value();
    a(there);
    if (!there)
      x.reset();
    else if (x)
      a(*x);
    else
      a(x.emplace());
  }
};

}  // namespace archive_detail

class BinaryWriter {
 public:
  template <typename... Ts>
  void operator()(const Ts&... fields) {
    // One walk for both directions; this one only reads the fields.
    (archive_detail::Fields<BinaryWriter, Ts>::walk(*this, const_cast<Ts&>(fields)), ...);
  }
  std::string take() { return std::move(bytes_); }

  void raw(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }
  template <typename... Counts>
  void expect(Counts...) {}

 private:
  std::string bytes_;
};

/// Throws BrokenArchive where the bytes end too early. They must live as long.
class BinaryReader {
 public:
  explicit BinaryReader(std::string_view bytes) : left_(bytes) {}

  template <typename... Ts>
  void operator()(Ts&... fields) {
    (archive_detail::Fields<BinaryReader, Ts>::walk(*this, fields), ...);
  }
  bool at_end() const { return left_.empty(); }

  void raw(void* data, std::size_t size) {
    expect(size);
    if (size > 0) std::memcpy(data, left_.data(), size);
    left_.remove_prefix(size);
  }
  /// So many bytes, the product of the counts.
  template <typename... Counts>
  void expect(Counts... counts) const {
    double size = 1;  // products of counts may be larger than any integer
    ((size *= static_cast<double>(counts)), ...);
    const bool sound = ((static_cast<double>(counts) >= 0) && ...);
    if (!sound || size > static_cast<double>(left_.size())) throw BrokenArchive();
  }

 private:
  std::string_view left_;
};

}  // namespace genu
