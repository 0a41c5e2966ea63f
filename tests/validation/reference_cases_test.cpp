// Small problems whose answers are known to twenty digits, every entry of them.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "case_scene.h"
#include "genu/core/units.h"
#include "genu/study/run_scene.h"
#include "support/data.h"
#include "support/judged.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

using test::CaseScene;
using test::Json;
using test::number;
using test::numbers;

constexpr double kReferenceTolerance = 1e-9;  // of max(1, |value|) in mm, deg, N, N mm

std::filesystem::path cases_folder() { return test::data_path("../reference/cases"); }

/// The files of all cases; one that does not exist where there are none, so that a test says that it was skipped.
std::vector<std::string> case_files() {
  std::vector<std::string> files;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(cases_folder(), none))
    if (entry.path().extension() == ".json") files.push_back(entry.path().stem().string());
  std::sort(files.begin(), files.end());
  if (files.empty()) files.push_back("none");
  return files;
}

/// A case as solved: what was asked for and what came out.
class SolvedCase {
 public:
  SolvedCase(const Json& scene, const std::string& steps) : scene_(scene) {
    const std::string file = folder_.write("scene.toml", CaseScene(scene).text(steps));
    Diagnostics problems;
    prepared_ = prepare(file, problems);
    for (const Diagnostic& d : problems.items()) ADD_FAILURE() << to_string(d);
    if (!prepared_) return;
    ContactField field(prepared_->model);
    solution_ = test::judged(*prepared_, solve(*prepared_, field, {}));
  }

  bool good() const { return prepared_.has_value() && !solution_.records.empty(); }
  const Solution& solution() const { return solution_; }
  const ResultTable& table() const { return solution_.poses; }
  const PosePoint& last() const { return solution_.records.back().point; }
  std::size_t last_row() const { return table().rows() - 1; }

  /// The contacts that carry load under the names of the case. Several between the same two surfaces are told apart by
  /// where they are expected.
  std::map<std::string, ActiveContact> contacts(const Json& expected) const {
    std::map<std::string, ActiveContact> out;
    for (const auto& [pair, names] : CaseScene(scene_).pairs()) {
      std::set<std::string> free(names.begin(), names.end());
      for (const ActiveContact& c : last().pose.state.contacts) {
        if (prepared_->model.pairs[static_cast<std::size_t>(c.pair)].name != CaseScene::pair_name(pair)) continue;
        const std::string name = nearest(free, expected, c);
        out[name] = c;
        free.erase(name);
      }
    }
    return out;
  }

 private:
  static std::string nearest(const std::set<std::string>& names, const Json& expected, const ActiveContact& c) {
    std::string best = "more than expected";
    double least = 1e300;
    for (const std::string& name : names) {
      double distance = 0;
      if (expected.contains("point_fixed") && expected.at("point_fixed").contains(name)) {
        const auto p = numbers(expected.at("point_fixed").at(name));
        distance = (Vec3(p[0], p[1], p[2]) * units::kMillimetre - c.geometry.a.p).norm();
      }
      if (distance < least) least = distance, best = name;
    }
    return best;
  }

  const Json& scene_;
  test::TemporaryFolder folder_;
  std::optional<Prepared> prepared_;
  Solution solution_;
};

class ReferenceCase : public testing::TestWithParam<std::string> {
 protected:
  void compare(const std::string& what, double found, const Json& expected, double tolerance = kReferenceTolerance) {
    const double value = number(expected);
    const double error = std::abs(found - value) / std::max(1.0, std::abs(value));
    EXPECT_LE(error, tolerance) << what << ": " << fmt::format("{:.17g} for {:.17g}", found, value);
    if (!(error <= worst_)) worst_ = error, worst_what_ = what;
    ++compared_;
  }

  void compare(const std::string& what, const Vec3& found, const Json& expected) {
    for (std::size_t i = 0; i < 3; ++i)
      compare(fmt::format("{} {}", what, "xyz"[i]), found[static_cast<Eigen::Index>(i)] / units::kMillimetre,
              expected[i]);
  }

  void compare_pose(const SolvedCase& solved, const Json& expected) {
    constexpr const char* kColumns[] = {"j.tx_mm",       "j.ty_mm",         "j.tz_mm",
                                        "j.flexion_deg", "j.adduction_deg", "j.rotation_deg"};
    for (std::size_t i = 0; i < 6; ++i)
      compare(kColumns[i], solved.table().number(solved.last_row(), kColumns[i]), expected[i]);
  }

  /// Multipliers are forces (N) and moments (N mm) that the constraints exert on the moving body, in their order.
  void compare_multipliers(const SolvedCase& solved, const Json& constraints, const Json& expected) {
    for (std::size_t m = 0; m < expected.size(); ++m) {
      const std::string coordinate = constraints.at(m).at("coord").get<std::string>();
      const bool angle = coordinate[0] != 't';
      const std::string column = "j." + coordinate + ".reaction_" + (angle ? "Nm" : "N");
      compare(column, (angle ? 1e3 : 1) * solved.table().number(solved.last_row(), column), expected[m]);
    }
  }

  void compare_contacts(const SolvedCase& solved, const Json& expected) {
    const auto contacts = solved.contacts(expected);
    EXPECT_FALSE(contacts.contains("more than expected"));
    std::set<std::string> active;
    for (const auto& [name, contact] : contacts) active.insert(name);
    if (expected.contains("active")) {
      EXPECT_EQ(active, expected.at("active").get<std::set<std::string>>());
      ++compared_;
    }
    if (expected.contains("contact_forces")) {
      EXPECT_EQ(active.size(), expected.at("contact_forces").size());
      for (const auto& [name, force] : expected.at("contact_forces").items()) {
        ASSERT_TRUE(contacts.contains(name)) << name << " is open";
        compare("force of " + name, contacts.at(name).force, force);
      }
    }
    for (const char* key : {"point_fixed", "point_moving"}) {
      if (!expected.contains(key)) continue;
      for (const auto& [name, point] : expected.at(key).items()) {
        ASSERT_TRUE(contacts.contains(name)) << name << " is open";
        const ContactGeometry& g = contacts.at(name).geometry;
        compare(std::string(key) + " of " + name, std::string(key) == "point_fixed" ? g.a.p : g.b.p, point);
      }
    }
  }

  void compare_springs(const SolvedCase& solved, const Json& expected) {
    for (const auto& [key, quantity] : {std::pair{"spring_lengths", ".length_mm"}, {"spring_forces", ".force_N"}}) {
      if (!expected.contains(key)) continue;
      for (const auto& [name, value] : expected.at(key).items())
        compare(name + quantity, solved.table().number(solved.last_row(), name + quantity), value);
    }
  }

  void solve_one_pose(const Json& json);
  void follow_to_limit_point(const Json& json);

  double worst_ = 0;
  std::string worst_what_ = "-";
  int compared_ = 0;
};

/// The point (mm, in its body) that surface coordinates mean: lengths on a plane, longitude and latitude (deg) on a
/// sphere, angle about the axis and angle round the tube (deg) on a torus. Empty for other shapes.
std::optional<Vec3> point_of(const Json& surface, double u, double v) {
  const std::string type = surface.at("type").get<std::string>();
  const double a = u * units::kDegree, b = v * units::kDegree;
  Vec3 local;
  if (type == "plane")
    local = Vec3(u, v, 0);
  else if (type == "sphere")
    local = number(surface.at("radius")) * Vec3(cos(b) * cos(a), cos(b) * sin(a), sin(b));
  else if (type == "torus") {
    const double R = number(surface.at("major")), r = number(surface.at("minor")), around = R + r * cos(b);
    local = Vec3(around * cos(a), around * sin(a), r * sin(b));
  } else
    return std::nullopt;
  Mat3 rows = Mat3::Identity();
  Vec3 origin = Vec3::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (surface.contains("origin")) origin[i] = number(surface.at("origin")[k]);
    for (Eigen::Index j = 0; j < 3 && surface.contains("axes"); ++j)
      rows(i, j) = number(surface.at("axes")[k][static_cast<std::size_t>(j)]);
  }
  return origin + rows.transpose() * local;
}

/// Surface coordinates (fixed u, v, moving u, v) as the points they mean, under the names of the other entries.
void spell_out_surface_coordinates(const Json& scene, Json& expected) {
  if (!expected.contains("surface_coordinates")) return;
  for (const auto& [name, values] : expected.at("surface_coordinates").items()) {
    const std::vector<double> uv = numbers(values);
    for (const Json& contact : scene.at("contacts")) {
      if (contact.at("name") != name) continue;
      for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
        const std::string body = side == 0 ? "fixed" : "moving";
        const auto p =
            point_of(scene.at("surfaces").at(contact.at(body).get<std::string>()), uv[2 * side], uv[2 * side + 1]);
        ASSERT_TRUE(p) << "surface coordinates of this shape are not known here";
        if (!expected["point_" + body].contains(name)) expected["point_" + body][name] = {p->x(), p->y(), p->z()};
      }
    }
  }
}

void ReferenceCase::solve_one_pose(const Json& json) {
  const Json& scene = json.at("scene");
  Json expected = json.at("expected");
  spell_out_surface_coordinates(scene, expected);
  static const std::set<std::string> known{"pose",        "contact_forces", "spring_lengths",      "spring_forces",
                                           "point_fixed", "point_moving",   "surface_coordinates", "multipliers",
                                           "active"};
  for (const auto& [key, value] : expected.items()) EXPECT_TRUE(known.contains(key)) << key << " is not compared";
  const SolvedCase solved(scene, "[[step]]\n" + CaseScene(scene).prescribed());
  ASSERT_TRUE(solved.good());
  ASSERT_EQ(solved.solution().summary.exit_code, kExitOk) << solved.last().report.why;
  if (expected.contains("pose")) compare_pose(solved, expected.at("pose"));
  compare_contacts(solved, expected);
  compare_springs(solved, expected);
  if (expected.contains("multipliers"))
    compare_multipliers(solved, scene.at("constraints"), expected.at("multipliers"));
}

void ReferenceCase::follow_to_limit_point(const Json& json) {
  const Json& scene = json.at("scene");
  const Json& expected = json.at("expected");
  const CaseScene text(scene);
  const std::string head = "[[step]]\n" + text.prescribed();
  const double critical = number(expected.at("critical_load"));

  // The branch under load control, one step a value.
  std::string steps = head + text.scaled_loads(0, 0);
  double from = 0;
  for (const Json& point : expected.at("branch")) {
    steps += head + text.scaled_loads(from, number(point.at("P")));
    from = number(point.at("P"));
  }
  const SolvedCase branch(scene, steps);
  ASSERT_TRUE(branch.good());
  ASSERT_EQ(branch.solution().summary.exit_code, kExitOk);
  for (std::size_t i = 0; i < expected.at("branch").size(); ++i)
    compare(fmt::format("z at P = {}", number(expected.at("branch")[i].at("P"))),
            branch.table().number(i + 2, "j.tz_mm"), expected.at("branch")[i].at("z"));

  // Beyond the critical load there is no equilibrium on this branch: the run stops there and says so, wherever the
  // increments fall. 12 of them put a pose on the limit point itself, up to rounding.
  for (const int increments : {1, 5, 7, 12, 100}) {
    SCOPED_TRACE(fmt::format("{} increments", increments));
    const double target = 1.2 * critical;
    const SolvedCase beyond(scene, head + text.scaled_loads(0, target) + fmt::format("increments = {}\n", increments));
    ASSERT_TRUE(beyond.good());
    EXPECT_EQ(beyond.solution().summary.exit_code, kExitIncomplete);
    const auto& events = beyond.solution().events;
    const auto turn = std::find_if(events.begin(), events.end(),
                                   [](const PathEvent& e) { return e.kind == PathEvent::Kind::turns_back; });
    EXPECT_NE(turn, events.end()) << "no event turns_back; z is "
                                  << beyond.table().number(beyond.last_row(), "j.tz_mm");
    if (turn != events.end()) compare("critical load", turn->t * target, expected.at("critical_load"), 1e-6);
    for (const PathEvent& e : events)
      fmt::print("  {}: {} at P = {:.9f}: {}\n", increments, to_string(e.kind), e.t * target, e.what);
  }

  // Towards the critical load z tends to its critical value like a polynomial in s = sqrt(1 - P / P_c).
  if (!expected.contains("critical_z")) return;
  constexpr double kFirst = 0.01;  // s of the nearest pose; the others at 2, 3 and 4 times that
  steps = head + text.scaled_loads(0, (1 - 16 * kFirst * kFirst) * critical);
  for (const int k : {3, 2, 1})
    steps += head + text.scaled_loads((1 - (k + 1) * (k + 1) * kFirst * kFirst) * critical,
                                      (1 - k * k * kFirst * kFirst) * critical);
  const SolvedCase near(scene, steps);
  ASSERT_EQ(near.solution().summary.exit_code, kExitOk);
  ASSERT_EQ(near.table().rows(), 5u);
  const auto z = [&](std::size_t k) { return near.table().number(5 - k, "j.tz_mm"); };
  compare("critical z", 4 * z(1) - 6 * z(2) + 4 * z(3) - z(4), expected.at("critical_z"), 1e-5);
}

TEST_P(ReferenceCase, AgreesInEveryEntry) {
  const std::filesystem::path file = cases_folder() / (GetParam() + ".json");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no cases in " << cases_folder() << "; set GENU_DATA";
  std::ifstream in(file);
  const Json json = Json::parse(in);
  try {
    if (json.value("kind", std::string()) == "limit_point")
      follow_to_limit_point(json);
    else
      solve_one_pose(json);
  } catch (const std::exception& unknown) {
    FAIL() << "the case says something that is not known here: " << unknown.what();
  }
  EXPECT_GT(compared_, 0);
  fmt::print("  {} values, worst {:.1e}: {}\n", compared_, worst_, worst_what_);
}

INSTANTIATE_TEST_SUITE_P(All, ReferenceCase, testing::ValuesIn(case_files()), [](const auto& parameter) {
  std::string name = parameter.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
});

}  // namespace
}  // namespace genu
