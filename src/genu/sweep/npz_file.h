// Arrays as one file that numpy.load() reads: a ZIP archive (APPNOTE 6.3.10, with 64 bit sizes, nothing compressed) of
// a .npy file (NEP 1, version 1) for each array.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "genu/core/atomic_output.h"

namespace genu {

class NpzFile {
 public:
  explicit NpzFile(const std::filesystem::path& path) : file_(path, Durable::yes) {}

  /// numpy.load(...)[name]: an array of float64 with `rows` of equal length, or of one dimension where `one_row`. The
  /// last dimension changes fastest.
  void add_numbers(const std::string& name, const std::vector<const std::vector<double>*>& rows, bool one_row);
  /// The same of words; bytes that are no UTF-8 become U+FFFD.
  void add_words(const std::string& name, const std::vector<const std::vector<std::string>*>& rows, bool one_row);

  /// The empty text, or what went wrong.
  [[nodiscard]] std::string commit();

 private:
  struct Member {
    std::string name;
    std::uint64_t offset = 0, size = 0;
    std::uint32_t crc = 0;
  };
  void write(std::string_view bytes);
  void add(const std::string& name, const std::vector<std::string_view>& pieces);

  StagedFile file_;
  std::uint64_t written_ = 0;
  std::vector<Member> members_;
};

}  // namespace genu
