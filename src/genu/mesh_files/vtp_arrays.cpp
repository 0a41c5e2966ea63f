#include "genu/mesh_files/vtp_arrays.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <zlib.h>

#include "genu/mesh_files/text_words.h"
#include "genu/mesh_files/tolerances.h"

namespace genu {
namespace {

constexpr const char* kTruncated =
    "has an array with fewer bytes than it promises: it is truncated; copy or export it again";
constexpr const char* kDamaged = "has an array that cannot be decoded: it is damaged; export it again";

int base64_value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// Bytes one after the other, out of raw data or base64. VTK encodes counts and data now together, now apart: then
/// padding stands in the middle, which ends a group of four and nothing else.
class ByteSource {
 public:
  ByteSource(std::string_view text, bool base64) : text_(text), base64_(base64) {}

  /// At most as many bytes are left.
  std::size_t left() const { return text_.size() - at_ + held_.size(); }

  bool read(std::size_t count, std::string& out) {
    out.clear();
    if (count > left()) return false;
    if (!base64_) {
      out.assign(text_.substr(at_, count));
      at_ += count;
      return true;
    }
    out.reserve(count);
    while (out.size() < count) {
      if (held_.empty() && !read_group()) return false;
      const std::size_t now = std::min(count - out.size(), held_.size());
      out.append(held_, 0, now);
      held_.erase(0, now);
    }
    return true;
  }

 private:
  bool read_group() {
    std::uint32_t bits = 0;
    int digits = 0, padding = 0;
    while (digits + padding < 4) {
      if (at_ == text_.size()) return false;
      const char c = text_[at_++];
      if (c == ' ' || (c >= '\t' && c <= '\r')) continue;
      const int value = base64_value(c);
      if (c == '=')
        ++padding;
      else if (value < 0 || padding > 0)
        return false;
      else
        ++digits;
      bits = bits << 6 | static_cast<std::uint32_t>(std::max(value, 0));
    }
    for (int k = 0; k < 3 - padding; ++k) held_ += static_cast<char>(bits >> (16 - 8 * k) & 0xff);
    return digits > 1;
  }

  std::string_view text_;
  bool base64_;
  std::size_t at_ = 0;
  std::string held_;
};

template <class T>
T number_at(const std::string& bytes, std::size_t k, bool swap) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes.data() + k * sizeof(T), sizeof(T));
  if (swap) std::reverse(raw.begin(), raw.end());
  T value;
  std::memcpy(&value, raw.data(), sizeof(T));
  return value;
}

bool read_counts(ByteSource& source, const VtpEncoding& encoding, std::size_t count, std::vector<std::uint64_t>& out) {
  std::string bytes;
  if (count > source.left() || !source.read(count * (encoding.wide_header ? 8 : 4), bytes)) return false;
  for (std::size_t k = 0; k < count; ++k)
    out.push_back(encoding.wide_header ? number_at<std::uint64_t>(bytes, k, encoding.swap)
                                       : number_at<std::uint32_t>(bytes, k, encoding.swap));
  return true;
}

std::string read_plain(ByteSource& source, const VtpEncoding& encoding, std::string& bytes) {
  std::vector<std::uint64_t> size;
  if (!read_counts(source, encoding, 1, size) || !source.read(size[0], bytes)) return kTruncated;
  return {};
}

/// Number of blocks, size of a block, of the last one (0: a whole one), then of each when compressed; then the blocks.
std::string read_blocks(ByteSource& source, const VtpEncoding& encoding, std::string& bytes) {
  std::vector<std::uint64_t> head, sizes;
  if (!read_counts(source, encoding, 3, head) || !read_counts(source, encoding, head[0], sizes)) return kTruncated;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const std::uint64_t whole = k + 1 == sizes.size() && head[2] > 0 ? head[2] : head[1];
    std::string packed;
    if (!source.read(sizes[k], packed)) return kTruncated;
    if (whole > kMaxInflation * (packed.size() + 1)) return kDamaged;
    const std::size_t before = bytes.size();
    bytes.resize(before + whole);
    auto length = static_cast<uLongf>(whole);
    const int code = uncompress(reinterpret_cast<Bytef*>(bytes.data() + before), &length,
                                reinterpret_cast<const Bytef*>(packed.data()), static_cast<uLong>(packed.size()));
    if (code != Z_OK || length != whole) return kDamaged;
  }
  return {};
}

template <class T>
void append_numbers(const std::string& bytes, bool swap, std::vector<double>& out) {
  const std::size_t count = bytes.size() / sizeof(T);
  out.reserve(out.size() + count);
  for (std::size_t k = 0; k < count; ++k) out.push_back(static_cast<double>(number_at<T>(bytes, k, swap)));
}

bool append_as(const std::string& type, const std::string& bytes, bool swap, std::vector<double>& out) {
  if (type == "Float32") return append_numbers<float>(bytes, swap, out), true;
  if (type == "Float64") return append_numbers<double>(bytes, swap, out), true;
  if (type == "Int64") return append_numbers<std::int64_t>(bytes, swap, out), true;
  if (type == "UInt64") return append_numbers<std::uint64_t>(bytes, swap, out), true;
  if (type == "Int32") return append_numbers<std::int32_t>(bytes, swap, out), true;
  if (type == "UInt32") return append_numbers<std::uint32_t>(bytes, swap, out), true;
  if (type == "Int16") return append_numbers<std::int16_t>(bytes, swap, out), true;
  if (type == "UInt16") return append_numbers<std::uint16_t>(bytes, swap, out), true;
  if (type == "Int8") return append_numbers<std::int8_t>(bytes, swap, out), true;
  if (type == "UInt8") return append_numbers<std::uint8_t>(bytes, swap, out), true;
  return false;
}

std::string read_ascii(const VtpArray& array, std::vector<double>& out, MeshNotes& notes) {
  TextWords words(array.text, 0, array.line);
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    double value = 0;
    if (!words.decimal(word, value, notes))
      return "has " + in_quotes(word) + " where a number should stand: export it again";
    out.push_back(value);
  }
  return {};
}

}  // namespace

std::string read_vtp_array(const VtpArray& array, const VtpEncoding& encoding, std::vector<double>& out,
                           MeshNotes& notes) {
  const bool ascii = array.format == "ascii";
  if (!(ascii && array.type.empty()) && !append_as(array.type, {}, false, out))
    return "has an array of the type " + in_quotes(array.type) + ", which genu does not know";
  if (ascii) return read_ascii(array, out, notes);
  const bool appended = array.format == "appended";
  if (!appended && array.format != "binary")
    return "has an array of the format " + in_quotes(array.format) + "; genu reads ascii, binary and appended";
  if (appended && array.offset > encoding.appended.size()) return kTruncated;
  ByteSource source(appended ? encoding.appended.substr(array.offset) : array.text,
                    appended ? encoding.appended_base64 : true);
  std::string bytes;
  const std::string problem =
      encoding.compressed ? read_blocks(source, encoding, bytes) : read_plain(source, encoding, bytes);
  if (!problem.empty()) return problem;
  append_as(array.type, bytes, encoding.swap, out);
  return {};
}

}  // namespace genu
