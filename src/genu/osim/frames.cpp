#include "genu/osim/frames.h"

#include <algorithm>

namespace genu::osim {
namespace {

/// The part of a path before its last one: "knee_r" of "/jointset/knee_r/tibia_offset".
std::string owner_in(const std::string& path) {
  const std::size_t end = path.rfind('/');
  if (end == std::string::npos || end == 0) return {};
  return last_name(path.substr(0, end));
}

const OffsetFrame* offset_frame(const Model& model, const std::string& name, const std::string& owner) {
  const OffsetFrame* any = nullptr;
  for (const OffsetFrame& f : model.frames) {
    if (f.name != name) continue;
    if (f.owner == owner) return &f;
    if (any == nullptr) any = &f;
  }
  return any;
}

}  // namespace

std::optional<PlacedFrame> find_frame(const Model& model, const std::string& path, const std::string& owner) {
  PlacedFrame placed;
  std::string at = path, of = owner;
  for (std::size_t steps = 0; steps <= model.frames.size(); ++steps) {
    const std::string name = last_name(at), within = owner_in(at);
    if (name == "ground") {
      placed.body = static_cast<int>(model.bodies.size());
      return placed;
    }
    const bool in_joint = !within.empty() && within != ".." && within != "bodyset";
    const OffsetFrame* offset = within == "bodyset" ? nullptr : offset_frame(model, name, in_joint ? within : of);
    if (offset == nullptr) {
      const auto body =
          std::find_if(model.bodies.begin(), model.bodies.end(), [&](const Body& b) { return b.name == name; });
      if (body == model.bodies.end()) return std::nullopt;
      placed.body = static_cast<int>(body - model.bodies.begin());
      return placed;
    }
    placed.X_body_frame = offset->X_parent_frame * placed.X_body_frame;
    at = offset->parent;
    of = offset->owner;
  }
  return std::nullopt;
}

}  // namespace genu::osim
