#include "genu/sweep/npz_file.h"

#include <algorithm>
#include <bit>

#include <fmt/format.h>
#include <zlib.h>

namespace genu {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

template <typename T>
std::string little_endian(T value) {
  std::string bytes;
  for (std::size_t k = 0; k < sizeof value; ++k) bytes += static_cast<char>(value >> (8 * k) & 0xff);
  return bytes;
}
std::string two(std::uint16_t value) { return little_endian(value); }
std::string four(std::uint32_t value) { return little_endian(value); }
std::string eight(std::uint64_t value) { return little_endian(value); }

constexpr std::uint32_t kIn64Bits = 0xffffffff;  // the extra field has the size
constexpr std::uint16_t kVersion = 45, kUtf8Names = 1 << 11, kEarliestDate = 1 << 5 | 1;

/// What every entry of a member begins with, behind its signature and versions.
std::string common_head(const std::string& name, std::uint32_t crc, std::uint16_t extra) {
  return two(kUtf8Names) + two(0) + two(0) + two(kEarliestDate) + four(crc) + four(kIn64Bits) + four(kIn64Bits) +
         two(static_cast<std::uint16_t>(name.size())) + two(extra);
}

/// The head of a .npy file; its length is a multiple of 64 bytes.
std::string npy_head(const std::string& type, std::size_t rows, std::size_t columns, bool one_row) {
  const std::string shape = one_row ? fmt::format("({},)", columns) : fmt::format("({}, {})", rows, columns);
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type, shape);
  constexpr std::size_t kBefore = 10, kMultiple = 64;
  while ((kBefore + text.size() + 1) % kMultiple != 0) text += ' ';
  text += '\n';
  return std::string("\x93NUMPY\x01\x00", 8) + two(static_cast<std::uint16_t>(text.size())) + text;
}

/// The next code point of a text, and `at` behind it.
std::uint32_t next_code_point(std::string_view text, std::size_t& at) {
  constexpr std::uint32_t kReplacement = 0xfffd;
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(at++);
  if (first < 0x80) return first;
  const int more = first >= 0xf0 && first < 0xf8 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
  if (more == 0 || first >= 0xf8) return kReplacement;
  std::uint32_t code = first & (0x3fU >> more);
  for (int k = 0; k < more; ++k) {
    if (at >= text.size() || (byte(at) & 0xc0) != 0x80) return kReplacement;
    code = code << 6 | (byte(at++) & 0x3fU);
  }
  return code;
}

std::u32string in_utf32(std::string_view text) {
  std::u32string out;
  for (std::size_t at = 0; at < text.size();) out += static_cast<char32_t>(next_code_point(text, at));
  return out;
}

template <typename T>
std::string_view bytes_of(const T& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0])};
}

}  // namespace

void NpzFile::write(std::string_view bytes) {
  file_.write(bytes);
  written_ += bytes.size();
}

void NpzFile::add(const std::string& name, const std::vector<std::string_view>& pieces) {
  Member member{name + ".npy", written_, 0, 0};
  uLong crc = crc32_z(0, nullptr, 0);
  for (const std::string_view piece : pieces) {
    crc = crc32_z(crc, reinterpret_cast<const Bytef*>(piece.data()), piece.size());
    member.size += piece.size();
  }
  member.crc = static_cast<std::uint32_t>(crc);
  constexpr std::uint16_t kExtraOfMember = 20;
  write("PK\x03\x04" + two(kVersion) + common_head(member.name, member.crc, kExtraOfMember) + member.name + two(1) +
        two(kExtraOfMember - 4) + eight(member.size) + eight(member.size));
  for (const std::string_view piece : pieces) write(piece);
  members_.push_back(std::move(member));
}

void NpzFile::add_numbers(const std::string& name, const std::vector<const std::vector<double>*>& rows, bool one_row) {
  const std::string head = npy_head("<f8", rows.size(), rows.empty() ? 0 : rows.front()->size(), one_row);
  std::vector<std::string_view> pieces = {head};
  for (const std::vector<double>* row : rows) pieces.push_back(bytes_of(*row));
  add(name, pieces);
}

void NpzFile::add_words(const std::string& name, const std::vector<const std::vector<std::string>*>& rows,
                        bool one_row) {
  std::size_t width = 1;
  for (const auto* row : rows)
    for (const std::string& word : *row) width = std::max(width, in_utf32(word).size());
  std::u32string letters;
  for (const auto* row : rows)
    for (const std::string& word : *row) {
      std::u32string cell = in_utf32(word);
      cell.resize(width);
      letters += cell;
    }
  const std::string head =
      npy_head(fmt::format("<U{}", width), rows.size(), rows.empty() ? 0 : rows.front()->size(), one_row);
  add(name, {head, bytes_of(letters)});
}

std::string NpzFile::commit() {
  const std::uint64_t start = written_, count = members_.size();
  constexpr std::uint16_t kExtraOfEntry = 28;
  for (const Member& m : members_)
    write("PK\x01\x02" + two(kVersion) + two(kVersion) + common_head(m.name, m.crc, kExtraOfEntry) + two(0) + two(0) +
          two(0) + four(0) + four(kIn64Bits) + m.name + two(1) + two(kExtraOfEntry - 4) + eight(m.size) +
          eight(m.size) + eight(m.offset));
  const std::uint64_t end = written_;
  constexpr std::uint64_t kEndSize = 44;
  write("PK\x06\x06" + eight(kEndSize) + two(kVersion) + two(kVersion) + four(0) + four(0) + eight(count) +
        eight(count) + eight(end - start) + eight(start));
  write("PK\x06\x07" + four(0) + eight(end) + four(1));
  write("PK\x05\x06" + two(0) + two(0) + two(0xffff) + two(0xffff) + four(kIn64Bits) + four(kIn64Bits) + two(0));
  return file_.commit();
}

}  // namespace genu
