#include "genu/mesh_files/mesh_file_check.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include <unistd.h>

#include "genu/mesh_files/mesh_formats.h"
#include "genu/mesh_files/tolerances.h"

namespace genu {
namespace {

constexpr std::uint64_t kStlHeader = 84, kStlTriangle = 50;  // bytes of a binary STL

std::string lower(std::string s) {
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

// ASCII STL starts with "solid", but so do some binary ones: the words of the body decide. Titles may be long.
bool is_ascii_stl(std::string_view bytes) {
  const std::string text = lower(std::string(bytes.substr(0, kBytesSearched)));
  const std::size_t mark = text.starts_with("\xef\xbb\xbf") ? 3 : 0;  // of UTF-8
  const std::size_t first = text.find_first_not_of(" \t\r\n", mark);
  if (first == std::string::npos || text.compare(first, 5, "solid") != 0) return false;
  const auto has = [&](const char* word) { return text.find(word, first) != std::string::npos; };
  return has("vertex") || has("endsolid") || (has("facet") && text.find('\0') == std::string::npos);
}

std::string check_stl(std::string_view bytes) {
  const std::size_t size = bytes.size();
  std::uint32_t count = 0;
  if (size >= kStlHeader) std::memcpy(&count, bytes.data() + kStlHeader - sizeof count, sizeof count);
  const std::uint64_t expected = kStlHeader + kStlTriangle * count;
  if (size >= kStlHeader && size == expected) return {};
  if (is_ascii_stl(bytes)) {
    const std::size_t tail = std::min<std::size_t>(size, 1024);
    if (lower(std::string(bytes.substr(size - tail))).find("endsolid") != std::string::npos) return {};
    return "is an ASCII STL without its final \"endsolid\": it is truncated; copy or export it again";
  }
  if (size < kStlHeader) return "is too short for an STL: copy or export it again";
  const std::string sizes = "is a binary STL of " + std::to_string(count) + " triangles, which take " +
                            std::to_string(expected) + " bytes, but it has " + std::to_string(size);
  return sizes + (size < expected ? ": it is truncated; copy or export it again"
                                  : ": it is damaged or no STL at all; export it again");
}

}  // namespace

std::string mesh_extension(const std::string& path) { return lower(std::filesystem::path(path).extension().string()); }

std::optional<Fault> check_mesh_name(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  if (!fs::exists(status))
    return Fault{Code::no_such_file, "there is no such mesh file; check the path, relative to the scene's folder"};
  if (fs::is_directory(status)) return Fault{Code::is_folder, "is a folder; name the mesh file inside it"};
  if (!fs::is_regular_file(status))
    return Fault{Code::cannot_read, "is not a regular file; name an STL, PLY, OBJ, OFF or VTP file"};
  const std::uint64_t size = fs::file_size(path, failure);
  if (failure || ::access(path.c_str(), R_OK) != 0) return Fault{Code::cannot_read, kCannotOpen};
  if (size == 0) return Fault{Code::mesh_unreadable, "is empty; copy or export it again"};
  const auto memory =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  if (size > memory / kMemoryPerByte)
    return Fault{Code::too_large, "is too large for this computer's memory; reduce the mesh"};
  const std::string extension = mesh_extension(path);
  if (extension == ".stl" || extension == ".ply" || extension == ".obj" || extension == ".off" || extension == ".vtp")
    return {};
  std::string known = ".stl, .ply, .obj, .off, .vtp";
  for (const char* other : kByAssimp) {
    if (extension == other) return {};
    known += std::string(", ") + other;
  }
  return Fault{Code::mesh_unreadable, "has the ending \"" + extension + "\"; genu reads " + known};
}

std::string check_mesh_bytes(const std::string& extension, std::string_view bytes) {
  return extension == ".stl" ? check_stl(bytes) : std::string();
}

}  // namespace genu
