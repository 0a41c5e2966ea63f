#include "studies/mesh_picture.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace genu::studies {
namespace {

constexpr double kMargin = 12;     // pixels
constexpr double kDarkest = 0.35;  // of the colour, where the lamp does not shine

/// A triangle as it is seen: pixels right and up, how near, and what it looks like.
struct Seen {
  std::array<Vec2, 3> corners;
  double near = 0;
  std::array<int, 3> colour{};
};

class View {
 public:
  View(const PictureView& view, const std::vector<PictureMesh>& meshes) {
    const Vec3 toward = view.right.cross(view.up), lamp = (toward + 0.6 * view.up - 0.5 * view.right).normalized();
    for (const PictureMesh& m : meshes)
      for (const auto& t : m.mesh->triangles) {
        std::array<Vec3, 3> p;
        for (std::size_t i = 0; i < 3; ++i) p[i] = m.pose * m.mesh->vertices[at(t[i])];
        const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]);
        if (!(normal.dot(toward) > 0)) continue;
        const double light = kDarkest + (1 - kDarkest) * std::max(0.0, normal.normalized().dot(lamp));
        Seen seen;
        for (std::size_t i = 0; i < 3; ++i) {
          seen.corners[i] = {view.right.dot(p[i]), view.up.dot(p[i])};
          seen.near += toward.dot(p[i]) / 3;
          seen.colour[i] = static_cast<int>(255 * light * m.colour[i] + 0.5);
          low_ = low_.cwiseMin(seen.corners[i]);
          high_ = high_.cwiseMax(seen.corners[i]);
        }
        seen_.push_back(seen);
      }
    std::stable_sort(seen_.begin(), seen_.end(), [](const Seen& a, const Seen& b) { return a.near < b.near; });
  }

  Vec2 size() const { return seen_.empty() ? Vec2(Vec2::Zero()) : Vec2(high_ - low_); }

  void draw(double left, double height, double scale, std::string& out) const {
    const double bottom = 0.5 * (height + scale * size()[1]);
    for (const Seen& s : seen_) {
      out += "<path d=\"M";
      for (const Vec2& c : s.corners)
        out += fmt::format("{}{:.1f} {:.1f}", &c == s.corners.data() ? "" : "L", left + scale * (c[0] - low_[0]),
                           bottom - scale * (c[1] - low_[1]));
      const std::string colour = fmt::format("#{:02x}{:02x}{:02x}", s.colour[0], s.colour[1], s.colour[2]);
      out += fmt::format("Z\" fill=\"{0}\" stroke=\"{0}\"/>\n", colour);
    }
  }

 private:
  std::vector<Seen> seen_;
  Vec2 low_ = Vec2::Constant(std::numeric_limits<double>::infinity()), high_ = -low_;
};

}  // namespace

std::string mesh_picture(const std::vector<PictureMesh>& meshes, const std::vector<PictureView>& views, int height) {
  std::vector<View> drawn;
  double tallest = 0, wide = 0;
  for (const PictureView& view : views) {
    drawn.emplace_back(view, meshes);
    tallest = std::max(tallest, drawn.back().size()[1]);
    wide += drawn.back().size()[0];
  }
  const double scale = tallest > 0 ? (height - 2 * kMargin) / tallest : 1;
  const double width = scale * wide + kMargin * static_cast<double>(1 + views.size());
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1}\" width=\"{0:.0f}\" height=\"{1}\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<g stroke-width=\"0.6\" stroke-linejoin=\"round\">\n",
      width, height);
  double left = kMargin;
  for (const View& view : drawn) {
    view.draw(left, height, scale, out);
    left += scale * view.size()[0] + kMargin;
  }
  return out + "</g>\n</svg>\n";
}

}  // namespace genu::studies
