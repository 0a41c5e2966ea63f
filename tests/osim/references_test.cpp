#include "genu/osim/references.h"

#include <gtest/gtest.h>

#include "osim/osim_support.h"

namespace genu::test {
namespace {

TEST(References, AreErrorsWhereNothingHasTheName) {
  const struct {
    const char *from, *to, *after, *words;
  } lost[] = {
      {"<socket_child_frame>/bodyset/tibia_r", "<socket_child_frame>/bodyset/fibula_r", "",
       "CustomJoint knee_r = /bodyset/fibula_r: is no frame or body of the model"},
      {"<socket_parent>..", "<socket_parent>/bodyset/nowhere", "", "/bodyset/nowhere: is no frame or body"},
      {"<socket_parent>/bodyset/femur_r", "<socket_parent>../femur_offset", "name=\"femur_offset\"",
       "hangs on frames that lead to no body"},
      {"/jointset/knee_r/femur_offset", "/jointset/kneee_r/femur_offset", "",
       "did you mean \"/jointset/knee_r/femur_offset\"?"},
      {"<socket_parent_frame>/bodyset/foot_r", "<socket_parent_frame>/bodyset/toe", "gastrocnemius",
       "path point b = /bodyset/toe: is no frame"},
      {"<socket_frame>/bodyset/tibia_r/plateau_frame", "<socket_frame>/bodyset/tibia_r/plateau", "",
       "Smith2018ContactMesh plateau = /bodyset/tibia_r/plateau: is no frame"},
      {"<socket_coordinate>/jointset/knee_r/knee_flex_r", "<socket_coordinate>/jointset/knee_r/knee_flexx_r", "",
       "path point b = knee_flexx_r: is no coordinate of the model; did you mean \"knee_flex_r\"?"},
      {"<socket_coordinate>/jointset/knee_r/knee_flex_r</socket_coordinate>", "", "", "names no coordinate"},
      {"<coordinate>knee_add_r", "<coordinate>knee_bend_r", "", "knee_bend_r: is no coordinate of the model"},
      {"<dependent_coordinate_name>ankle_angle_r", "<dependent_coordinate_name>toe_angle_r", "", "toe_angle_r: is no"},
      {"/contactgeometryset/condyle", "/contactgeometryset/trochlea", "", "trochlea: is no Smith2018ContactMesh"},
  };
  for (const auto& one : lost) {
    const std::string message = refusal_of(leg_with(one.from, one.to, one.after));
    EXPECT_TRUE(contains(message, one.words)) << one.to << ": " << message;
  }
}

TEST(References, AreListedAllAtOnce) {
  std::string text = leg_with("<coordinate>knee_add_r", "<coordinate>knee_bend_r");
  text.replace(text.find("/bodyset/foot_r</socket_parent_frame>"), 15, "/bodyset/toe");
  Diagnostics out;
  EXPECT_FALSE(osim::parse_model(text, "leg.osim", out).has_value());
  EXPECT_EQ(out.items().size(), 2u);
}

TEST(References, SpringsNameTheirCoordinateBySocketToo) {
  const osim::Model model = model_of(leg_with("<coordinate>knee_add_r</coordinate>",
                                              "<socket_coordinate>/jointset/knee_r/knee_add_r</socket_coordinate>"));
  EXPECT_EQ(model.springs[0].coordinate, "knee_add_r");
}

TEST(References, CouplersDriveACoordinateOnceAndNeverThemselves) {
  const auto with = [](const std::string& couplers) {
    return leg_with("</objects>\n    </ConstraintSet>", couplers + "</objects></ConstraintSet>");
  };
  EXPECT_TRUE(
      contains(refusal_of(with(leg_coupler("pelvis_rx", "ankle_angle_r"))), "is driven by ankle_follows_hip too"));
  EXPECT_TRUE(contains(refusal_of(with(leg_coupler("pelvis_rx", "pelvis_rx"))), "pelvis_rx: drives itself"));
  EXPECT_TRUE(
      contains(refusal_of(with(leg_coupler("ankle_angle_r", "pelvis_rx") + leg_coupler("pelvis_rx", "hip_flex_r"))),
               "drives itself, through the couplers"));
}

}  // namespace
}  // namespace genu::test
