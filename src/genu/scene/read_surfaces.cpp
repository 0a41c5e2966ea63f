#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "genu/core/units.h"
#include "genu/scene/read_parts.h"
#include "genu/scene/tolerances.h"

namespace genu {

namespace fs = std::filesystem;

namespace {

/// 0, 1, 2, ...; whole floating numbers pass, for the sake of arrays of one type.
std::optional<int> read_exponent(ReadContext& context, const Item& item) {
  const TomlNode& node = *item.node;
  const bool whole = (node.kind == TomlNode::Kind::integer || node.kind == TomlNode::Kind::floating) &&
                     node.number >= 0 && node.number <= kMaxExponent && node.number == std::floor(node.number);
  if (whole) return static_cast<int>(node.number);
  refuse(context, item, Code::out_of_range, fmt::format("an exponent must be an integer from 0 to {}", kMaxExponent));
  return {};
}

/// [i, j, c]: c has the unit that makes c x^i y^j (or c theta^i z^j, theta in rad) a length in the file's unit.
std::optional<SurfaceDef::Term> read_polynomial_term(ReadContext& context, const Item& item, bool cylindrical) {
  if (!is_array(context, item, "a term [i, j, c]", 3)) return {};
  const auto i = read_exponent(context, item.element(0)), j = read_exponent(context, item.element(1));
  if (!i || !j) return {};
  const int lengths = cylindrical ? 1 - *j : 1 - *i - *j;
  const NumberRule rule{.unit = std::pow(context.scene.length_unit, lengths),
                        .unit_name = {},
                        .above = {},
                        .at_least = {},
                        .largest = 1e100,
                        .smallest = 1e-300};
  const auto c = read_number(context, item.element(2), rule);
  if (!c) return {};
  return SurfaceDef::Term{*i, *j, *c};
}

void read_polynomial(ReadContext& context, Section& section, SurfaceDef& surface) {
  const Item chart = section.find("chart");
  const auto chosen = read_choice(context, chart, {"cartesian", "cylindrical"});
  const bool cylindrical = chosen == 1;
  if (cylindrical) surface.shape = SurfaceDef::Shape::cylindrical_polynomial;
  const Item terms = section.require("terms");
  if (!is_array(context, terms, "a list of terms [[i, j, c], ...]")) return;
  if (terms.node->children.empty()) refuse(context, terms, Code::missing_key, "needs at least one term [i, j, c]");
  std::set<std::pair<int, int>> seen;
  for (std::size_t k = 0; k < terms.node->children.size(); ++k) {
    const Item item = terms.element(k);
    const auto term = read_polynomial_term(context, item, cylindrical);
    if (!term) continue;
    if (!seen.insert({term->i, term->j}).second)
      refuse(context, item, Code::duplicate, "these exponents stand in a term before");
    surface.terms.push_back(*term);
  }
  const bool has_radius = std::any_of(surface.terms.begin(), surface.terms.end(),
                                      [](const SurfaceDef::Term& t) { return t.i == 0 && t.j == 0 && t.c > 0; });
  if (cylindrical && !surface.terms.empty() && !has_radius)
    refuse(context, terms, Code::missing_key, "needs a term [0, 0, r] with r > 0: the radius at theta = z = 0");
}

void read_mesh(ReadContext& context, Section& section, SurfaceDef& surface) {
  surface.file = read_mesh_files(context, section.require("file"));
  surface.file_unit = read_length_unit(context, section.require("units"));
  const Item radius = section.find("fit_radius");
  surface.fit_radius = read_number(context, radius, positive(length_rule(context)));
  if (surface.fit_radius) surface.fit_radius_where = radius.node->where;
  const auto degree = read_integer(context, section.find("degree"), 2, 4);
  if (degree) surface.degree = static_cast<int>(*degree);
}

/// What shapes have beside numbers.
struct OtherKeys {
  SurfaceDef::Shape shape;
  std::array<const char*, 4> keys;
  void (*read)(ReadContext&, Section&, SurfaceDef&);
};
constexpr OtherKeys kOtherKeys[] = {
    {SurfaceDef::Shape::polynomial, {"chart", "terms"}, read_polynomial},
    {SurfaceDef::Shape::mesh, {"file", "units", "fit_radius", "degree"}, read_mesh},
};

/// The words of all shapes, each once.
std::vector<std::string> shape_words() {
  std::vector<std::string> words;
  for (const KindOf<SurfaceDef>& kind : kSurfaceKinds)
    if (std::find(words.begin(), words.end(), kind.word) == words.end()) words.emplace_back(kind.word);
  return words;
}

/// The shape, the keys that only it has, and the numbers of any surface.
void read_shape(ReadContext& context, Section& section, SurfaceDef& surface) {
  const std::vector<std::string> words = shape_words();
  const auto k = read_choice(context, section.require("shape"), words);
  if (!k) {
    // Without a shape no key of any shape can be called wrong.
    for (const OtherKeys& other : kOtherKeys)
      for (const char* key : other.keys)
        if (key != nullptr) section.find(key);
    for (const KindOf<SurfaceDef>& kind : kSurfaceKinds) know_numbers(section, kind);
    return;
  }
  const auto* kind = std::find_if(std::begin(kSurfaceKinds), std::end(kSurfaceKinds),
                                  [&](const auto& each) { return each.word == words[static_cast<std::size_t>(*k)]; });
  surface.shape = static_cast<SurfaceDef::Shape>(kind - std::begin(kSurfaceKinds));
  section.rename(kind->what);
  for (const OtherKeys& other : kOtherKeys)
    if (other.shape == surface.shape) {
      other.read(context, section, surface);
      break;
    }
  read_numbers(context, section, kind_of(surface), surface);
}

/// Adds a file that exists, as it is to be opened.
void read_mesh_file(ReadContext& context, const Item& item, PieceFiles& files) {
  const auto name = read_string(context, item);
  if (!name) return;
  std::string file = context.file_called(*name);
  const bool at_hand = std::find(context.at_hand.begin(), context.at_hand.end(), file) != context.at_hand.end();
  std::error_code failed;
  const fs::file_status status =
      at_hand ? fs::file_status(fs::file_type::regular) : fs::status(context.folder / fs::path(*name), failed);
  if (name->empty() || name->find('\0') != std::string::npos) {
    refuse(context, item, Code::wrong_form, "must name a mesh file");
  } else if (status.type() == fs::file_type::not_found) {
    refuse(context, item, Code::no_such_file, "no such file: " + file);
  } else if (failed) {
    refuse(context, item, Code::cannot_read, "cannot be read: " + file + ": " + failed.message());
  } else if (!fs::is_regular_file(status)) {
    refuse(context, item, Code::is_folder, "is not a file: " + file);
  } else if (std::find(files.paths.begin(), files.paths.end(), file) != files.paths.end()) {
    refuse(context, item, Code::duplicate, "is in this list before: a mesh has each of its pieces once");
  }
  files.paths.push_back(std::move(file));
  files.where.push_back(item.node->where);
}

}  // namespace

PieceFiles read_mesh_files(ReadContext& context, const Item& item) {
  PieceFiles files;
  if (!item) return files;
  if (item.node->kind != TomlNode::Kind::array) {
    read_mesh_file(context, item, files);
    return files;
  }
  const std::size_t count = item.node->children.size();
  if (count == 0) refuse(context, item, Code::wrong_form, "must name a mesh file, or list the files of its pieces");
  for (std::size_t k = 0; k < count; ++k) read_mesh_file(context, item.element(k), files);
  return files;
}

void read_surfaces(ReadContext& context, Section& root) {
  const std::vector<std::string> bodies = names_of(context.scene.bodies);
  for (const Item& item : named_tables(context, root, "surface")) {
    Section section(context, item, "a surface");
    SurfaceDef surface;
    surface.name = item.node->key;
    surface.where = item.node->key_where;
    surface.body = read_reference(context, section.require("body"), "body", bodies).value_or(-1);
    read_shape(context, section, surface);
    surface.placement.R = read_axes(context, section);
    surface.inside = read_bool(context, section.find("inside")).value_or(false);
    surface.patch = read_patch(context, section.find("patch"), surface);
    surface.thickness = read_surface_thickness(context, section.find("thickness"));
    warn_unlikely(context, section, surface);
    section.finish();
    context.scene.surfaces.push_back(surface);
  }
}

}  // namespace genu
