#include "genu/results/wrap_columns.h"

#include <algorithm>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/model/ligament_pieces.h"
#include "genu/results/columns.h"

namespace genu {
namespace {

/// "MCL.tibia" of obstacle i.
std::string stem(const std::string& name, const LigamentPath& path, std::size_t i) {
  const auto& all = path.obstacles();
  const auto before = std::count_if(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i),
                                    [&](const auto& o) { return o.name == all[i].name; });
  return name + "." + all[i].name + (before > 0 ? fmt::format(".{}", before + 1) : std::string());
}

template <typename F>
void for_each_wrap(const JointModel& model, const F& f) {
  for_each_path(model, [&](const LigamentPath& path, const std::string& name) {
    for (std::size_t i = 0; i < path.obstacles().size(); ++i) f(path, i, stem(name, path, i));
  });
}

}  // namespace

void add_wrap_columns(const JointModel& model, ResultTable& table) {
  for (const Load& load : model.loads)
    if (load.kind == Load::Kind::cable) table.add_column(load.name + ".length_mm");
  for_each_wrap(model, [&](const LigamentPath&, std::size_t, const std::string& name) {
    table.add_column(name + ".touches");
    table.add_column(name + ".arc_mm");
    for (const char* end : {"begin", "end"})
      for (const char* axis : kAxisNames) table.add_column(fmt::format("{}.{}.{}_mm", name, end, axis));
  });
}

void settle_shown_wraps(const JointModel& model, State& state) { settle_wraps(model, state); }

void set_wrap_columns(const JointModel& model, const State& state, ResultTable& table) {
  for (const Load& load : model.loads)
    if (load.kind == Load::Kind::cable)
      table.set(load.name + ".length_mm", to::kMillimetre * load.path.length(state.poses, state.wraps));
  for_each_wrap(model, [&](const LigamentPath& path, std::size_t i, const std::string& name) {
    const WrapTouch& touch = state.wraps[path.touch_index(i)];
    table.set(name + ".touches", static_cast<long>(touch.touching));
    table.set(name + ".arc_mm", to::kMillimetre * path.arc_length(state.wraps, i));
    if (!touch.touching) return;
    const Vec3& centre = model.bodies[at(path.obstacles()[i].body)].centre;
    for (const bool last : {false, true})
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Vec3 place = (last ? touch.arc.end.p : touch.arc.begin.p) + centre;
        table.set(fmt::format("{}.{}.{}_mm", name, last ? "end" : "begin", kAxisNames[axis]),
                  to::kMillimetre * place[static_cast<Eigen::Index>(axis)]);
      }
  });
}

}  // namespace genu
