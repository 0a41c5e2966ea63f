#include "genu/study/knee_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "genu/study/tolerances.h"

namespace genu {
namespace {

struct Box {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max()), high = -low;

  void add(const Vec3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Vec3 centre() const { return (low + high) / 2; }
  Vec3 size() const { return high - low; }
};

/// The box of what lies within `reach` of the mesh's end in the direction `end`.
Box box_near(const Mesh& mesh, const Vec3& end, double reach) {
  double furthest = -std::numeric_limits<double>::max();
  for (const Vec3& p : mesh.vertices) furthest = std::max(furthest, p.dot(end));
  Box box;
  for (const Vec3& p : mesh.vertices)
    if (p.dot(end) >= furthest - reach) box.add(p);
  return box;
}

Vec3 unit_along(const Vec3& v, Eigen::Index axis) {
  Vec3 unit = Vec3::Zero();
  unit[axis] = v[axis] < 0 ? -1 : 1;
  return unit;
}

/// How far forward along `axis` the femur's lower end lies between its condyles, seen from the whole of that end: the
/// notch there opens backward, and the groove of the patella is in front of it.
double groove_from_middle(const Mesh& femur, const Vec3& proximal, const Vec3& axis, const Vec3& sideways,
                          double width) {
  const Box end = box_near(femur, -proximal, kCondyleHeight * width);
  const double bottom = std::min(end.low.dot(proximal), end.high.dot(proximal));
  Box between;
  for (const Vec3& p : femur.vertices)
    if (p.dot(proximal) < bottom + kCondyleHeight * width &&
        std::abs((p - end.centre()).dot(sideways)) < kMiddleBand * width)
      between.add(p);
  return (between.centre() - end.centre()).dot(axis);
}

/// The larger of two halves of a bone's end, right less left, in how far they reach along `axis`: from their back to
/// their front, or, `front`, of the front alone. Their middle is that of the end, whose `rim` and middle strip count
/// for neither.
double right_less_left(const Mesh& mesh, const KneeLayout& knee, const Vec3& end, double reach, double rim,
                       bool front) {
  const Box whole = box_near(mesh, end, reach);
  const double middle = whole.centre().dot(knee.right), width = std::abs(whole.size().dot(knee.right));
  double furthest = -std::numeric_limits<double>::max();
  for (const Vec3& p : mesh.vertices) furthest = std::max(furthest, p.dot(end));
  Box halves[2];  // left, right
  for (const Vec3& p : mesh.vertices) {
    const double aside = p.dot(knee.right) - middle;
    if (p.dot(end) >= furthest - reach && std::abs(aside) > kMiddleStrip * width && std::abs(aside) < rim * width)
      halves[aside > 0 ? 1 : 0].add(p);
  }
  double size[2];
  for (int i = 0; i < 2; ++i) {
    if (halves[i].low[0] > halves[i].high[0]) return 0;
    const double a = halves[i].low.dot(knee.anterior), b = halves[i].high.dot(knee.anterior);
    size[i] = front ? std::max(a, b) : std::abs(b - a);
  }
  return size[1] - size[0];
}

double longest_edge(const Mesh& mesh) {
  double longest = 0;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      longest = std::max(longest, (mesh.vertices[static_cast<std::size_t>(t[k])] -
                                   mesh.vertices[static_cast<std::size_t>(t[(k + 1) % 3])])
                                      .norm());
  return longest;
}

using GridCell = std::pair<long, long>;

/// The furthest that a mesh reaches in the direction `way`, in each cell of a grid across it.
std::map<GridCell, double> furthest_in_cells(const Mesh& mesh, const KneeLayout& knee, const Vec3& way, double cell) {
  std::map<GridCell, double> out;
  auto last = out.end();  // most points lie in the cell of the one before
  const auto add = [&](const Vec3& p) {
    const GridCell at{std::lround(p.dot(knee.right) / cell), std::lround(p.dot(knee.anterior) / cell)};
    if (last == out.end() || last->first != at) last = out.try_emplace(at, p.dot(way)).first;
    last->second = std::max(last->second, p.dot(way));
  };
  // Triangles larger than a cell would leave cells empty: each is filled with points no further apart than one.
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[static_cast<std::size_t>(t[0])], &b = mesh.vertices[static_cast<std::size_t>(t[1])],
               &c = mesh.vertices[static_cast<std::size_t>(t[2])];
    const double longest = std::sqrt(std::max({(b - a).squaredNorm(), (c - a).squaredNorm(), (c - b).squaredNorm()}));
    const int parts = std::clamp(static_cast<int>(std::ceil(2 * longest / cell)), 1, 200);
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; j + i <= parts; ++j) add(a + (b - a) * i / parts + (c - a) * j / parts);
  }
  return out;
}

/// How the two stand to each other along proximal: the least distance between what faces each other.
void look_along_proximal(const Mesh& femur, const Mesh& tibia, KneeLayout& knee) {
  const double cell = knee.width / 60;
  const auto low = furthest_in_cells(femur, knee, -knee.proximal, cell),
             high = furthest_in_cells(tibia, knee, knee.proximal, cell);
  double gap = std::numeric_limits<double>::max();
  std::size_t facing = 0;
  for (const auto& [at, height] : high)
    if (const auto above = low.find(at); above != low.end()) {
      gap = std::min(gap, -above->second - height);
      ++facing;
    }
  knee.gap = facing > 0 ? gap : 0;
  knee.facing = static_cast<double>(facing) / static_cast<double>(high.size());
}

}  // namespace

std::optional<Vec3> axis_named(const std::string& word) {
  const bool minus = word.size() == 2 && word[0] == '-';
  const std::size_t axis = std::string("xyz").find(word.empty() ? ' ' : word.back());
  if (word.size() != (minus ? 2u : 1u) || axis == std::string::npos) return std::nullopt;
  return Vec3(Vec3::Unit(static_cast<Eigen::Index>(axis)) * (minus ? -1 : 1));
}

std::string axis_word(const Vec3& axis) {
  Eigen::Index i = 0;
  axis.cwiseAbs().maxCoeff(&i);
  return std::string(axis[i] < 0 ? "-" : "") + "xyz"[i];
}

std::optional<KneeLayout> lay_out_knee(const Mesh& femur, const Mesh& tibia, std::optional<Vec3> proximal,
                                       std::optional<Vec3> anterior) {
  if (!(longest_edge(femur) > 0) || !(longest_edge(tibia) > 0)) return std::nullopt;
  const double everything = std::numeric_limits<double>::max();
  KneeLayout knee;
  if (!proximal) {
    const Vec3 up =
        box_near(femur, Vec3::UnitX(), everything).centre() - box_near(tibia, Vec3::UnitX(), everything).centre();
    Eigen::Index axis = 0;
    // What is known to be anterior is not up.
    (anterior ? Vec3(up.array() * (1 - anterior->array().abs())) : up).cwiseAbs().maxCoeff(&axis);
    proximal = unit_along(up, axis);
  }
  knee.proximal = *proximal;
  // Of whole bones the joint's end.
  const Vec3 whole = box_near(tibia, Vec3::UnitX(), everything).size();
  const double across = (whole - whole.cwiseProduct(knee.proximal.cwiseAbs())).maxCoeff();
  const Box plateau = box_near(tibia, knee.proximal, 0.5 * across);
  const Vec3 wide = plateau.size() - plateau.size().cwiseProduct(knee.proximal.cwiseAbs());
  if (!anterior) {
    Eigen::Index sideways = 0;
    wide.maxCoeff(&sideways);
    const Vec3 forth = knee.proximal.cross(Vec3::Unit(sideways));
    const bool front = groove_from_middle(femur, knee.proximal, forth, Vec3::Unit(sideways), wide.maxCoeff()) > 0;
    anterior = front ? forth : Vec3(-forth);
  }
  knee.anterior = *anterior;
  if (std::abs(knee.anterior.dot(knee.proximal)) > 0) return std::nullopt;
  knee.right = knee.anterior.cross(knee.proximal);
  knee.width = std::abs(plateau.size().dot(knee.right));
  knee.depth = std::abs(plateau.size().dot(knee.anterior));
  if (!(knee.width > 0) || !(knee.depth > 0)) return std::nullopt;
  knee.centre = plateau.centre();
  knee.centre += knee.proximal * (std::max(plateau.low.dot(knee.proximal), plateau.high.dot(knee.proximal)) -
                                  knee.centre.dot(knee.proximal));
  look_along_proximal(femur, tibia, knee);
  knee.ridge = right_less_left(femur, knee, -knee.proximal, kRidgeHeight * knee.width, kRidgeRim, true);
  knee.plateau = right_less_left(tibia, knee, knee.proximal, kPlateauHeight * knee.width, 1, false);
  return knee;
}

}  // namespace genu
