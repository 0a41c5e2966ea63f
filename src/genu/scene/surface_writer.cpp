#include "genu/scene/surface_writer.h"

#include <cmath>

#include <fmt/format.h>

#include "genu/scene/utf8.h"

namespace genu {
namespace {

std::string number(double x) { return fmt::format("{}", x == 0 ? 0.0 : x); }  // no "-0"

std::string vector_text(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", number(v.x()), number(v.y()), number(v.z()));
}

/// To 12 digits, which the sides of a patch need no more than.
std::string side(double x) { return fmt::format("{:.12g}", x == 0 ? 0.0 : x); }

std::string range_text(const char* key, const SurfaceDef::Patch::Range& range, double unit) {
  if (!range) return {};
  return fmt::format("{} = [{}, {}], ", key, side(range->first / unit), side(range->second / unit));
}

}  // namespace

std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : valid_utf8(text)) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f)
      out += fmt::format("\\u{:04x}", code);
    else
      out += (c == '"' || c == '\\' ? "\\" : "") + std::string(1, c);
  }
  return out + "\"";
}

std::string polynomial_table(const SurfaceDef& def, const std::string& body, double length_unit, double angle_unit) {
  const bool cylindrical = def.shape == SurfaceDef::Shape::cylindrical_polynomial;
  std::string out = fmt::format("[surface.{}]\nbody = \"{}\"\nshape = \"polynomial\"\n", def.name, body);
  if (cylindrical) out += "chart = \"cylindrical\"\n";
  if (def.inside) out += "inside = true\n";
  out += "origin = " + vector_text(def.placement.p / length_unit) + "\n";
  out += "x_axis = " + vector_text(def.placement.R.col(0)) + "\n";
  out += "z_axis = " + vector_text(def.placement.R.col(2)) + "\n";
  out += "terms = [\n";
  int row = -1;  // one line for each total degree
  for (const SurfaceDef::Term& t : def.terms) {
    const int lengths = cylindrical ? 1 - t.j : 1 - t.i - t.j;
    out += row < 0 ? "  " : t.i + t.j == row ? ", " : ",\n  ";
    row = t.i + t.j;
    out += fmt::format("[{}, {}, {}]", t.i, t.j, number(t.c * std::pow(length_unit, -lengths)));
  }
  out += ",\n]\n";
  if (!def.patch) return out;
  std::string ranges =
      range_text("x", def.patch->box[0], length_unit) + range_text("y", def.patch->box[1], length_unit) +
      range_text("theta", def.patch->theta, angle_unit) + range_text("z", def.patch->box[2], length_unit);
  if (!ranges.empty()) out += "patch = { " + ranges.substr(0, ranges.size() - 2) + " }\n";
  return out;
}

}  // namespace genu
