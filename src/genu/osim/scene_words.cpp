#include "genu/osim/scene_words.h"

#include <cmath>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/osim/tolerances.h"

namespace genu::osim {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_part(char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '-'; }

std::string as_key(const std::string& name) {
  std::string key;
  for (const char c : name) key += is_part(c) ? c : '_';
  if (key.empty() || !is_letter(key[0])) key.insert(0, "_");
  return key;
}

/// "_r" or "_l", or empty
std::string side_of(const std::string& name) {
  return name.ends_with("_r") || name.ends_with("_l") ? name.substr(name.size() - 2) : std::string();
}

}  // namespace

std::string number_text(double x) { return std::abs(x) < kWrittenAsZero ? "0" : fmt::format("{:.12g}", x); }

std::string vector_text(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", number_text(v.x()), number_text(v.y()), number_text(v.z()));
}

std::string one_line(const std::string& text) {
  std::string line;
  for (const char c : text) line += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  return line;
}

std::string point_text(const Vec3& p) { return vector_text(p * to::kMillimetre); }

std::string SceneNames::of(const SourceLocation& element, const std::string& name) {
  std::string& given = given_[{element.line, element.column}];
  if (!given.empty()) return given;
  const std::string key = as_key(name);
  std::string free = key;
  for (int n = 2; !taken_.insert(free).second; ++n) free = fmt::format("{}_{}", key, n);
  return given = free;
}

std::string short_coordinate(const std::string& coordinate, const std::string& joint) {
  const std::string side = side_of(joint);
  const std::string stem = joint.substr(0, joint.size() - side.size()) + "_";
  if (!coordinate.starts_with(stem) || !coordinate.ends_with(side)) return coordinate;
  if (coordinate.size() <= stem.size() + side.size()) return coordinate;
  return coordinate.substr(stem.size(), coordinate.size() - stem.size() - side.size());
}

}  // namespace genu::osim
