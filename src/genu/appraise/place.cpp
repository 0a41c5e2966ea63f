#include "genu/appraise/place.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "genu/appraise/tolerances.h"

namespace genu {
namespace {

/// Of the loads at the start of the first step, where all are smaller there by the same factor; else 1.
double part_of_loads(const Prepared& prepared, const Target& target) {
  if (prepared.steps.empty()) return 1;
  double part = 1;
  const std::vector<double> all = prepared.steps.front().target(0).load_factors;
  for (std::size_t i = 0; i < std::min(all.size(), target.load_factors.size()); ++i)
    if (all[i] != 0) part = target.load_factors[i] / all[i];
  for (std::size_t i = 0; i < std::min(all.size(), target.load_factors.size()); ++i)
    if (!(std::abs(target.load_factors[i] - part * all[i]) <= kSameFactor * std::abs(all[i]))) return 1;
  return part > 0 ? part : 1;
}

}  // namespace

std::string place(const Prepared& prepared, int step, const Target& target) {
  const PlacedScene& scene = prepared.scene;
  const StepPlan* plan = step > 0 ? &prepared.steps[static_cast<std::size_t>(step - 1)] : nullptr;
  std::string varying, held;
  const auto add = [&](bool varies, const std::string& part) {
    std::string& text = varies ? varying : held;
    text += (text.empty() ? "" : ", ") + part;
  };
  for (std::size_t i = 0; i < target.prescribed.size(); ++i) {
    const auto& p = target.prescribed[i];
    const bool angle = p.coordinate.is_rotation();
    add(plan != nullptr && plan->prescribed[i].from != plan->prescribed[i].to,
        fmt::format("{} = {:.4g} {}", quantity_name(scene, p.coordinate), p.value * (angle ? 180 / M_PI : 1e3),
                    angle ? "deg" : "mm"));
  }
  for (std::size_t i = 0; i < target.load_factors.size(); ++i)
    if (plan != nullptr && plan->factors[i].from != plan->factors[i].to)
      add(true, fmt::format("load {} x {:.4g}", scene.loads[i].name, target.load_factors[i]));
  for (const LoadDef& load : scene.loads)
    if (plan != nullptr && load.in_time()) {
      add(true, fmt::format("time = {:.4g} s", target.time));
      break;
    }
  const std::string& text = varying.empty() ? held : varying;
  if (const double part = plan == nullptr ? part_of_loads(prepared, target) : 1; part < 1)
    return fmt::format("{}{}{:.4g} of the loads at the start", text, text.empty() ? "" : " under ", part);
  return (plan == nullptr ? "the approach to a step's start, with " : "") + (text.empty() ? "the start" : text);
}

std::string joined_with_and(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i)
    out += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return out;
}

std::string as_sentence(std::string words) {
  words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
  return words + ".";
}

}  // namespace genu
