// mujoco_knee KNEE TIMECONST IMPEDANCE OUT: the knee's poses by MuJoCo. Each condyle is the convex hull of its mesh on
// a plane, without friction; its softness is solref's time constant (s) and solimp's impedance. Springs are passive
// forces (mjcb_passive), and damping brings the femur to rest.
//   1. a body with five joints; its frame in the world holds flexion
//   2. pose after pose, each from the one before it, until what is unbalanced is small
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <sstream>

#include <mujoco/mujoco.h>

#include "../exchange.h"
#include "solver.h"

namespace genu::peers {
namespace {

// Mass, step and damping change the way to rest, and the pose only through solref and solimp, which are relative to the
// mass. Steps twice as long do not settle with the stiffest contact; the slowest mode is damped about critically.
constexpr double kMass = 1;       // kg
constexpr double kStep = 4e-3;    // s
constexpr double kDamping = 70;   // 1/s, of mass and inertia
constexpr double kAtRest = 1e-2;  // N
constexpr int kMostSteps = 2000;  // 50 to 100 are usual

std::string triple(const Point& p) {
  std::ostringstream out;
  out.precision(17);
  out << p[0] << ' ' << p[1] << ' ' << p[2];
  return out.str();
}

std::string joints(const Knee& knee) {
  const double damping = kMass * kDamping, turning = damping * knee.length * knee.length;
  std::ostringstream out;
  for (const char* axis : {"1 0 0", "0 1 0", "0 0 1"})
    out << "<joint type='slide' axis='" << axis << "' damping='" << damping << "'/>";
  for (const char* axis : {"0 1 0", "0 0 1"})
    out << "<joint type='hinge' axis='" << axis << "' damping='" << turning << "'/>";
  return out.str();
}

/// The model's file.
std::string describe(const Knee& knee, const std::string& folder, const std::string& timeconst,
                     const std::string& impedance) {
  std::ostringstream meshes, planes, condyles, pairs;
  for (std::size_t k = 0; k < knee.pairs.size(); ++k) {
    const ContactPair& p = knee.pairs[k];
    meshes << "<mesh name='m" << k << "' file='" << folder << "/" << p.mesh << "' scale='1e-3 1e-3 1e-3'/>";
    planes << "<geom name='p" << k << "' type='plane' size='0 0 1' pos='" << triple(p.origin) << "' zaxis='"
           << triple(p.normal) << "' contype='0' conaffinity='0'/>";
    condyles << "<geom name='c" << k << "' type='mesh' mesh='m" << k << "' contype='0' conaffinity='0'/>";
    pairs << "<pair geom1='p" << k << "' geom2='c" << k << "' condim='1' solref='" << timeconst << " 1' solimp='"
          << impedance << " " << impedance << " 0.001'/>";
  }
  const double inertia = kMass * knee.length * knee.length;
  std::ostringstream out;
  out << "<mujoco><option gravity='0 0 0' timestep='" << kStep << "'/><asset>" << meshes.str() << "</asset><worldbody>"
      << planes.str() << "<body name='femur'><inertial pos='0 0 0' mass='" << kMass << "' diaginertia='" << inertia
      << " " << inertia << " " << inertia << "'/>" << joints(knee) << condyles.str() << "</body></worldbody><contact>"
      << pairs.str() << "</contact></mujoco>";
  return out.str();
}

const Knee* the_knee = nullptr;  // for the callback
mjtNum pull[5];                  // of the springs, on the joints

void add_springs(const mjModel* m, mjData* d) {
  mju_zero(pull, 5);
  const mjtNum no_torque[3] = {0, 0, 0};
  for (const Spring& s : the_knee->springs) {
    mjtNum at[3], force[3];
    mju_rotVecMat(at, s.femur.data(), d->xmat + 9);
    mju_addTo3(at, d->xpos + 3);
    mju_sub3(force, s.tibia.data(), at);
    const mjtNum length = mju_norm3(force);
    mju_scl3(force, force, evaluate(s, length).force / length);
    mj_applyFT(m, d, force, no_torque, at, 1, pull);
  }
  mju_addTo(d->qfrc_passive, pull, 5);
}

struct Freed {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
  void operator()(mjData* d) const { mj_deleteData(d); }
};

class MujocoKnee {
 public:
  MujocoKnee(const Knee& knee, mjModel* model) : knee_(knee), model_(model), data_(mj_makeData(model)) {
    for (int i = 0; i < 3; ++i) position_[i] = knee.start[i + 3];
    for (int i = 0; i < 2; ++i) data_->qpos[i + 3] = knee.start[i + 1];
  }

  bool go_to(double flexion) {
    flexion_ = flexion;
    const mjtNum x[3] = {1, 0, 0};
    mju_copy3(model_->body_pos + 3, position_);
    mju_axisAngle2Quat(model_->body_quat + 4, x, flexion);
    mju_zero3(data_->qpos);
    mju_zero(data_->qvel, 5);
    bool settled = false;
    for (int step = 0; step < kMostSteps && !settled; ++step) {
      mj_step(model_.get(), data_.get());
      settled = at_rest();
    }
    mj_forward(model_.get(), data_.get());
    mju_copy3(position_, data_->xpos + 3);
    return settled;
  }

  void tell(FoundPose& found) const {
    found.coordinates = {flexion_, data_->qpos[3], data_->qpos[4], position_[0], position_[1], position_[2]};
    for (int i = 0; i < data_->ncon; ++i) {
      const mjContact& contact = data_->contact[i];
      mjtNum result[6], force[3], arm[3], moment[3];
      mj_contactForce(model_.get(), data_.get(), i, result);
      mju_scl3(force, contact.frame, result[0]);
      mju_sub3(arm, contact.pos, position_);
      mju_cross(moment, arm, force);
      for (int k = 0; k < 3; ++k) {
        found.contact[k] += force[k];
        found.contact[k + 3] += moment[k];
      }
    }
  }

 private:
  /// Springs and contacts, and what damping takes, are each smaller than kAtRest.
  bool at_rest() const {
    double unbalanced = 0, damping = 0;
    for (int i = 0; i < 5; ++i) {
      const double lever = i < 3 ? 1 : knee_.length;
      unbalanced = std::hypot(unbalanced, (pull[i] + data_->qfrc_constraint[i]) / lever);
      damping = std::hypot(damping, kMass * kDamping * data_->qvel[i] * lever);
    }
    return std::fmax(unbalanced, damping) < kAtRest;
  }

  const Knee& knee_;
  std::unique_ptr<mjModel, Freed> model_;
  std::unique_ptr<mjData, Freed> data_;
  double flexion_ = 0;
  mjtNum position_[3];
};

mjModel* load(const Knee& knee, const std::string& folder, char** softness, std::string& error) {
  const std::string text = describe(knee, folder, softness[0], softness[1]);
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  const int size = static_cast<int>(text.size());
  mj_makeEmptyFileVFS(files.get(), "knee.xml", size);
  std::copy(text.begin(), text.end(), static_cast<char*>(files->filedata[mj_findFileVFS(files.get(), "knee.xml")]));
  char why[1000] = "";
  mjModel* model = mj_loadXML("knee.xml", files.get(), why, sizeof why);
  mj_deleteVFS(files.get());
  if (model == nullptr) error = why;
  return model;
}

}  // namespace
}  // namespace genu::peers

int main(int argc, char** argv) {
  using namespace genu::peers;
  if (argc != 5) return std::fputs("mujoco_knee KNEE TIMECONST IMPEDANCE OUT\n", stderr), 2;
  Knee knee;
  std::string error = read_knee(argv[1], knee);
  mjModel* model = error.empty() ? load(knee, folder_of(argv[1]), argv + 2, error) : nullptr;
  if (model != nullptr) {
    the_knee = &knee;
    mjcb_passive = add_springs;
    MujocoKnee mujoco(knee, model);
    error = write_path(follow(knee, mujoco), argv[4]);
  }
  if (!error.empty()) std::fprintf(stderr, "mujoco_knee: %s\n", error.c_str());
  return error.empty() ? 0 : 1;
}
