#include "genu/core/file_text.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace genu {

std::optional<std::string> text_of_file(const std::string& path, Diagnostics& out) {
  const auto none = [&](Code code, const char* why) {
    out.error(code, path, why);
    return std::nullopt;
  };
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  if (!std::filesystem::exists(status)) return none(Code::no_such_file, "is not there");
  if (std::filesystem::is_directory(status)) return none(Code::is_folder, "is a folder, not a file");
  if (!std::filesystem::is_regular_file(status)) return none(Code::cannot_read, "is no regular file");
  std::ifstream in(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in.is_open() || in.bad()) return none(Code::cannot_read, "cannot be read");
  return text;
}

std::string shell_word(const std::string& word) {
  std::string text = !word.empty() && word.front() == '-' ? "./" + word : word;
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-./+,:@%=").find(c) != std::string::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string csv_word(const std::string& word) {
  if (word.find_first_of(",\"\n\r") == std::string::npos) return word;
  std::string quoted = "\"";
  for (const char c : word) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace genu
