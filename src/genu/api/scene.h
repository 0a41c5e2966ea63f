// A scene that is read once, changed in memory and solved as often as wanted, without the disk.
//
//   genu::api::Scene knee = genu::api::load("knee.toml");
//   knee.set("ACL*.stiffness", 0.5 * knee.value("ACLam1.stiffness"));   // N
//   const genu::api::Results found = knee.without("PCL*").run();
//   for (const double rotation : found["knee.rotation_deg"]) ...
//
// Numbers have the names of `genu sensitivity` and `genu calibrate`, with or without the kind of their object before
// them: "AAC.stiffness", "ligament.AAC.stiffness", "push.force.z", "tibiofemoral.modulus". Their units are those of
// results, whatever the scene's are: mm, deg, N, N m, MPa, kg. In patterns * stands for any letters and ? for one.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "genu/api/meshes.h"
#include "genu/api/problem.h"
#include "genu/api/results.h"

namespace genu::api {

/// A number of a scene.
struct Number {
  std::string name, unit;
  double value = 0;
};

/// Tension (N) of a law of your own, its derivative to the length (N/m) and its energy (J).
struct Tension {
  double force = 0, stiffness = 0, energy = 0;
};

/// A law of your own: smooth, and slack up to a length.
struct Law {
  std::function<Tension(double length)>
      tension;              ///< of a length (m) above `slack_length`; called by one thread at a time
  double slack_length = 0;  ///< m, > 0: without tension up to here
};

/// Poses from elsewhere, as columns of one length: coordinates as results.csv ("knee.flexion_deg"), OpenSim or the
/// scene names them, `time`, LOAD.factor.
struct Poses {
  std::vector<std::string> names;
  std::vector<std::span<const double>> columns;
  std::string units = {};  ///< "deg,mm": of columns whose names do not say it; else rad and m
  /// Of rows of earlier results, with their columns step and increment: rows that were not solved are left out.
  std::vector<std::string> status = {};
};

/// Loads at a pose that is not part of a run.
struct Loading {
  std::map<std::string, double> factors = {};  ///< of loads by name; 1 where none is given
  double time = 0;                             ///< s
};

/// A dense matrix, row by row.
struct Matrix {
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;
};

/// A value: a copy is another scene. Copies share meshes, surfaces and the search for contacts until they differ in
/// them. Different scenes may be used by different threads at the same time; one scene by one thread. Whatever is
/// refused is thrown as SceneError.
class Scene {
 public:
  Scene(const Scene& other);
  Scene(Scene&& other) noexcept;
  Scene& operator=(Scene other) noexcept;
  ~Scene();

  const std::string& title() const;
  const std::string& file() const;
  std::vector<std::string> bodies() const, joints() const, surfaces() const, contacts() const, ligaments() const,
      loads() const;
  /// The free coordinates, joint by joint: "knee.flexion".
  std::vector<std::string> coordinates() const;
  const std::vector<Problem>& warnings() const;  ///< of reading and preparing it
  std::vector<std::string> changes() const;      ///< since it was read, a sentence each

  /// The numbers whose names match, in the scene's order; those that cannot be changed are not among them.
  std::vector<Number> numbers(const std::string& pattern = "*") const;
  /// One number; its name is no pattern.
  double value(const std::string& name) const;
  /// Gives every number that matches one value, or each its own. One that the scene's rules forbid changes nothing.
  void set(const std::string& pattern, double value);
  void set(const std::string& pattern, std::span<const double> values);
  /// Replaces the law of a ligament. Sensitivities to its numbers are then refused.
  void set_law(const std::string& ligament, const Law& law);
  /// This scene without the ligaments, contacts and loads whose names, or bundles, match ("ACL*", "ligament.ACL*").
  [[nodiscard]] Scene without(const std::string& pattern) const;

  /// Solves it as `genu run` does, with the same numbers to the last digit.
  Results run(const RunOptions& options = {}) const;
  /// Forces and contacts at given poses, as `genu evaluate` does.
  Results evaluate(const Poses& poses, const std::function<bool()>& cancelled = {}) const;
  /// Solves it and differentiates columns of results to numbers of the scene, both chosen as by `genu sensitivity`.
  Sensitivity sensitivity(const std::vector<std::string>& of, const std::vector<std::string>& to,
                          const RunOptions& options = {}) const;

  /// Tests how lax a knee is, as `genu laxity` does: its joint has grood_suntay.
  Laxity laxity(const LaxityOptions& options = {}) const;

  /// The values of coordinates() where the search for equilibrium starts: rad, m.
  std::vector<double> start() const;
  /// For a solver of your own: what drives each of coordinates(), N m of rotations and N of translations, at their
  /// values `q` (rad, m); 0 at equilibrium, for a prescribed coordinate minus its reaction. Of ligaments, cartilage,
  /// loads, weights and joint springs. A scene with rigid contacts is refused: their forces are unknowns.
  std::vector<double> residual(std::span<const double> q, const Loading& loading = {}) const;
  /// -d residual / dq, exact: positive definite at a stable equilibrium.
  Matrix stiffness(std::span<const double> q, const Loading& loading = {}) const;

  struct Inside;
  explicit Scene(std::unique_ptr<Inside> inside);

 private:
  std::unique_ptr<Inside> inside_;
};

/// Reads a scene file and its meshes. `meshes`: in the place of files, by the names that the scene has for them.
Scene load(const std::string& file, const std::map<std::string, Triangles>& meshes = {});
/// The same of the text of a scene file. `file` names it in messages; its folder is where meshes are looked for.
Scene parse(const std::string& text, const std::string& file = "scene.toml",
            const std::map<std::string, Triangles>& meshes = {});

/// What `genu new` asks for.
struct NewScene {
  std::string kind = "analytic";  ///< "analytic", "stl", "motion"
  std::string folder = {};        ///< made new, with the scene in it; empty: in memory, of kind analytic or motion
  std::vector<std::string> femur = {}, tibia = {}, patella = {};   ///< of kind stl: files of bone, cartilage or both
  std::vector<std::string> fibula = {};                            ///< of bone
  std::string unit = {}, proximal = {}, anterior = {}, side = {};  ///< of kind stl
};
Scene make(const NewScene& asked);

}  // namespace genu::api
