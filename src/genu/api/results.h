// What a run, or an evaluation of given poses, has found.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "genu/api/table.h"

namespace genu::api {

struct RunOptions {
  bool error_bars = false;  ///< also solves the scene on other surfaces that its meshes might have given
  std::function<void(int done, int asked)> progress{};  ///< after every pose; may be empty
  /// Asked now and then by any thread: true stops the work, and what was found is kept. May be empty.
  std::function<bool()> cancelled{};
};

/// Copies share what they hold; it never changes.
class Results {
 public:
  /// One row a pose, the columns of results.csv: lengths in mm, angles in deg, forces in N, moments in N m, points in
  /// the frame of the body that a column names.
  const Table& poses() const;
  /// One row an event between two poses: contacts gained and lost, ligaments taut and slack, limit points.
  const Table& events() const;
  /// With RunOptions::error_bars: poses().columns(), each number's uncertainty.
  const std::optional<Table>& error_bars() const;

  std::size_t rows() const { return poses().rows(); }
  /// Table::numbers() of poses().
  std::span<const double> operator[](const std::string& column) const { return poses().numbers(column); }
  /// rows() x free coordinates (Scene::coordinates()), row by row, rad and m: what Scene::residual() takes. NaN where a
  /// pose was not found.
  std::vector<double> coordinates() const;

  /// "solved"; "doubtful": solved, with jumps or doubts; "not_solved": not every pose; "evaluated": poses were given.
  const std::string& verdict() const;
  const std::vector<std::string>& sentences() const;  ///< why, for people
  bool partial() const;                               ///< stopped before its end
  int asked() const;                                  ///< poses
  int solved() const;                                 ///< poses
  const std::string& title() const;                   ///< of the scene
  const std::vector<std::string>& changes() const;    ///< what was changed in the scene since it was read
  std::string summary_json() const;                   ///< summary.json of the program

  /// Writes report.html, the page that shows the joint in a browser, with everything in one file. Throws SceneError
  /// where it cannot be written, or for given poses.
  void report(const std::string& file) const;

  struct Inside;
  explicit Results(std::shared_ptr<const Inside> inside) : inside_(std::move(inside)) {}

 private:
  std::shared_ptr<const Inside> inside_;
};

/// Derivatives of results to numbers of the scene.
struct Sensitivity {
  Results results;                        ///< of the run
  std::vector<std::string> of, of_units;  ///< columns of results
  std::vector<std::string> to, to_units;  ///< numbers of the scene
  /// results.rows() x of.size() x to.size(), the last index fastest: per unit of the number; NaN where a pose has none.
  std::vector<double> derivatives;
  /// The same for a standard change of each number, so that numbers of different kinds can be ranked.
  std::vector<double> effects;
  std::vector<std::string> changes;  ///< the standard change of each number: "1 %", "1 mm"
};

/// What `genu laxity` tests: at each flexion angle the neutral pose, then each load up, down and back.
struct LaxityOptions {
  std::vector<double> at = {0, 30, 60, 90};         ///< deg, of the joint's first rotation
  double anterior = 134, varus = 10, internal = 5;  ///< N, N m, N m, both ways; 0: no such test
  double compression = 0;                           ///< N along the tibia's long axis, in all poses
  int increments = 10;                              ///< from 0 to the full load
  std::function<bool()> cancelled{};                ///< as RunOptions::cancelled
};

struct Laxity {
  Table poses;                         ///< laxity.csv: one row a pose
  Table summary;                       ///< laxity_summary.csv: one row a curve
  bool complete = false;               ///< every curve reaches its full load both ways
  std::vector<std::string> sentences;  ///< what is missing, and why
  std::string text;                    ///< the tables that the program prints
};

}  // namespace genu::api
