// What genu and the programs of tools/peers/programs tell each other through files: the knee, and the poses found.
// Lines of words and numbers of 17 digits, in m, N, rad and s. Standard C++ alone, so that both sides share it.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace genu::peers {

using Point = std::array<double, 3>;

/// From a point of the femur to one of the tibia, each in its body: F = K e^2 with e = (L - L0) / L0 > 0, else 0.
struct Spring {
  Point femur{}, tibia{};
  double stiffness = 0;     ///< K, N
  double slack_length = 0;  ///< L0, m
};

/// A condyle's mesh on a plane of the tibia.
struct ContactPair {
  std::string mesh;  ///< name of the STL file, mm, in the femur
  Point origin{}, normal{};
};

/// Rotations x, y, z, each about the femur's axis that the last one left, then its origin: both in the tibia's axes.
using Coordinates = std::array<double, 6>;

/// The tibia is fixed, the femur free but for its flexion, the first coordinate.
struct Knee {
  Coordinates start{};           ///< the reference pose
  double length = 0;             ///< m: by it moments are compared with forces
  std::vector<double> flexions;  ///< rad, pose after pose
  std::vector<Spring> springs;
  std::vector<ContactPair> pairs;
};

struct FoundPose {
  Coordinates coordinates{};
  std::array<double, 6> contact{};  ///< on the femur: force, and moment about its origin, in the tibia's axes
  bool settled = false;             ///< whether the program says that it arrived
};

struct FoundPath {
  double seconds = 0;  ///< of processor time, for all poses
  std::vector<FoundPose> poses;
};

/// Empty, or what went wrong.
std::string write_knee(const Knee& knee, const std::string& path);
std::string read_knee(const std::string& path, Knee& knee);
std::string write_path(const FoundPath& found, const std::string& path);
std::string read_path(const std::string& path, FoundPath& found);

/// Seconds of processor time that this program has taken.
double processor_seconds();

}  // namespace genu::peers
