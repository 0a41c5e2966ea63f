#include "genu/equilibrium/block_pattern.h"

#include <algorithm>

#include "genu/equilibrium/tolerances.h"

namespace genu {
namespace {

using Table = std::vector<std::vector<char>>;

std::vector<int> bodies_of(const Coupling& coupled, int group) {
  std::vector<int> out;
  for (int body = 0; body < coupled.bodies(); ++body)
    if (coupled(group, body)) out.push_back(body);
  return out;
}

bool narrow(const std::vector<int>& bodies) { return bodies.size() <= kBodiesOfNarrowRow; }

/// Bodies that couple themselves, or through one more row.
Table coupled_bodies(const Coupling& coupled) {
  const int n = coupled.bodies();
  Table out(at(n), std::vector<char>(at(n), 0));
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) out[at(a)][at(b)] = coupled(a, b) ? 1 : 0;
  for (int row = n; row < coupled.groups(); ++row) {
    const std::vector<int> bodies = bodies_of(coupled, row);
    if (!narrow(bodies)) continue;
    for (const int a : bodies)
      for (const int b : bodies) out[at(a)][at(b)] = 1;
  }
  return out;
}

/// Eliminates node `a` from a graph: what it couples to couples from then on.
std::vector<int> eliminate_from(Table& graph, int a, const std::vector<char>& done) {
  std::vector<int> left;
  for (int b = 0; b < static_cast<int>(graph.size()); ++b)
    if (b != a && graph[at(a)][at(b)] != 0 && done[at(b)] == 0) left.push_back(b);
  for (const int b : left)
    for (const int c : left) graph[at(b)][at(c)] = 1;
  return left;
}

std::vector<int> order_of(Table graph) {
  const int n = static_cast<int>(graph.size());
  std::vector<char> done(at(n), 0);
  std::vector<int> out;
  while (static_cast<int>(out.size()) < n) {
    int best = -1;
    long least = 0;
    for (int a = 0; a < n; ++a) {
      if (done[at(a)] != 0) continue;
      long degree = 0;
      for (int b = 0; b < n; ++b) degree += b != a && graph[at(a)][at(b)] != 0 && done[at(b)] == 0 ? 1 : 0;
      if (best < 0 || degree < least) {
        best = a;
        least = degree;
      }
    }
    out.push_back(best);
    done[at(best)] = 1;
    eliminate_from(graph, best, done);
  }
  return out;
}

/// The groups of each node.
std::vector<std::vector<int>> nodes_of(const Coupling& coupled, const std::vector<int>& order) {
  std::vector<std::vector<int>> out(order.size());
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    out[k].push_back(order[k]);
    place[at(order[k])] = static_cast<int>(k);
  }
  for (int row = coupled.bodies(); row < coupled.groups(); ++row) {
    const std::vector<int> bodies = bodies_of(coupled, row);
    std::size_t node = out.size() - 1;
    if (narrow(bodies))
      for (const int body : bodies)
        if (const std::size_t k = at(place[at(body)]); k < node && out[k].size() < 7) node = k;
    out[node].push_back(row);
  }
  return out;
}

}  // namespace

Coupling::Coupling(int bodies, int others)
    : bodies_(bodies), groups_(bodies + others), coupled_(at(groups_) * at(groups_), 2) {}

/// What is no number counts as an entry.
bool Coupling::any(const MatX& matrix, int a, int b) const {
  if (a < bodies_ && b < bodies_) return matrix.block<6, 6>(6 * a, 6 * b).cwiseAbs().sum() != 0;
  return matrix.block(first(a), first(b), count(a), count(b)).cwiseAbs().sum() != 0;
}

bool Coupling::look_at(const MatX& matrix) {
  bool differs = false;
  for (int b = 0; b < groups_; ++b)
    for (int a = 0; a <= b; ++a) {
      const char now = any(matrix, a, b) || any(matrix, b, a) ? 1 : 0;
      char &up = coupled_[at(a * groups_ + b)], &down = coupled_[at(b * groups_ + a)];
      differs = differs || up != now;
      up = down = now;
    }
  return differs;
}

BlockPattern block_pattern(const Coupling& coupled) {
  const auto nodes = nodes_of(coupled, order_of(coupled_bodies(coupled)));
  const int n = static_cast<int>(nodes.size());
  Table graph(at(n), std::vector<char>(at(n), 0));
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b)
      for (const int i : nodes[at(a)])
        for (const int j : nodes[at(b)])
          if (coupled(i, j)) graph[at(a)][at(b)] = 1;
  BlockPattern out;
  std::vector<char> done(at(n), 0);
  for (int a = 0; a < n; ++a) {
    done[at(a)] = 1;
    out.later.push_back(eliminate_from(graph, a, done));
    std::vector<int>& rows = out.rows.emplace_back();
    for (const int group : nodes[at(a)]) {
      if (group >= coupled.bodies()) rows.push_back(5 * coupled.bodies() + group);
      for (int i = 0; group < coupled.bodies() && i < 6; ++i) rows.push_back(6 * group + i);
    }
  }
  return out;
}

}  // namespace genu
