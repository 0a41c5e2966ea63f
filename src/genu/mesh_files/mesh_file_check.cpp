#include "genu/mesh_files/mesh_file_check.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>

#include <unistd.h>

#include "genu/mesh_files/mesh_formats.h"
#include "genu/mesh_files/stl_binary.h"
#include "genu/mesh_files/tolerances.h"

namespace genu {
namespace {

std::string lower(std::string s) {
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

/// By its byte-order mark, or by two printable characters with a zero byte beside each.
bool is_utf16(std::string_view bytes) {
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) return true;
  if (bytes.size() < 4) return false;
  const auto zero = [&](std::size_t a, std::size_t b) { return bytes[a] == 0 && bytes[b] == 0; };
  const auto printable = [&](std::size_t a, std::size_t b) { return bytes[a] >= ' ' && bytes[b] >= ' '; };
  return (zero(0, 2) && printable(1, 3)) || (zero(1, 3) && printable(0, 2));
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
  if ((extension == ".stl" && fits_binary_stl(bytes)) || !is_utf16(bytes)) return {};
  return "is text in UTF-16: save it as UTF-8 (or ASCII)";
}

}  // namespace genu
