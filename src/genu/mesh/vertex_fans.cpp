#include "genu/mesh/vertex_fans.h"

#include <algorithm>
#include <vector>

#include "genu/mesh/tolerances.h"
#include "genu/mesh/vertex_triangles.h"

namespace genu {
namespace {

bool share_spoke(const std::array<int, 3>& s, const std::array<int, 3>& t, int v) {
  return std::any_of(s.begin(), s.end(), [&](int w) { return w != v && std::find(t.begin(), t.end(), w) != t.end(); });
}

/// Calls visit(v, fans) for every vertex of more than one fan; a fan is a list of triangles.
template <class Visit>
void for_each_pinched(const Mesh& mesh, Visit&& visit) {
  const VertexTriangles around(mesh);
  std::vector<int> left;
  std::vector<std::vector<int>> fans;
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v) {
    left.assign(around.of(v).begin(), around.of(v).end());
    fans.clear();
    while (!left.empty()) {
      std::vector<int>& fan = fans.emplace_back(1, left.front());
      left.erase(left.begin());
      for (std::size_t head = 0; head < fan.size(); ++head)
        for (std::size_t k = 0; k < left.size();) {
          if (!share_spoke(mesh.triangles[at(fan[head])], mesh.triangles[at(left[k])], v)) {
            ++k;
            continue;
          }
          fan.push_back(left[k]);
          left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
        }
    }
    if (fans.size() > 1) visit(v, fans);
  }
}

}  // namespace

std::size_t split_fans(Mesh& mesh) {
  struct Split {
    int vertex;
    std::vector<int> fan;
  };
  std::vector<Split> splits;
  std::size_t pinched = 0;
  for_each_pinched(mesh, [&](int v, const std::vector<std::vector<int>>& fans) {
    ++pinched;
    for (std::size_t k = 1; k < fans.size(); ++k) splits.push_back({v, fans[k]});
  });
  for (const Split& split : splits) {
    const int fresh = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(Vec3(mesh.vertices[at(split.vertex)]));
    for (const int t : split.fan)
      std::replace(mesh.triangles[at(t)].begin(), mesh.triangles[at(t)].end(), split.vertex, fresh);
  }
  return pinched;
}

std::size_t drop_small_fans(Mesh& mesh) {
  const std::size_t before = mesh.triangles.size();
  for (int round = 0; round < kMaxFanRounds; ++round) {
    std::vector<char> gone(mesh.triangles.size(), 0);
    bool any = false;
    for_each_pinched(mesh, [&](int, const std::vector<std::vector<int>>& fans) {
      const auto largest =
          std::max_element(fans.begin(), fans.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
      for (auto fan = fans.begin(); fan != fans.end(); ++fan)
        if (fan != largest)
          for (const int t : *fan) gone[at(t)] = 1, any = true;
    });
    if (!any) break;
    std::size_t index = 0;
    std::erase_if(mesh.triangles, [&](const auto&) { return gone[index++] != 0; });
  }
  return before - mesh.triangles.size();
}

}  // namespace genu
