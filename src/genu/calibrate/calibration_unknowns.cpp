#include "genu/calibrate/calibration_unknowns.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "genu/assemble/refuse_option.h"
#include "genu/calibrate/finite_number.h"
#include "genu/calibrate/tolerances.h"
#include "genu/results/ligament_groups.h"

namespace genu {

double CalibrationUnknown::value(const Member& member, double u) const {
  return share ? member.start * std::exp(u) : member.start + scale * u;
}

double CalibrationUnknown::slope(const Member& member, double u) const { return share ? value(member, u) : scale; }

double CalibrationUnknown::u_of(const Member& member, double value) const {
  return share ? std::log(value / member.start) : (value - member.start) / scale;
}

double CalibrationUnknown::shown(double u) const {
  if (!group) return value(members.front(), u) / si;
  return share ? std::exp(u) : scale * u / si;
}

double CalibrationUnknown::shown_slope(double u) const {
  if (!group) return slope(members.front(), u) / si;
  return share ? std::exp(u) : scale / si;
}

double CalibrationUnknown::u_of_shown(double number) const {
  if (!group) return u_of(members.front(), number * si);
  return share ? std::log(number) : number * si / scale;
}

double CalibrationUnknown::standard_change() const {
  return members.front().parameter.change / std::abs(slope(members.front(), 0));
}

double CalibrationUnknown::most_step() const {
  double step = kMaxLogStep;
  for (const Member& member : members) {
    if (member.parameter.kind == Parameter::Kind::reference_strain)
      step = std::min(step, kMaxStrainStep / std::abs(slope(member, 0)));
    if (member.parameter.kind == Parameter::Kind::slack_length)
      step = std::min(step, kMaxStrainStep * member.start / std::abs(slope(member, 0)));
  }
  return step;
}

std::vector<NewNumber> numbers_at(const std::vector<CalibrationUnknown>& unknowns, const VecX& u) {
  std::vector<NewNumber> out;
  for (std::size_t k = 0; k < unknowns.size(); ++k)
    for (const auto& member : unknowns[k].members)
      out.emplace_back(member.parameter, unknowns[k].value(member, u[static_cast<Eigen::Index>(k)]));
  return out;
}

namespace {

constexpr const char *kTogether = "together", *kFactor = "factor", *kOffset = "offset", *kBundles = "bundles";

/// "slack_length" of "AAC.slack_length" and "ligament.AAC.slack_length".
std::string key_of(const Parameter& p) { return p.name.substr(p.name.rfind('.') + 1); }

class UnknownChooser {
 public:
  UnknownChooser(Scene& scene, Diagnostics& out) : scene_(scene), out_(out), all_(parameters_of(scene)) {
    for (const Parameter& p : all_)
      if (can_vary(p)) known_.push_back(p.name);
  }

  void add(const std::string& option) {
    const std::size_t colon = option.rfind(':');
    const std::string how = colon == std::string::npos ? "" : option.substr(colon + 1);
    if (how.empty()) {
      for (const Parameter& p : named(option)) add_single(p);
    } else if (how == kBundles) {
      add_bundles(option, named(option.substr(0, colon)));
    } else if (how == kTogether || how == kFactor || how == kOffset) {
      add_group(option, option, members_of(option.substr(0, colon)), how);
    } else {
      refuse_option(out_, Code::unknown_name, "--vary", option,
                    "ends with a word that is none of :together, :factor, :offset, :bundles");
    }
  }

  std::vector<CalibrationUnknown> unknowns;

 private:
  // Surfaces are made once, before the fit.
  bool can_vary(const Parameter& p) const { return !p.of_surface() && parameter_number(scene_, p) != nullptr; }

  std::vector<Parameter> named(const std::string& pattern) {
    std::vector<Parameter> found;
    bool fixed = false;
    for (const Parameter& p : all_) {
      if (!matches(scene_, pattern, p.name)) continue;
      if (can_vary(p))
        found.push_back(p);
      else
        fixed = true;
    }
    if (found.empty() && fixed)
      refuse_option(out_, Code::not_applicable, "--vary", pattern,
                    "cannot be fitted: numbers of ligaments, loads, bodies and joints can, if the scene gives them");
    else if (found.empty())
      refuse_option(out_, Code::unknown_name, "--vary", pattern,
                    "is no parameter of this scene" + did_you_mean(pattern, known_));
    return found;
  }

  std::vector<Parameter> members_of(const std::string& patterns) {
    std::vector<Parameter> members;
    std::stringstream parts(patterns);
    for (std::string part; std::getline(parts, part, '+');)
      for (const Parameter& p : named(part)) members.push_back(p);
    return members;
  }

  bool is_used(const Parameter& p) const {
    return std::any_of(unknowns.begin(), unknowns.end(), [&](const CalibrationUnknown& u) {
      return std::any_of(u.members.begin(), u.members.end(),
                         [&](const auto& member) { return member.parameter.name == p.name; });
    });
  }

  /// Refuses a share of nothing.
  bool can_be_share(const Parameter& p) {
    if (*parameter_number(scene_, p) > 0) return true;
    refuse_option(out_, Code::out_of_range, "--vary", p.name,
                  "is 0: what is fitted as a share of itself must start above 0");
    return false;
  }

  void add_single(const Parameter& p) {
    if (is_used(p)) return;
    CalibrationUnknown u{p.name, p.unit, p.si, p.positive, false, 1, {{p, *parameter_number(scene_, p)}}};
    if (!u.share) u.scale = std::max(std::abs(u.members.front().start), kUnknownScale * p.change);
    if (!u.share || can_be_share(p)) unknowns.push_back(u);
  }

  void add_group(const std::string& option, const std::string& name, const std::vector<Parameter>& members,
                 const std::string& how) {
    if (members.empty()) return;
    CalibrationUnknown u;
    u.name = name;
    u.group = true;
    const Parameter& first = members.front();
    u.share = how == kFactor || (how != kOffset && first.positive);
    u.unit = u.share ? "1" : first.unit;
    u.si = u.share ? 1 : first.si;
    double change = 0;
    for (const Parameter& p : members) {
      if (is_used(p)) {
        refuse_option(out_, Code::conflict, "--vary", option, "names " + p.name + ", which another --vary names too");
        return;
      }
      const bool alike = how == kFactor || (p.unit == first.unit && (how == kOffset || p.positive == first.positive));
      if (!alike) {
        refuse_option(out_, Code::conflict, "--vary", option,
                      "moves " + first.name + " and " + p.name + " together, which have not one unit: name one kind");
        return;
      }
      if (how == kFactor && *parameter_number(scene_, p) == 0) {
        refuse_option(out_, Code::out_of_range, "--vary", option, "multiplies " + p.name + ", which is 0");
        return;
      }
      u.members.push_back({p, *parameter_number(scene_, p)});
      change += p.change / static_cast<double>(members.size());
    }
    u.scale = kUnknownScale * change;
    unknowns.push_back(u);
  }

  void add_bundles(const std::string& option, const std::vector<Parameter>& members) {
    const std::vector<LigamentGroup> groups = ligament_groups(scene_);
    std::vector<std::pair<std::string, std::vector<Parameter>>> found;
    for (const Parameter& p : members) {
      std::string name = p.name;
      for (const LigamentGroup& group : groups)
        if (p.of_ligament() &&
            std::find(group.members.begin(), group.members.end(), at(p.object)) != group.members.end())
          name = group.name + "." + key_of(p);
      const auto same = std::find_if(found.begin(), found.end(), [&](const auto& f) { return f.first == name; });
      if (same == found.end())
        found.push_back({name, {p}});
      else
        same->second.push_back(p);
    }
    for (const auto& [name, parts] : found) add_group(option, name, parts, kBundles);
  }

  Scene& scene_;
  Diagnostics& out_;
  std::vector<Parameter> all_;
  std::vector<std::string> known_;
};

/// "NAME=A..B" or "NAME=A~B": for each unknown of that name calls f(unknown, A, B). What is no such text is refused
/// with `form`.
template <class F>
void for_named(const Scene& scene, const std::string& option, const std::string& text, const std::string& mark,
               const std::string& form, std::vector<CalibrationUnknown>& unknowns, Diagnostics& out, const F& f) {
  const std::size_t equals = text.rfind('='), middle = text.find(mark, equals == std::string::npos ? 0 : equals);
  if (equals == std::string::npos || middle == std::string::npos) {
    refuse_option(out, Code::out_of_range, option, text, "must be " + form);
    return;
  }
  const std::string name = text.substr(0, equals), first = text.substr(equals + 1, middle - equals - 1),
                    second = text.substr(middle + mark.size());
  bool found = false;
  std::vector<std::string> known;
  for (CalibrationUnknown& u : unknowns) {
    known.push_back(u.name);
    if (name != u.name && !matches(scene, name, u.name)) continue;
    found = true;
    if (f(u, first, second)) continue;
    refuse_option(out, Code::out_of_range, option, text, "must be " + form + " (for " + u.name + ")");
    return;
  }
  if (!found)
    refuse_option(out, Code::unknown_name, option, name, "is no number that --vary names" + did_you_mean(name, known));
}

bool set_bounds(CalibrationUnknown& u, const std::string& first, const std::string& second) {
  const auto low = finite_number(first), high = finite_number(second);
  if (!low || !high || !(*low < *high)) return false;
  double a = u.u_of_shown(*low), b = u.u_of_shown(*high);
  if (u.share && !(*low > 0 || u.members.front().start < 0)) a = -std::numeric_limits<double>::infinity();
  if (a > b) std::swap(a, b);
  if (std::isnan(a) || std::isnan(b) || !(a <= 0 && b >= 0)) return false;
  u.lower = a;
  u.upper = b;
  return true;
}

bool set_prior(CalibrationUnknown& u, const std::string& first, const std::string& second) {
  const bool percent = second.ends_with('%');
  const auto mean = first == "start" ? std::optional(u.shown(0)) : finite_number(first);
  const auto size = finite_number(percent ? second.substr(0, second.size() - 1) : second);
  if (!mean || !size) return false;
  const double deviation = percent ? *size / 100 * std::abs(*mean) : *size;
  if (!(deviation > 0)) return false;
  u.prior = {*mean, deviation};
  return true;
}

}  // namespace

std::vector<CalibrationUnknown> choose_unknowns(Scene& scene, const UnknownChoice& choice, Diagnostics& out) {
  UnknownChooser chooser(scene, out);
  for (const std::string& option : choice.vary) chooser.add(option);
  if (choice.vary.empty()) out.add(error_at({}, Code::missing_key, "--vary", {}, "names no parameter"));
  set_limits(scene, choice, chooser.unknowns, out);
  return std::move(chooser.unknowns);
}

void set_limits(const Scene& scene, const UnknownChoice& choice, std::vector<CalibrationUnknown>& unknowns,
                Diagnostics& out) {
  for (const std::string& text : choice.bounds)
    for_named(scene, "--bounds", text, "..", "NAME=LOW..HIGH with the start between them", unknowns, out, set_bounds);
  for (const std::string& text : choice.priors)
    for_named(scene, "--prior", text, "~", "NAME=MEAN~SD: MEAN a number or `start`, SD a number or a share as 5%",
              unknowns, out, set_prior);
}

}  // namespace genu
