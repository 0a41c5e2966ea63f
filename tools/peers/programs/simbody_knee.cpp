// simbody_knee KNEE STIFFNESS OUT: the knee's poses by Simbody. Each triangle of a condyle is a spring that pushes
// out of the plane (ElasticFoundationForce, STIFFNESS in N/mm3), and LocalEnergyMinimizer goes to the least energy.
//   1. lengths in units of the knee's own, so that moments and forces are of one size in the gradient
//   2. a body with five coordinates; flexion is a function that is set from outside
//   3. pose after pose, each from the one before it
#include <cstdio>
#include <cstdlib>
#include <exception>

#include <Simbody.h>

#include "../exchange.h"
#include "solver.h"

namespace genu::peers {
namespace {

using SimTK::Real;
using SimTK::Vec3;

// Of what a coordinate counts in: tenths of the knee's length and of a radian, for a minimizer whose first step is 1.
constexpr double kStep = 0.1;
constexpr double kTolerance = 1e-4;  // N * kStep, of the gradient
constexpr double kCoarse = 100;      // how much more where that is not reached at once

Vec3 vector(const Point& p, double unit) { return Vec3(p[0], p[1], p[2]) / unit; }

/// The springs of a knee between the femur and the ground.
class Springs : public SimTK::Force::Custom::Implementation {
 public:
  Springs(const Knee& knee, const SimTK::MobilizedBody& femur) : knee_(knee), femur_(femur) {}

  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& bodies, SimTK::Vector_<Vec3>&,
                 SimTK::Vector&) const override {
    for (const Spring& s : knee_.springs) {
      const Vec3 at = vector(s.femur, knee_.length), line = to_tibia(state, s);
      const Real length = line.norm();
      femur_.applyForceToBodyPoint(state, at, evaluate(s, length * knee_.length).force * line / length, bodies);
    }
  }

  Real calcPotentialEnergy(const SimTK::State& state) const override {
    Real sum = 0;
    for (const Spring& s : knee_.springs) sum += evaluate(s, to_tibia(state, s).norm() * knee_.length).energy;
    return sum / knee_.length;
  }

 private:
  Vec3 to_tibia(const SimTK::State& state, const Spring& s) const {
    return vector(s.tibia, knee_.length) - femur_.findStationLocationInGround(state, vector(s.femur, knee_.length));
  }

  const Knee& knee_;
  const SimTK::MobilizedBody& femur_;
};

/// What it was set to, whatever its argument. It has one because FunctionBased leaves out the turn of a function
/// without.
class Setting : public SimTK::Function {
 public:
  explicit Setting(const Real& value) : value_(value) {}
  Real calcValue(const SimTK::Vector&) const override { return value_; }
  Real calcDerivative(const SimTK::Array_<int>&, const SimTK::Vector&) const override { return 0; }
  int getArgumentSize() const override { return 1; }
  int getMaxDerivativeOrder() const override { return 2; }

 private:
  const Real& value_;
};

class SimbodyKnee {
 public:
  SimbodyKnee(const Knee& knee, const std::string& folder, double stiffness)
      : knee_(knee), matter_(system_), forces_(system_), contacts_(system_), flexion_(knee.start[0]) {
    SimTK::Array_<const SimTK::Function*> functions{new Setting(flexion_)};
    SimTK::Array_<SimTK::Array_<int>> arguments(1, SimTK::Array_<int>(1, 0));
    for (int i = 0; i < 5; ++i) {
      functions.push_back(new SimTK::Function::Linear(SimTK::Vector(SimTK::Vec2(kStep, 0))));
      arguments.push_back(SimTK::Array_<int>(1, i));
    }
    const SimTK::Body::Rigid body(SimTK::MassProperties(1, Vec3(0), SimTK::Inertia(1)));
    femur_ = SimTK::MobilizedBody::FunctionBased(matter_.Ground(), body, 5, functions, arguments);
    SimTK::Force::Custom(forces_, new Springs(knee, femur_));
    for (const ContactPair& pair : knee.pairs) add_pair(pair, folder, stiffness);
    state_ = system_.realizeTopology();
    for (int i = 0; i < 5; ++i) state_.updQ()[i] = knee.start[i + 1] / unit(i);
  }

  bool go_to(double flexion) {
    flexion_ = flexion;
    state_.updQ();  // what was realized is not of this flexion
    return minimize(kTolerance) || (minimize(kCoarse * kTolerance) && minimize(kTolerance));
  }

  void tell(FoundPose& found) {
    system_.realize(state_, SimTK::Stage::Dynamics);
    found.coordinates[0] = flexion_;
    for (int i = 0; i < 5; ++i) found.coordinates[i + 1] = state_.getQ()[i] * unit(i);
    for (const SimTK::Force& layer : layers_) {
      SimTK::Vector_<SimTK::SpatialVec> bodies;
      SimTK::Vector_<Vec3> particles;
      SimTK::Vector mobilities;
      layer.calcForceContribution(state_, bodies, particles, mobilities);
      const SimTK::SpatialVec on_femur = bodies[femur_.getMobilizedBodyIndex()];
      for (int i = 0; i < 3; ++i) {
        found.contact[i] += on_femur[1][i];
        found.contact[i + 3] += on_femur[0][i] * knee_.length;
      }
    }
  }

 private:
  /// Of a coordinate, rad or m: the two rotations, then the translations.
  double unit(int i) const { return kStep * (i < 2 ? 1 : knee_.length); }

  void add_pair(const ContactPair& pair, const std::string& folder, double stiffness) {
    SimTK::PolygonalMesh mesh;
    mesh.loadStlFile(folder + "/" + pair.mesh);
    mesh.scaleMesh(1e-3 / knee_.length);
    const SimTK::ContactSetIndex set = contacts_.createContactSet();
    const SimTK::Rotation inward(-SimTK::UnitVec3(vector(pair.normal, 1)), SimTK::XAxis);
    contacts_.addBody(set, matter_.Ground(), SimTK::ContactGeometry::HalfSpace(),
                      SimTK::Transform(inward, vector(pair.origin, knee_.length)));
    contacts_.addBody(set, femur_, SimTK::ContactGeometry::TriangleMesh(mesh), SimTK::Transform());
    SimTK::ElasticFoundationForce layer(forces_, contacts_, set);
    const double unit = knee_.length;
    layer.setBodyParameters(SimTK::ContactSurfaceIndex(1), stiffness * unit * unit * unit, 0, 0, 0, 0);
    layers_.push_back(layer);
  }

  /// Where it throws, the state stays.
  bool minimize(double tolerance) {
    try {
      SimTK::LocalEnergyMinimizer::minimizeEnergy(system_, state_, tolerance);
    } catch (const std::exception&) {
      return false;
    }
    return true;
  }

  const Knee& knee_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  SimTK::GeneralContactSubsystem contacts_;
  Real flexion_;
  SimTK::MobilizedBody femur_;
  std::vector<SimTK::Force> layers_;
  SimTK::State state_;
};

}  // namespace
}  // namespace genu::peers

int main(int argc, char** argv) {
  using namespace genu::peers;
  if (argc != 4) return std::fputs("simbody_knee KNEE STIFFNESS OUT\n", stderr), 2;
  constexpr double kPerCubicMillimetre = 1e9;  // N/m3
  Knee knee;
  std::string error = read_knee(argv[1], knee);
  if (error.empty()) {
    SimbodyKnee simbody(knee, folder_of(argv[1]), kPerCubicMillimetre * std::atof(argv[2]));
    error = write_path(follow(knee, simbody), argv[3]);
  }
  if (!error.empty()) std::fprintf(stderr, "simbody_knee: %s\n", error.c_str());
  return error.empty() ? 0 : 1;
}
