#include "genu/calibrate/zero_load.h"

#include <algorithm>

#include "genu/assemble/given_poses.h"
#include "genu/assemble/refuse_option.h"
#include "genu/calibrate/finite_number.h"
#include "genu/core/units.h"
#include "genu/model/joint_model.h"
#include "genu/model/ligament_pieces.h"
#include "genu/scene/words.h"

namespace genu {
namespace {

/// m: of each ligament, over the poses of all files.
std::optional<std::vector<double>> longest_lengths(const Prepared& prepared, const std::vector<std::string>& files,
                                                   Diagnostics& out) {
  std::vector<double> longest(prepared.model.ligaments.size());
  for (const std::string& path : files) {
    const auto file = read_pose_file(path, out);
    const auto columns = file ? match_columns(prepared.scene, *file, {}, out) : std::nullopt;
    const auto given = columns ? read_given_poses(prepared.scene, *file, *columns, out) : std::nullopt;
    if (!given) return std::nullopt;
    for (const GivenPose& pose : given->poses) {
      State state;
      state.coordinates = pose.coordinates;
      state.poses = poses_from_coordinates(prepared.model, pose.coordinates);
      reset_pieces(prepared.model, state);
      for (std::size_t l = 0; l < longest.size(); ++l)
        longest[l] = std::max(longest[l], prepared.model.ligaments[l].path.length(state.poses, state.wraps));
    }
  }
  return longest;
}

/// Of each ligament.
std::optional<std::vector<double>> corrections(const Scene& scene, const std::vector<std::string>& texts,
                                               Diagnostics& out) {
  std::vector<double> factors(scene.ligaments.size(), 1.0);
  for (const std::string& text : texts) {
    const std::size_t equals = text.rfind('=');
    const std::string pattern = equals == std::string::npos ? "*" : text.substr(0, equals);
    const auto factor = finite_number(equals == std::string::npos ? text : text.substr(equals + 1));
    bool found = false;
    for (std::size_t l = 0; factor && *factor > 0 && l < factors.size(); ++l)
      if (matches(pattern, scene.ligaments[l].name)) factors[l] = *factor, found = true;
    if (found) continue;
    refuse_option(out, Code::out_of_range, "--correction", text,
                  "must be a number above 0, or LIGAMENTS=NUMBER with ligaments of this scene");
    return std::nullopt;
  }
  return factors;
}

}  // namespace

std::optional<ResultTable> start_at_zero_load(const Prepared& prepared, const ZeroLoadChoice& choice,
                                              std::vector<CalibrationUnknown>& unknowns, Diagnostics& out) {
  const auto longest = longest_lengths(prepared, choice.poses, out);
  const auto factors = corrections(prepared.source, choice.correction, out);
  if (!longest || !factors) return std::nullopt;
  ResultTable table;
  for (const char* column : {"ligament", "longest_mm", "correction", "zero_load_mm", "before_mm"})
    table.add_column(column);
  for (CalibrationUnknown& unknown : unknowns)
    for (CalibrationUnknown::Member& member : unknown.members) {
      const bool is_length = member.parameter.kind == Parameter::Kind::slack_length;
      if (!is_length && member.parameter.kind != Parameter::Kind::reference_strain) continue;
      const std::size_t l = at(member.parameter.object);
      const double before = prepared.model.ligaments[l].law.slack_length(), after = (*factors)[l] * (*longest)[l];
      // The length at the reference pose, (1 + strain) times the slack length, stays.
      member.start = is_length ? after : (1 + member.start) * before / after - 1;
      table.add_row();
      table.set("ligament", prepared.source.ligaments[l].name);
      table.set("longest_mm", to::kMillimetre * (*longest)[l]);
      table.set("correction", (*factors)[l]);
      table.set("zero_load_mm", to::kMillimetre * after);
      table.set("before_mm", to::kMillimetre * before);
    }
  if (table.rows() > 0) return table;
  out.add(error_at({}, Code::conflict, "--zero-load", {}, "needs slack lengths or reference strains in --vary"));
  return std::nullopt;
}

}  // namespace genu
