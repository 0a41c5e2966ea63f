#include "genu/mesh_files/mesh_file_check.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

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

// Up to `count` bytes from `offset`.
std::string read_bytes(const std::string& path, std::uint64_t offset, std::uint64_t count) {
  std::ifstream in(path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(offset));
  std::string bytes(static_cast<std::size_t>(count), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return bytes;
}

// ASCII STL starts with "solid", but so do some binary ones: the words of the body decide. Titles may be long.
bool is_ascii_stl(const std::string& path) {
  const std::string text = lower(read_bytes(path, 0, kBytesSearched));
  const std::size_t mark = text.starts_with("\xef\xbb\xbf") ? 3 : 0;  // of UTF-8
  const std::size_t first = text.find_first_not_of(" \t\r\n", mark);
  if (first == std::string::npos || text.compare(first, 5, "solid") != 0) return false;
  const auto has = [&](const char* word) { return text.find(word, first) != std::string::npos; };
  return has("vertex") || has("endsolid") || (has("facet") && text.find('\0') == std::string::npos);
}

MeshFileCheck check_stl(const std::string& path, std::uint64_t size) {
  const std::string start = read_bytes(path, 0, std::min<std::uint64_t>(size, 1024));
  std::uint32_t count = 0;
  if (start.size() >= kStlHeader) std::memcpy(&count, start.data() + kStlHeader - sizeof count, sizeof count);
  const std::uint64_t expected = kStlHeader + kStlTriangle * count;
  if (start.size() >= kStlHeader && size == expected) return {.problem = {}, .least_triangles = count};
  if (is_ascii_stl(path)) {
    const std::uint64_t tail = std::min<std::uint64_t>(size, 1024);
    if (lower(read_bytes(path, size - tail, tail)).find("endsolid") != std::string::npos) return {};
    return {.problem = "is an ASCII STL without its final \"endsolid\": it is truncated; copy or export it again"};
  }
  if (start.size() < kStlHeader) return {.problem = "is too short for an STL: copy or export it again"};
  const std::string sizes = "is a binary STL of " + std::to_string(count) + " triangles, which take " +
                            std::to_string(expected) + " bytes, but it has " + std::to_string(size);
  return {.problem = sizes + (size < expected ? ": it is truncated; copy or export it again"
                                              : ": it is damaged or no STL at all; export it again")};
}

}  // namespace

MeshFileCheck check_mesh_file(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  if (!fs::exists(status))
    return {.problem = "there is no such mesh file; check the path, relative to the scene's folder"};
  if (fs::is_directory(status)) return {.problem = "is a folder; name the mesh file inside it"};
  if (!fs::is_regular_file(status)) return {.problem = "is not a regular file; name an STL, PLY, OBJ, OFF or VTP file"};
  const std::uint64_t size = fs::file_size(path, failure);
  if (failure || !std::ifstream(path, std::ios::binary)) return {.problem = "cannot be opened; check its permissions"};
  if (size == 0) return {.problem = "is empty; copy or export it again"};
  const auto memory =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  if (size > memory / kMemoryPerByte) return {.problem = "is too large for this computer's memory; reduce the mesh"};
  const std::string extension = lower(fs::path(path).extension().string());
  if (extension == ".stl") return check_stl(path, size);
  if (extension == ".ply" || extension == ".obj" || extension == ".off" || extension == ".vtp") return {};
  std::string known = ".stl, .ply, .obj, .off, .vtp";
  for (const char* other : kByAssimp) {
    if (extension == other) return {};
    known += std::string(", ") + other;
  }
  return {.problem = "has the ending \"" + extension + "\"; genu reads " + known};
}

}  // namespace genu
