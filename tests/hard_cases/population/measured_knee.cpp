#include "hard_cases/population/measured_knee.h"

#include <sstream>

#include "support/ssm_scene.h"

namespace genu::population {
namespace {

/// The number behind "key = ", given to `change`; other lines as they are.
template <typename Change>
std::string with_changed(const std::string& text, const std::string& key, const Change& change) {
  std::istringstream lines(text);
  std::ostringstream out;
  out.precision(17);
  const std::string head = key + " = ";
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(head))
      out << head << change(std::stod(line.substr(head.size()))) << '\n';
    else
      out << line << '\n';
  }
  return out.str();
}

}  // namespace

Knee draw_measured_knee(RandomSource& random) {
  static const char* const kSubjects[] = {"mean", "S001", "S002"};
  const int which = random.integer(0, 4), degrees = random.integer(10, 70);
  const int increments = degrees / random.integer(1, 4) + 1;
  Knee out;
  if (which < 3) {
    out.kind = "shape model";
    out.text = test::ssm_scene(kSubjects[which], degrees, increments);
  } else {
    out.kind = "measured";
    out.text = test::lenhart_scene(which == 3 ? "-coarse" : "-medium", 0, degrees, increments);
  }
  out.text = with_changed(out.text, "stiffness", [&](double k) { return k * random.log_uniform(0.5, 2); });
  out.text = with_changed(out.text, "reference_strain", [&](double e) { return e + 0.008 * random.normal(); });
  return out;
}

}  // namespace genu::population
