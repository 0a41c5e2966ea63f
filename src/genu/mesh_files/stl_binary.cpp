#include "genu/mesh_files/stl_binary.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "genu/mesh/mesh_topology.h"
#include "genu/mesh_files/tolerances.h"

namespace genu {
namespace {

static_assert(std::endian::native == std::endian::little, "STL is little-endian: swap bytes here first");

constexpr std::size_t kHeaderBytes = 84, kTriangle = 50;  // bytes
constexpr std::size_t kUnset = std::numeric_limits<std::uint32_t>::max();

template <class T>
T number_at(std::string_view bytes, std::size_t place) {
  T value;
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}

std::size_t count_of(std::string_view bytes) { return number_at<std::uint32_t>(bytes, kHeaderBytes - 4); }

std::array<Vec3, 3> corners(const char* triangle) {
  std::array<float, 9> x;  // after the normal, which the corners' order repeats
  std::memcpy(x.data(), triangle + 12, sizeof x);
  return {Vec3(x[0], x[1], x[2]), Vec3(x[3], x[4], x[5]), Vec3(x[6], x[7], x[8])};
}

void append(const char* triangle, Mesh& mesh) {
  const int i = static_cast<int>(mesh.vertices.size());
  for (const Vec3& corner : corners(triangle)) mesh.vertices.push_back(corner);
  mesh.triangles.push_back({i, i + 1, i + 2});
}

/// `triangles`: the bytes after a header.
void append(std::string_view triangles, std::size_t count, Mesh& mesh) {
  mesh.vertices.reserve(mesh.vertices.size() + 3 * count);
  mesh.triangles.reserve(mesh.triangles.size() + count);
  for (std::size_t t = 0; t < count; ++t) append(triangles.data() + t * kTriangle, mesh);
}

/// Each triangle's last two bytes say how many more belong to it: whether that adds up to the size.
bool read_with_attributes(std::string_view bytes, std::size_t count, Mesh& mesh) {
  std::size_t place = kHeaderBytes;
  std::vector<std::size_t> places;
  for (std::size_t t = 0; t < count; ++t) {
    if (place + kTriangle > bytes.size()) return false;
    places.push_back(place);
    place += kTriangle + number_at<std::uint16_t>(bytes, place + kTriangle - 2);
  }
  if (place != bytes.size()) return false;
  for (const std::size_t p : places) append(bytes.data() + p, mesh);
  return true;
}

/// Files written one after the other.
bool read_several(std::string_view bytes, Mesh& mesh, MeshNotes& notes) {
  std::vector<std::string_view> files;
  while (bytes.size() > kHeaderBytes) {
    const std::size_t size = kHeaderBytes + kTriangle * count_of(bytes);
    if (size == kHeaderBytes || size > bytes.size()) return false;
    files.push_back(bytes.substr(0, size));
    bytes.remove_prefix(size);
  }
  if (!bytes.empty()) return false;
  for (const std::string_view file : files) append(file.substr(kHeaderBytes), count_of(file), mesh);
  notes.add(std::to_string(files.size()) + " binary STL files one after the other", "read as one surface");
  return true;
}

/// Whether bytes after the promised triangles are more of them: corners that differ, none of them far from the others.
bool are_triangles(std::string_view more, const Mesh& promised) {
  if (more.size() % kTriangle != 0) return false;
  const BoundingBox box = bounding_box(promised);
  const Vec3 margin = Vec3::Constant(box.diagonal());
  for (std::size_t t = 0; t < more.size(); t += kTriangle) {
    const auto [a, b, c] = corners(more.data() + t);
    if (a == b || b == c || c == a) return false;
    for (const Vec3& p : {a, b, c})
      if (!((p - box.low + margin).minCoeff() >= 0 && (box.high + margin - p).minCoeff() >= 0)) return false;
  }
  return true;
}

/// More bytes than the triangles of the header take.
void read_longer(std::string_view bytes, std::size_t count, Mesh& mesh, MeshNotes& notes) {
  append(bytes.substr(kHeaderBytes), count, mesh);
  const std::string_view more = bytes.substr(kHeaderBytes + kTriangle * count);
  if (are_triangles(more, mesh)) {
    append(more, more.size() / kTriangle, mesh);
    notes.add(std::to_string(count) + " triangles by its header and " + std::to_string(mesh.triangles.size()) +
                  " by its size",
              "the size is believed");
  } else {
    notes.add(std::to_string(more.size()) + " bytes after its last triangle", "they are left out");
  }
}

bool read_by_size(std::string_view bytes, std::size_t count, Mesh& mesh, MeshNotes& notes) {
  const std::size_t whole = (bytes.size() - kHeaderBytes) / kTriangle;
  if (whole == 0 || bytes.size() != kHeaderBytes + kTriangle * whole) return false;
  append(bytes.substr(kHeaderBytes), whole, mesh);
  notes.add(std::to_string(count) + " as its count of triangles",
            "its size tells that there are " + std::to_string(whole) + ", which are read");
  return true;
}

std::string wrong_size(std::size_t size, std::size_t count) {
  const std::size_t expected = kHeaderBytes + kTriangle * count;
  const std::string text = "is a binary STL of " + std::to_string(count) + " triangles, which take " +
                           std::to_string(expected) + " bytes, but it has " + std::to_string(size);
  return text + (size < expected ? ": it is truncated; copy or export it again"
                                 : ": it is damaged or no STL at all; export it again");
}

}  // namespace

bool fits_binary_stl(std::string_view bytes) {
  return bytes.size() >= kHeaderBytes && bytes.size() == kHeaderBytes + kTriangle * count_of(bytes);
}

std::string read_binary_stl(std::string_view bytes, Mesh& mesh, MeshNotes& notes) {
  if (bytes.size() < kHeaderBytes) return "is too short for an STL: copy or export it again";
  if (bytes.size() / kTriangle > kMaxMeshCount) return "has more triangles than can be counted: reduce the mesh";
  const std::size_t count = count_of(bytes), size = bytes.size(), expected = kHeaderBytes + kTriangle * count;
  if (size == expected) {
    append(bytes.substr(kHeaderBytes), count, mesh);
    return {};
  }
  if ((count == 0 || count == kUnset) && read_by_size(bytes, count, mesh, notes)) return {};
  if (count > 0 && (read_with_attributes(bytes, count, mesh) || read_several(bytes, mesh, notes))) return {};
  // What follows may be anything, but hardly more than the triangles themselves: then the count is no count.
  if (size < expected || size - expected > expected - kHeaderBytes) return wrong_size(size, count);
  read_longer(bytes, count, mesh, notes);
  return {};
}

}  // namespace genu
