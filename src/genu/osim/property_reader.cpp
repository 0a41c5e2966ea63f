#include "genu/osim/property_reader.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace genu::osim {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

/// Whole words only; nan and inf are numbers here and refused by those who use them.
std::optional<double> number_in(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (fault != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t at = text.find_first_not_of(kBlanks); at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(kBlanks, end);
  }
  return words;
}

/// A value as messages show it.
std::string shortened(const std::string& text) {
  constexpr std::size_t kShownCharacters = 60;
  return text.size() <= kShownCharacters ? text : text.substr(0, kShownCharacters) + "...";
}

}  // namespace

Mat3 body_fixed_xyz(const Vec3& angles) {
  return exp_rotation(angles.x() * Vec3::UnitX()) * exp_rotation(angles.y() * Vec3::UnitY()) *
         exp_rotation(angles.z() * Vec3::UnitZ());
}

const XmlElement* PropertyReader::find(const char* tag) const {
  if (const XmlElement* own = element_.child(tag)) return own;
  const XmlElement* class_default = reader_.defaults == nullptr ? nullptr : reader_.defaults->child(element_.tag);
  return class_default == nullptr ? nullptr : class_default->child(tag);
}

std::string PropertyReader::key(const std::string& tag) const {
  const std::string name = element_.name();
  return element_.tag + (name.empty() ? "" : " " + name) + (tag.empty() ? "" : "." + tag);
}

void PropertyReader::refuse(Code code, const SourceLocation& where, const std::string& tag, const std::string& found,
                            const std::string& rule) const {
  reader_.out.add(error_at({reader_.file, where}, code, key(tag), shortened(found), rule));
}

std::vector<double> PropertyReader::numbers_of(const XmlElement& e) const {
  std::vector<double> values;
  for (const std::string_view word : words_of(e.text)) {
    const auto value = number_in(word);
    if (!value || !std::isfinite(*value)) {
      refuse(value ? Code::out_of_range : Code::wrong_form, e.where, e.tag, e.text,
             fmt::format("\"{}\" is no finite number", std::string(word.substr(0, 40))));
      return {};
    }
    values.push_back(*value);
  }
  return values;
}

std::vector<double> PropertyReader::numbers(const char* tag) const {
  const XmlElement* e = find(tag);
  return e == nullptr ? std::vector<double>() : numbers_of(*e);
}

double PropertyReader::number(const char* tag, double otherwise) const {
  const XmlElement* e = find(tag);
  if (e == nullptr) return otherwise;
  const std::size_t before = reader_.out.count(Diagnostic::Severity::error);
  const std::vector<double> values = numbers_of(*e);
  if (values.size() == 1) return values[0];
  if (reader_.out.count(Diagnostic::Severity::error) == before)
    refuse(Code::wrong_form, e->where, tag, e->text, "must be one number");
  return otherwise;
}

double PropertyReader::required(const char* tag) const {
  if (find(tag) == nullptr) refuse(Code::missing_key, element_.where, tag, {}, "is missing");
  return number(tag, 0);
}

double PropertyReader::positive(const char* tag, std::optional<double> otherwise) const {
  const std::size_t before = reader_.out.count(Diagnostic::Severity::error);
  const double value = otherwise ? number(tag, *otherwise) : required(tag);
  if (!(value > 0) && reader_.out.count(Diagnostic::Severity::error) == before)
    refuse(Code::out_of_range, where(tag), tag, fmt::format("{}", value), "must be > 0");
  return value;
}

Vec3 PropertyReader::vector(const char* tag, const Vec3& otherwise) const {
  const XmlElement* e = find(tag);
  if (e == nullptr) return otherwise;
  const std::size_t before = reader_.out.count(Diagnostic::Severity::error);
  const std::vector<double> v = numbers_of(*e);
  if (v.size() == 3) return {v[0], v[1], v[2]};
  if (reader_.out.count(Diagnostic::Severity::error) == before)
    refuse(Code::wrong_form, e->where, tag, e->text, "must be three numbers");
  return otherwise;
}

std::string PropertyReader::word(const char* tag, const std::string& otherwise) const {
  const XmlElement* e = find(tag);
  return e == nullptr ? otherwise : e->text;
}

bool PropertyReader::flag(const char* tag, bool otherwise) const {
  const XmlElement* e = find(tag);
  if (e == nullptr) return otherwise;
  if (e->text == "true" || e->text == "1") return true;
  if (e->text != "false" && e->text != "0") refuse(Code::wrong_form, e->where, tag, e->text, "must be true or false");
  return false;
}

std::string PropertyReader::socket(const char* tag) const {
  const std::string path = word((std::string("socket_") + tag).c_str());
  if (path.empty())
    refuse(Code::missing_key, element_.where, std::string("socket_") + tag, {},
           "is missing: it says what this element belongs to");
  return path;
}

std::string PropertyReader::coordinate(const std::string& prefix) const {
  const std::string path = word(("socket_" + prefix + "coordinate").c_str());
  const std::string name = path.empty() ? word((prefix + "coordinate").c_str()) : path;
  return name.substr(name.rfind('/') + 1);
}

SourceLocation PropertyReader::where(const char* tag) const {
  const XmlElement* e = find(tag);
  return e == nullptr ? element_.where : e->where;
}

Pose PropertyReader::placement(const char* rotation, const char* translation) const {
  return {body_fixed_xyz(vector(rotation, Vec3::Zero())), vector(translation, Vec3::Zero())};
}

void PropertyReader::read_points(const XmlElement& e, Function& f) const {
  const PropertyReader properties(reader_, e);
  f.x = properties.numbers("x");
  f.y = properties.numbers("y");
  bool grows = f.x.size() > 1 && f.x.size() == f.y.size();
  for (std::size_t k = 1; grows && k < f.x.size(); ++k) grows = f.x[k] > f.x[k - 1];
  if (!grows) properties.refuse(Code::wrong_form, e.where, "x", {}, "needs two or more growing numbers, and y as many");
}

Function PropertyReader::checked(Function f, const XmlElement& e) const {
  const bool points = f.kind == Function::Kind::spline || f.kind == Function::Kind::piecewise_linear;
  if (points ? f.x.size() < 2 || f.x.size() != f.y.size() : f.coefficients.empty()) return {};
  if (f.kind == Function::Kind::linear && f.coefficients.size() != 2) {
    refuse(Code::not_built, e.where, e.tag, {}, "is a function of several coordinates; genu reads functions of one");
    return {};
  }
  return f;
}

Function PropertyReader::function(const XmlElement& holder) const {
  for (const XmlElement& e : holder.children) {
    const PropertyReader inside(reader_, e);
    Function f;
    if (e.tag == "Constant") {
      f.coefficients = {inside.number("value", 0)};
      return f;
    }
    if (e.tag == "LinearFunction" || e.tag == "PolynomialFunction") {
      f.kind = e.tag == "LinearFunction" ? Function::Kind::linear : Function::Kind::polynomial;
      f.coefficients = inside.numbers("coefficients");
      if (f.coefficients.empty()) f.coefficients = e.tag == "LinearFunction" ? std::vector{1.0, 0.0} : std::vector{0.0};
      return checked(f, e);
    }
    if (e.tag == "SimmSpline" || e.tag == "NaturalCubicSpline" || e.tag == "PiecewiseLinearFunction") {
      f.kind = e.tag == "PiecewiseLinearFunction" ? Function::Kind::piecewise_linear : Function::Kind::spline;
      inside.read_points(e, f);
      return checked(f, e);
    }
    if (e.tag == "MultiplierFunction") {
      const XmlElement* factor = e.child("function");
      if (factor != nullptr) f = inside.function(*factor);
      f.scale *= inside.number("scale", 1);
      return f;
    }
    if (e.tag.ends_with("Function") || e.tag.ends_with("Spline") || e.tag == "Sine") {
      inside.refuse(Code::not_built, e.where, {}, {},
                    "is a function that genu does not read (it reads Constant, LinearFunction, PolynomialFunction, "
                    "SimmSpline, PiecewiseLinearFunction, MultiplierFunction)");
      return f;
    }
  }
  refuse(Code::missing_key, holder.where, holder.tag, {}, "has no function");
  return {};
}

}  // namespace genu::osim
