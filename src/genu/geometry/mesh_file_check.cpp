#include "genu/geometry/mesh_file_check.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <unistd.h>

namespace genu {
namespace {

constexpr std::uint64_t kStlHeader = 84, kStlTriangle = 50;  // bytes of a binary STL
// Measured on binary STL: the file itself, assimp's vertices, normals and faces, and the mesh before welding.
constexpr std::uint64_t kMemoryPerByte = 8;

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

// ASCII STL starts with "solid", but so do some binary ones: the first facet decides.
bool is_ascii_stl(const std::string& start) {
  const std::string text = lower(start);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const bool solid = first != std::string::npos && text.compare(first, 5, "solid") == 0;
  const bool body = text.find("facet") != std::string::npos || text.find("endsolid") != std::string::npos;
  return solid && body && text.find('\0') == std::string::npos;
}

MeshFileCheck check_stl(const std::string& path, std::uint64_t size) {
  const std::string start = read_bytes(path, 0, std::min<std::uint64_t>(size, 1024));
  std::uint32_t count = 0;
  if (start.size() >= kStlHeader) std::memcpy(&count, start.data() + kStlHeader - sizeof count, sizeof count);
  const std::uint64_t expected = kStlHeader + kStlTriangle * count;
  if (start.size() >= kStlHeader && size == expected) return {.problem = {}, .least_triangles = count};
  if (is_ascii_stl(start)) {
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

std::uint64_t ply_size(const std::string& type) {
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  if (type == "double" || type == "float64") return 8;
  return 4;
}

// No file holds so many; keeps sums and products of counts from overflowing.
constexpr std::uint64_t kCountless = std::uint64_t{1} << 48;

// What a PLY header promises.
struct PlyHeader {
  bool ascii = false;
  bool complete = false;
  std::size_t faces = 0;
  std::uint64_t entries = 0;  ///< of all elements: each a line of its own in ASCII
  std::uint64_t bytes = 0;    ///< least size of the binary body, with three indices a face
};

PlyHeader read_ply_header(std::istream& in) {
  PlyHeader header;
  std::string line, element;
  std::uint64_t count = 0;
  while (!header.complete && std::getline(in, line)) {
    std::istringstream words(line);
    std::string word, type, count_type;
    if (!(words >> word)) continue;
    if (word == "format" && words >> type) header.ascii = type == "ascii";
    if (word == "element" && words >> element >> count) {
      count = std::min(count, kCountless);
      header.entries += count;
      if (element == "face") header.faces = static_cast<std::size_t>(count);
    }
    if (word == "property" && words >> type) {
      const bool list = type == "list";
      if (list) words >> count_type >> type;
      const std::uint64_t values = list && element == "face" ? 3 : list ? 0 : 1;
      header.bytes += count * (values * ply_size(type) + (list ? ply_size(count_type) : 0));
    }
    header.complete = word == "end_header";
  }
  return header;
}

MeshFileCheck check_ply(const std::string& path, std::uint64_t size) {
  std::ifstream in(path, std::ios::binary);
  std::string line;
  if (!std::getline(in, line) || line.compare(0, 3, "ply") != 0) {
    return {.problem = "does not start with \"ply\": it is damaged or no PLY at all; export it again"};
  }
  const PlyHeader header = read_ply_header(in);
  if (!header.complete) {
    return {.problem = "has a PLY header without \"end_header\": it is truncated; copy or export it again"};
  }
  std::uint64_t lines = 0;
  const auto body = static_cast<std::uint64_t>(in.tellg());
  // The last line too has to end: a number cut in two is another number.
  while (header.ascii && std::getline(in, line))
    lines += !in.eof() && line.find_first_not_of(" \t\r") != std::string::npos;
  if (header.ascii ? lines < header.entries : size - body < header.bytes) {
    return {.problem = "holds less than its header promises: it is truncated; copy or export it again"};
  }
  return {.problem = {}, .least_triangles = header.faces};
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
  if (extension == ".ply") return check_ply(path, size);
  if (extension == ".obj" || extension == ".off" || extension == ".vtp") return {};
  return {.problem = "has the ending \"" + extension + "\"; genu reads .stl, .ply, .obj, .off and .vtp"};
}

}  // namespace genu
