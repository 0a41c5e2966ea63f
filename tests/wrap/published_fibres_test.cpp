// The fibres of Lenhart et al. (2015) that wrap, at the 251 poses of a published passive flexion: their lengths against
// the shortest ones, computed independently, and against those that OpenSim-JAM published (sums over polygons).
#include <gtest/gtest.h>

#include "genu/core/units.h"
#include "genu/surface/analytic.h"
#include "genu/wrap/chain.h"
#include "support/data.h"
#include "support/published_knee.h"

namespace genu {
namespace {

using nlohmann::json;

Vec3 vector_of(const json& j) { return Vec3(j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()); }

double number_of(const json& j) { return j.is_string() ? std::stod(j.get<std::string>()) : j.get<double>(); }

Mat3 turned(double x, double y, double z) {
  return (Eigen::AngleAxisd(x, Vec3::UnitX()) * Eigen::AngleAxisd(y, Vec3::UnitY()) *
          Eigen::AngleAxisd(z, Vec3::UnitZ()))
      .toRotationMatrix();
}

/// The surfaces of the published model, in the frames of their bodies.
struct Wraps {
  std::map<std::string, std::shared_ptr<const Surface>> surface;
  std::map<std::string, std::string> body;

  explicit Wraps(const json& all) {
    for (const auto& [name, w] : all.items()) {
      if (!w.contains("xyz_body_rotation")) continue;
      const Vec3 r = vector_of(w.at("xyz_body_rotation"));
      const Pose X{turned(r.x(), r.y(), r.z()), vector_of(w.at("translation"))};
      if (w.at("type") == "WrapCylinder")
        surface[name] = make_cylinder(X, number_of(w.at("radius")), false);
      else if (w.at("type") == "WrapEllipsoid")
        surface[name] = make_ellipsoid(X, vector_of(w.at("dimensions")), false);
      body[name] = w.at("body");
    }
  }
};

/// Pose of the tibia or patella (X anterior, Y up) in the femur at a row of the table.
Pose pose_of(const test::PublishedTable& table, std::size_t row, const std::string& body) {
  if (body == "femur_distal_r") return {};
  const bool tibia = body == "tibia_proximal_r";
  const std::string p = tibia ? "knee_" : "pf_";
  const auto value = [&](const char* of_tibia, const char* of_patella) {
    return table.at(row, p + (tibia ? of_tibia : of_patella));
  };
  const double flex = value("flex_r", "flex_r"), add = value("add_r", "rot_r"), rot = value("rot_r", "tilt_r");
  const Mat3 R = (Eigen::AngleAxisd(-flex, Vec3::UnitZ()) * Eigen::AngleAxisd(add, Vec3::UnitX()) *
                  Eigen::AngleAxisd(rot, Vec3::UnitY()))
                     .toRotationMatrix();
  return {R, Vec3(value("tx_r", "tx_r"), value("ty_r", "ty_r"), value("tz_r", "tz_r"))};
}

TEST(PublishedFibres, LengthsAreTheShortestOnes) {
  GENU_NEEDS_DATA("lenhart2015/wrapped_fibres_passive_flexion.csv");
  const json model = json::parse(test::read_text(test::data_path("lenhart2015/lenhart_ligaments.json")));
  const Wraps wraps(model.at("wraps"));
  const test::PublishedTable poses("lenhart_passive_flexion.csv");
  std::map<std::string, json> ligaments;
  for (const json& l : model.at("ligaments")) ligaments[l.at("name")] = l;
  std::istringstream rows(test::read_text(test::data_path("lenhart2015/wrapped_fibres_passive_flexion.csv")));
  std::string line;
  std::getline(rows, line);
  std::map<std::string, std::vector<Touch>> touches;
  double worst = 0, published_worst = 0;
  int count = 0, touching = 0, wrong = 0;
  while (std::getline(rows, line)) {
    std::istringstream cells(line);
    std::string frame, fibre, state, straight, shortest, published;
    for (std::string* cell : {&frame, &fibre, &state, &straight, &shortest, &published})
      std::getline(cells, *cell, ',');
    const json& l = ligaments.at(fibre);
    const std::string name = l.at("wraps").at(0).at("wrap_object");
    const std::size_t row = std::stoul(frame);
    const Vec3 from = pose_of(poses, row, l.at("bodyA")) * vector_of(l.at("pA"));
    const Vec3 to = pose_of(poses, row, l.at("bodyB")) * vector_of(l.at("pB"));
    const Obstacle obstacle{wraps.surface.at(name).get(), pose_of(poses, row, wraps.body.at(name))};
    const Pose inverse = obstacle.X_W.inverse();
    const bool inside =
        obstacle.surface->gap(inverse * from).value_or(1) < 0 || obstacle.surface->gap(inverse * to).value_or(1) < 0;
    double along = 0;
    const double clearance = line_clearance(*obstacle.surface, inverse * from, inverse * to, along);
    auto& touch = touches[fibre];
    if (touch.empty()) {
      const WrapSide side;
      const auto found =
          inside ? std::optional(std::vector<Touch>(1)) : first_string(from, to, {&obstacle, 1}, {&side, 1});
      ASSERT_TRUE(found) << line;
      touch = *found;
    } else if (!inside) {
      ASSERT_TRUE(settle_touches(from, to, {&obstacle, 1}, touch)) << line;
    }
    const double length = to::kMillimetre * length_of(from, to, {&obstacle, 1}, touch);
    worst = std::max(worst, std::abs(length - std::stod(shortest)));
    published_worst = std::max(published_worst, std::abs(length - std::stod(published)));
    EXPECT_NEAR(length, std::stod(shortest), 1e-5) << line;
    EXPECT_NEAR(length, std::stod(published), 0.005) << line;
    if (std::abs(clearance) > 1e-5 && !inside) {
      wrong += touch[0].touching != (state == "wrap");
    }
    touching += touch[0].touching;
    ++count;
  }
  EXPECT_EQ(wrong, 0);
  std::cout << count << " lengths, " << touching << " wrapped: worst " << worst << " mm from the shortest, "
            << published_worst << " mm from the published\n";
  EXPECT_EQ(count, 19 * 251);
}

}  // namespace
}  // namespace genu
