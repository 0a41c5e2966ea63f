// Writes numbers as VTK's XML files have them, for tests of the reader.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <zlib.h>

namespace genu::test {

inline std::string base64_of(const std::string& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    const std::size_t now = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < now ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += k <= now ? digits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

struct VtpBytes {
  std::string type;  ///< Float32, Float64, Int32 or Int64
  bool wide_header = false, swap = false, compressed = false;

  template <class T>
  std::string one(T value) const {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    if (swap) std::reverse(raw, raw + sizeof value);
    return {raw, sizeof value};
  }
  std::string count(std::uint64_t n) const { return wide_header ? one(n) : one(static_cast<std::uint32_t>(n)); }

  std::string body(const std::vector<double>& numbers) const {
    std::string out;
    for (const double x : numbers)
      out += type == "Float32"   ? one(static_cast<float>(x))
             : type == "Float64" ? one(x)
             : type == "Int32"   ? one(static_cast<std::int32_t>(x))
                                 : one(static_cast<std::int64_t>(x));
    return out;
  }

  /// Header and data; compressed in blocks of 16 bytes, as VTK does with larger ones.
  void write(const std::vector<double>& numbers, std::string& head, std::string& data) const {
    const std::string plain = body(numbers);
    if (!compressed) {
      head = count(plain.size());
      data = plain;
      return;
    }
    constexpr std::size_t kBlock = 16;
    std::string sizes;
    std::size_t blocks = 0;
    for (std::size_t i = 0; i < plain.size(); i += kBlock, ++blocks) {
      const std::string part = plain.substr(i, kBlock);
      std::string packed(compressBound(part.size()), '\0');
      uLongf length = packed.size();
      compress(reinterpret_cast<Bytef*>(packed.data()), &length, reinterpret_cast<const Bytef*>(part.data()),
               part.size());
      sizes += count(length);
      data += packed.substr(0, length);
    }
    head = count(blocks) + count(kBlock) + count(plain.size() % kBlock) + sizes;
  }

  std::string raw(const std::vector<double>& numbers) const {
    std::string head, data;
    write(numbers, head, data);
    return head + data;
  }

  /// VTK encodes head and data apart where it compresses, and together or apart where it does not.
  std::string base64(const std::vector<double>& numbers, bool apart) const {
    std::string head, data;
    write(numbers, head, data);
    return apart || compressed ? base64_of(head) + base64_of(data) : base64_of(head + data);
  }
};

}  // namespace genu::test
