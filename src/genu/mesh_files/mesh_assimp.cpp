#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <exception>

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "genu/mesh_files/mesh_file_check.h"
#include "genu/mesh_files/mesh_formats.h"
#include "genu/mesh_files/tolerances.h"

namespace genu {
namespace {

// Positions and triangles alone: a normal or texture coordinate that differs never parts two corners, so none of
// assimp's own joining (which keeps STL torn along its facet normals) is needed. Empty text where all is well.
std::string append_part(const aiMesh& part, const aiMatrix4x4& placed, Mesh& mesh, std::vector<Fan>& fans) {
  const std::size_t base = mesh.vertices.size();
  if (base + part.mNumVertices > kMaxMeshCount) return "has more vertices than can be counted: reduce the mesh";
  for (unsigned v = 0; v < part.mNumVertices; ++v) {
    const aiVector3D p = placed * part.mVertices[v];
    mesh.vertices.emplace_back(p.x, p.y, p.z);
  }
  std::vector<int> corners;
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    for (unsigned k = 0; k < face.mNumIndices; ++k)
      if (face.mIndices[k] >= part.mNumVertices)
        return "has a face that names a vertex it does not have: export it again";
    corners.clear();
    for (unsigned k = 0; k < face.mNumIndices; ++k) corners.push_back(static_cast<int>(base + face.mIndices[k]));
    if (corners.size() >= 3) add_polygon(corners, mesh, fans);  // points and lines are not a surface
  }
  return {};
}

std::string append_below(const aiScene& scene, const aiNode& node, const aiMatrix4x4& placed, Mesh& mesh,
                         std::vector<Fan>& fans) {
  for (unsigned m = 0; m < node.mNumMeshes; ++m)
    if (std::string problem = append_part(*scene.mMeshes[node.mMeshes[m]], placed, mesh, fans); !problem.empty())
      return problem;
  for (unsigned c = 0; c < node.mNumChildren; ++c) {
    const aiNode& child = *node.mChildren[c];
    if (std::string problem = append_below(scene, child, placed * child.mTransformation, mesh, fans); !problem.empty())
      return problem;
  }
  return {};
}

/// Gives assimp the file's bytes; what that file names beside itself (a .gltf its buffers) comes from the disk.
class BytesOfFile : public Assimp::DefaultIOSystem {
 public:
  BytesOfFile(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {}
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (path_ != file) return DefaultIOSystem::Open(file, mode);
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size());
  }

 private:
  std::string path_;
  std::string_view bytes_;
};

/// In COLLADA and 3DS, assimp puts a turn to its own up axis and a scale to metres on the root, which has no placement
/// of its own there. Numbers keep the frame and the unit that the file has them in.
aiMatrix4x4 placement_of_root(const std::string& path, const aiScene& scene) {
  const std::string extension = mesh_extension(path);
  return extension == ".dae" || extension == ".3ds" ? aiMatrix4x4() : scene.mRootNode->mTransformation;
}

std::string read_here(const std::string& path, std::string_view bytes, Mesh& mesh, MeshNotes& notes) {
  const auto unreadable = [](const std::string& why) {
    return "cannot be read as a mesh (" + why + "): export it again as binary STL";
  };
  try {
    Assimp::Importer importer;
    importer.SetIOHandler(new BytesOfFile(path, bytes));  // which the importer owns
    // No post-processing: assimp's triangulation aborts the program on some broken files (5.2.5).
    const aiScene* scene = importer.ReadFile(path, 0);
    if (scene == nullptr) return unreadable(importer.GetErrorString());
    if (scene->mRootNode == nullptr) return unreadable("it has no root");
    std::vector<Fan> fans;
    const aiMatrix4x4 root = placement_of_root(path, *scene);
    if (std::string problem = append_below(*scene, *scene->mRootNode, root, mesh, fans); !problem.empty())
      return problem;
    cut_polygons(mesh, fans, notes);
    return {};
  } catch (const std::exception& e) {  // assimp's own parsers may throw on a broken file, and memory may run out
    return unreadable(e.what());
  }
}

/// Whether a process of its own that reads the file dies of it: where nodes hold each other by the thousand, or
/// themselves, assimp's parsers go on until the stack is full.
bool kills_its_reader(const std::string& path, std::string_view bytes) {
  const pid_t child = ::fork();
  if (child < 0) return false;
  if (child == 0) {
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    for (const int signal : {SIGSEGV, SIGBUS, SIGABRT}) std::signal(signal, SIG_DFL);
    Mesh ignored;
    MeshNotes unread;
    read_here(path, bytes, ignored, unread);
    ::_exit(0);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return false;
  return !WIFEXITED(status) || WEXITSTATUS(status) != 0;
}

}  // namespace

std::string read_by_assimp(const std::string& path, std::string_view bytes, Mesh& mesh, MeshNotes& notes) {
  if (kills_its_reader(path, bytes))
    return "cannot be read as a mesh (its reader, assimp, breaks down over it): export it again as binary STL";
  return read_here(path, bytes, mesh, notes);
}

}  // namespace genu
