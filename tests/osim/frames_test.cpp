#include "genu/osim/frames.h"

#include <gtest/gtest.h>

#include "osim/osim_support.h"

namespace genu::test {
namespace {

using osim::find_frame;
using osim::frame_path;

constexpr int kFemur = 1, kTibia = 2, kGroundBody = 4;

/// Where the origin of a frame is, and in which body: {-1} for none.
std::pair<int, Vec3> origin(const osim::Model& model, const std::string& path) {
  const auto placed = find_frame(model, path);
  return placed ? std::pair(placed->body, placed->X_body_frame.p) : std::pair(-1, Vec3(Vec3::Zero()));
}

TEST(Frames, ArePlacesInBodies) {
  const osim::Model model = leg();
  EXPECT_EQ(origin(model, "/bodyset/tibia_r"), std::pair(kTibia, Vec3(0, 0, 0)));
  EXPECT_EQ(origin(model, "/bodyset/tibia_r/plateau_frame"), std::pair(kTibia, Vec3(0, -0.031, 0)));
  EXPECT_EQ(origin(model, "/jointset/knee_r/femur_offset"), std::pair(kFemur, Vec3(0, -0.4, 0)));
  EXPECT_EQ(origin(model, "/ground").first, kGroundBody);
}

TEST(Frames, AreFoundByTheirWholePath) {
  const osim::Model model = leg();
  for (const char* path : {"/jointset/kneee_r/femur_offset", "/bodyset/femur_offset", "/bodyset/femur_r/plateau_frame",
                           "/plateau_frame", "femur_offset", "tibia_r", "/bodyset/", "/", "", "/jointset/knee_r"})
    EXPECT_FALSE(find_frame(model, path).has_value()) << path;
}

TEST(Frames, SocketsStartFromTheirOwner) {
  const osim::Model model = leg();
  const std::string knee = "/jointset/knee_r";
  EXPECT_EQ(frame_path(model, "/bodyset/tibia_r", knee), "/bodyset/tibia_r");
  EXPECT_EQ(frame_path(model, "femur_offset", knee), "/jointset/knee_r/femur_offset");
  EXPECT_EQ(frame_path(model, "../hip_r/pelvis_offset", knee), "/jointset/hip_r/pelvis_offset");
  EXPECT_EQ(frame_path(model, "../../bodyset/tibia_r", knee), "/bodyset/tibia_r");
  EXPECT_EQ(frame_path(model, "..", "/bodyset/tibia_r/plateau_frame"), "/bodyset/tibia_r");
  EXPECT_EQ(frame_path(model, "./femur_offset", knee), "/jointset/knee_r/femur_offset");
  EXPECT_EQ(frame_path(model, "../../../../..", knee), "");
  EXPECT_EQ(frame_path(model, "ground", knee), "/ground");
  EXPECT_EQ(frame_path(model, "tibia_r", knee), "/bodyset/tibia_r");
  EXPECT_EQ(frame_path(model, "pelvis_offset", knee), "/bodyset/pelvis_offset");  // of another joint: there is none
}

/// Two bodies each have a frame of one name.
TEST(Frames, OfOneNameAreToldApart) {
  const osim::Model model = model_of(
      leg_with("<Body name=\"femur_r\">",
               "<Body name=\"femur_r\"><components><PhysicalOffsetFrame name=\"plateau_frame\"><socket_parent>.."
               "</socket_parent><translation>0 -0.4 0</translation></PhysicalOffsetFrame></components>"));
  EXPECT_EQ(origin(model, "/bodyset/femur_r/plateau_frame"), std::pair(kFemur, Vec3(0, -0.4, 0)));
  EXPECT_EQ(origin(model, "/bodyset/tibia_r/plateau_frame"), std::pair(kTibia, Vec3(0, -0.031, 0)));
  EXPECT_EQ(origin(model, model.contact_meshes[1].frame), std::pair(kTibia, Vec3(0, -0.031, 0)));
}

/// A frame on a frame, and a wrap object on that.
TEST(Frames, HangOnOtherFrames) {
  const osim::Model model = model_of(leg_with(
      "<frames>",
      "<frames><PhysicalOffsetFrame name=\"b\"><socket_parent>../femur_offset</socket_parent><translation>0 0 0.01"
      "</translation><WrapObjectSet><objects><WrapSphere name=\"ball\"><radius>0.01</radius></WrapSphere></objects>"
      "</WrapObjectSet></PhysicalOffsetFrame>",
      "CustomJoint name=\"knee_r\""));
  EXPECT_EQ(model.wraps.back().frame, "/jointset/knee_r/b");
  EXPECT_EQ(origin(model, model.wraps.back().frame), std::pair(kFemur, Vec3(0, -0.4, 0.01)));
}

}  // namespace
}  // namespace genu::test
