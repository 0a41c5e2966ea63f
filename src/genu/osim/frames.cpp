#include "genu/osim/frames.h"

#include <algorithm>

namespace genu::osim {
namespace {

constexpr const char* kGroundPath = "/ground";
constexpr const char* kBodyPaths = "/bodyset/";

const OffsetFrame* offset_frame(const Model& model, const std::string& path) {
  const auto found =
      std::find_if(model.frames.begin(), model.frames.end(), [&](const OffsetFrame& f) { return f.path == path; });
  return found == model.frames.end() ? nullptr : &*found;
}

/// A path without "." and "..".
std::string without_dots(const std::string& path) {
  std::string out;
  for (std::size_t from = 0; from < path.size();) {
    const std::size_t slash = std::min(path.find('/', from), path.size());
    const std::string part = path.substr(from, slash - from);
    if (part == "..")
      out.resize(out.empty() ? 0 : out.rfind('/'));
    else if (!part.empty() && part != ".")
      out += "/" + part;
    from = slash + 1;
  }
  return out;
}

}  // namespace

std::string frame_path(const Model& model, const std::string& socket, const std::string& owner) {
  if (socket.starts_with('/')) return without_dots(socket);
  std::string inside = without_dots(owner + "/" + socket);
  if (socket.starts_with('.') || socket.find('/') != std::string::npos) return inside;
  if (offset_frame(model, inside) != nullptr) return inside;
  return socket == "ground" ? kGroundPath : kBodyPaths + socket;
}

std::optional<PlacedFrame> find_frame(const Model& model, const std::string& path) {
  PlacedFrame placed;
  const std::string* at = &path;
  for (std::size_t steps = 0; steps <= model.frames.size(); ++steps) {
    if (const OffsetFrame* offset = offset_frame(model, *at)) {
      placed.X_body_frame = offset->X_parent_frame * placed.X_body_frame;
      at = &offset->parent;
      continue;
    }
    const auto body = std::find_if(model.bodies.begin(), model.bodies.end(),
                                   [&](const Body& b) { return *at == kBodyPaths + b.name; });
    if (body == model.bodies.end() && *at != kGroundPath) return std::nullopt;
    placed.body = static_cast<int>(body - model.bodies.begin());
    return placed;
  }
  return std::nullopt;
}

}  // namespace genu::osim
