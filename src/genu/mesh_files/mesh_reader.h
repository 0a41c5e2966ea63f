// Triangle meshes from files: STL (binary, ASCII), PLY, OBJ, OFF and VTP.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "genu/core/diagnostics.h"
#include "genu/core/input_files.h"
#include "genu/core/piece_files.h"
#include "genu/mesh/mesh.h"
#include "genu/mesh/mesh_join.h"
#include "genu/mesh/mesh_weld.h"

namespace genu {

/// What a mesh file held before its vertices were welded.
struct MeshFileFacts {
  std::size_t vertices = 0, triangles = 0;
  WeldReport weld;
  double rounding = 0;     ///< m: the step of its numbers (coordinate_step.h); 0: double precision, or too few to tell
  bool single = false;     ///< that is float32's step at the largest coordinate, not one the exporter chose
  std::string space = {};  ///< the frame that the file names (mesh_space.h): "RAS", "LPS"; empty: none
  std::vector<std::string> notes = {};           ///< what is not as its format has it, and was read all the same
  std::vector<std::size_t> ends = {};            ///< of a mesh of several files: JoinedMesh::ends, else empty
  std::vector<JoinedMesh::Border> borders = {};  ///< between the pieces of these files
};

/// The meshes that a piece of work uses. Each file is opened and parsed once, whoever asks for it and however often;
/// meshes in memory stand in for files. Calls from several threads are safe.
class MeshLibrary {
 public:
  /// Opens files through `files`, so that others see the same bytes.
  explicit MeshLibrary(std::shared_ptr<InputFiles> files = std::make_shared<InputFiles>()) : files_(std::move(files)) {}

  /// Reads all triangles of `path` (polygons are cut into triangles), welds vertices within weld_tolerance(), drops
  /// degenerate and repeated triangles (a warning gives their number) and turns file units into metres. Vertices keep
  /// the order of their first appearance; the winding is the file's. Coordinates that single precision rounds to more
  /// than 2 um, as far from the origin, get a warning.
  /// Several files are read like that each, and joined: vertices of two pieces within the larger of their tolerances
  /// become one, triangles that an earlier piece has are dropped (a warning), and pieces that do not touch stay apart.
  /// Empty with an error in `out` that names the file, what is wrong and what to do, for a file that is missing, not
  /// readable, of another format, empty, truncated, larger than memory, or without triangles or with coordinates that
  /// are not numbers or lie beyond 1e9 units.
  [[nodiscard]] std::optional<Mesh> read(const PieceFiles& files, double metres_per_unit, Diagnostics& out,
                                         MeshFileFacts* facts = nullptr);

  /// The same for files of unknown unit: m where that alone makes the whole a knee's surface, else mm.
  /// `metres_per_unit` gets it.
  [[nodiscard]] std::optional<Mesh> read_of_some_unit(const PieceFiles& files, double& metres_per_unit,
                                                      Diagnostics& out, MeshFileFacts* facts = nullptr);

  /// What tells the bytes of these files from any others; empty where one is a mesh in memory, cannot be read, or may
  /// name further files (those that assimp reads).
  std::string content_of(const PieceFiles& files);

  /// From now on read(name) gives this mesh (its coordinates in units of that call), cleaned as a file's would be.
  void put(const std::string& name, const Mesh& mesh);

  /// Frees the mesh of a name that nobody reads at this moment.
  void drop(const std::string& name);

  InputFiles& files() { return *files_; }

 private:
  struct Entry {
    Mesh mesh;  ///< in the file's unit
    MeshFileFacts facts;
    std::optional<Fault> fault;  ///< why there is no mesh
    bool in_memory = false;      ///< put(), not a file
  };
  const Entry& entry(const std::string& path);
  std::optional<Mesh> join(const PieceFiles& files, double metres_per_unit, Diagnostics& out, MeshFileFacts* facts);

  std::shared_ptr<InputFiles> files_;
  std::mutex mutex_;
  std::map<std::string, Entry> entries_;
};

/// MeshLibrary::read() for one use.
[[nodiscard]] std::optional<Mesh> read_mesh(const PieceFiles& files, double metres_per_unit, Diagnostics& out,
                                            MeshFileFacts* facts = nullptr);

/// MeshLibrary::read_of_some_unit() for one use.
[[nodiscard]] std::optional<Mesh> read_mesh_of_some_unit(const PieceFiles& files, double& metres_per_unit,
                                                         Diagnostics& out, MeshFileFacts* facts = nullptr);

}  // namespace genu
