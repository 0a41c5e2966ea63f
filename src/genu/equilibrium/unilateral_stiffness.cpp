#include "genu/equilibrium/unilateral_stiffness.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "genu/core/decompositions.h"
#include "genu/equilibrium/feasible_direction.h"
#include "genu/equilibrium/tolerances.h"

namespace genu {
namespace {

MatX symmetric_part(const MatX& K) { return (K + K.transpose()) / 2; }

bool along(const VecX& v, const VecX& row) { return (v - v.dot(row) * row).norm() <= kSymmetryRounding * v.norm(); }

/// Whether the stiffness is symmetric on both sides.
bool symmetric(const Side& side) { return along(side.below, side.row) && along(side.above, side.row); }

/// Merges coincident planes, with equal or opposite normals.
std::vector<Side> merged(const std::vector<Side>& sides) {
  std::vector<Side> out;
  for (const Side& side : sides) {
    const auto same = std::find_if(out.begin(), out.end(), [&](const Side& other) {
      return !other.closed && !side.closed &&
             std::min((other.row - side.row).norm(), (other.row + side.row).norm()) <= kParallelRows;
    });
    if (same == out.end()) {
      out.push_back(side);
    } else if (same->row.dot(side.row) > 0) {
      same->below += side.below;
      same->above += side.above;
    } else {
      same->below -= side.above;
      same->above -= side.below;
    }
  }
  return out;
}

/// Motions of one eigenvalue, orthonormal columns; of a complex pair both parts.
struct Eigenspace {
  double value = 0;
  bool complex = false;
  MatX motions;
};

/// In ascending order. Eigenvalues closer than `known_to` are merged.
std::vector<Eigenspace> eigenspaces(const MatX& K, double known_to) {
  std::vector<Eigenspace> out;
  const auto add = [&](double value, bool complex, const VecX& motion) {
    if (out.empty() || value - out.back().value > known_to || complex != out.back().complex)
      out.push_back({value, complex, MatX(K.rows(), 0)});
    MatX& motions = out.back().motions;
    const VecX rest = motion.normalized() - motions * (motions.transpose() * motion.normalized());
    if (!(rest.norm() > kNewEigenvector)) return;
    motions.conservativeResize(Eigen::NoChange, motions.cols() + 1);
    motions.rightCols<1>() = rest.normalized();
  };
  if ((K - K.transpose()).norm() <= std::max(known_to, kSymmetryRounding * K.norm())) {
    const auto eigen = symmetric_eigen(symmetric_part(K));
    for (Eigen::Index i = 0; i < eigen.values.size(); ++i) add(eigen.values[i], false, eigen.vectors.col(i));
    return out;
  }
  const GeneralEigen eigen = general_eigen(K);
  std::vector<Eigen::Index> order;
  for (Eigen::Index i = 0; i < eigen.values.size(); ++i) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index i, Eigen::Index j) { return eigen.values[i].real() < eigen.values[j].real(); });
  for (const Eigen::Index i : order) {
    const std::complex<double> value = eigen.values[i];
    const bool complex = std::abs(value.imag()) > known_to;
    const Eigen::VectorXcd motion = eigen.vectors.col(i);
    if (value.imag() >= 0 || complex) add(value.real(), complex, motion.real());
    if (value.imag() != 0) add(value.real(), complex, motion.imag());
  }
  return out;
}

class Search {
 public:
  explicit Search(UnilateralStiffness at) : at_(std::move(at)) {
    at_.sides = merged(at_.sides);
    // Unsymmetric sides first: their cost has no bound before they are decided.
    std::stable_partition(at_.sides.begin(), at_.sides.end(), [](const Side& s) { return !symmetric(s); });
    double stiffest = at_.stiffness.norm();
    for (const Side& s : at_.sides) stiffest += std::max(s.below.norm(), s.above.norm());
    nothing_ = std::max(at_.nothing * stiffest, at_.known_to);
    symmetric_ =
        (at_.stiffness - at_.stiffness.transpose()).norm() <= std::max(at_.known_to, kSymmetryRounding * stiffest) &&
        std::all_of(at_.sides.begin(), at_.sides.end(), symmetric);
    out_.free.resize(at_.stiffness.rows(), 0);
  }

  LeastCost run() {
    std::vector<Is> is(at_.sides.size(), Is::undecided);
    look(is, VecX());
    return std::move(out_);
  }

 private:
  enum class Is { undecided, below, above };  ///< of a closed plane, `above`: motions lie in it

  /// The stiffness with decided sides, undecided ones on their softer side, and the bounds on motions.
  struct Case {
    MatX stiffness, within, bounds;
  };

  Case case_of(const std::vector<Is>& is) const {
    Case out{at_.stiffness, MatX(0, at_.stiffness.rows()), MatX(0, at_.stiffness.rows())};
    const auto append = [](const VecX& row, MatX& rows) {
      rows.conservativeResize(rows.rows() + 1, Eigen::NoChange);
      rows.bottomRows<1>() = row.transpose();
    };
    for (std::size_t i = 0; i < is.size(); ++i) {
      const Side& side = at_.sides[i];
      if (!side.closed) {
        const bool softer_above = side.above.dot(side.row) < side.below.dot(side.row);
        const bool above = is[i] == Is::above || (is[i] == Is::undecided && softer_above);
        out.stiffness += (above ? side.above : side.below) * side.row.transpose();
      }
      if (is[i] == Is::undecided) continue;
      if (side.closed && is[i] == Is::above)
        append(side.row, out.within);
      else
        append(is[i] == Is::above ? VecX(-side.row) : side.row, out.bounds);
    }
    return out;
  }

  /// Distance of a motion into the stiffer side, times the difference in stiffness; distance beyond a closed plane.
  static double wrong(const Side& side, const VecX& motion) {
    const double past = side.row.dot(motion);
    return std::max(0.0, side.closed ? past : past * (side.above - side.below).dot(side.row));
  }

  /// The side to decide next: the first unsymmetric one, else the one that `motion` violates most, else any. The number
  /// of sides where all are decided.
  std::size_t next(const std::vector<Is>& is, const VecX& motion) const {
    std::size_t out = is.size(), any = is.size();
    double farthest = 0;
    for (std::size_t i = 0; i < is.size(); ++i) {
      if (is[i] != Is::undecided) continue;
      const Side& side = at_.sides[i];
      if (!symmetric(side)) return i;
      any = i;
      if (const double by = wrong(side, motion); by > farthest) {
        farthest = by;
        out = i;
      }
    }
    return out < is.size() ? out : any;
  }

  void look(std::vector<Is>& is, const VecX& known) {
    if (!out_.told) return;
    if (++out_.cases > kMaxStabilityCases) {
      out_.told = false;
      return;
    }
    const Case here = case_of(is);
    const MatX basis = null_space(here.within, kParallelRows);
    if (basis.cols() == 0) return;
    // A motion known to lie on these sides saves a search. A combination without interior is covered by its neighbours.
    VecX inside = known;
    const bool known_inside = inside.size() > 0 && here.within.rows() == 0 &&
                              (here.bounds.rows() == 0 || (here.bounds * inside).maxCoeff() < -kInsideCone);
    if (!known_inside) inside = interior_direction(here.bounds, basis);
    if (inside.isZero(0)) return;
    const MatX K = basis.transpose() * here.stiffness * basis;
    const bool bounded = symmetric_;  // else a complex pair may occur where no cost is low
    VecX softest = inside;
    if (bounded) {
      const auto eigen = symmetric_eigen(symmetric_part(K));
      if (eigen.values[0] > std::max(nothing_, out_.any ? out_.cost : eigen.values[0])) return;
      softest = basis * eigen.vectors.col(0);
    }
    const std::size_t i = next(is, softest);
    if (i == is.size()) {
      take(here, basis, K);
      return;
    }
    if (symmetric_ && take_softest(is, here.bounds, softest, softest.dot(here.stiffness * softest))) return;
    // First the side that the softest motion takes.
    const bool above_first = at_.sides[i].row.dot(softest) > 0;
    for (const bool above : {above_first, !above_first}) {
      is[i] = above ? Is::above : Is::below;
      look(is, inside);
      is[i] = Is::undecided;
    }
  }

  /// Whether the softest motion lies on the softer side of everything undecided: then no other motion on these sides
  /// costs less, and none has zero cost.
  bool take_softest(const std::vector<Is>& is, const MatX& bounds, const VecX& softest, double cost) {
    if (cost <= nothing_) return false;
    for (const double sign : {1.0, -1.0}) {
      const VecX motion = sign * softest;
      bool soft = within(bounds, motion);
      for (std::size_t i = 0; i < is.size(); ++i)
        soft = soft && (is[i] != Is::undecided || wrong(at_.sides[i], motion) == 0);
      if (!soft) continue;
      keep(cost, false, motion);
      return true;
    }
    return false;
  }

  void keep(double cost, bool oscillates, const VecX& motion) {
    if (out_.any && cost >= out_.cost) return;
    out_.any = true;
    out_.cost = cost;
    out_.oscillates = oscillates;
    out_.motion = motion;
  }

  /// For a combination with all sides decided.
  void take(const Case& here, const MatX& basis, const MatX& K) {
    const double nothing = std::max(at_.nothing * K.norm(), at_.known_to);
    for (const Eigenspace& space : eigenspaces(K, nothing)) {
      out_.complex_pair = out_.complex_pair || space.complex;
      const MatX motions = basis * space.motions;
      const bool costs = std::abs(space.value) > nothing;
      if (!costs && !space.complex)
        add_free(here.bounds, motions);
      else if (const VecX motion = allowed(here.bounds, motions); motion.size() > 0)
        keep(costs ? space.value : 0, space.complex, motion);
    }
  }

  void add_free(const MatX& bounds, const MatX& motions) {
    const auto add = [this](const VecX& motion) {
      if (motion.size() == 0) return;
      const MatX& free = out_.free;
      const VecX rest = free.cols() == 0 ? motion : VecX(motion - free * minimum_norm_solution(free, motion));
      if (rest.norm() <= kNewFreeMotion) return;
      out_.free.conservativeResize(Eigen::NoChange, free.cols() + 1);
      out_.free.rightCols<1>() = motion;
    };
    for (Eigen::Index k = 0; k < motions.cols(); ++k) add(allowed(bounds, motions.col(k)));
    add(allowed(bounds, motions));
  }

  UnilateralStiffness at_;
  double nothing_ = 0;
  bool symmetric_ = true;
  LeastCost out_;
};

}  // namespace

VecX allowed(const MatX& bounds, const MatX& motions) {
  if (motions.cols() == 0) return {};
  for (Eigen::Index k = 0; k < motions.cols(); ++k)
    for (const double sign : {1.0, -1.0})
      if (const VecX motion = sign * motions.col(k); within(bounds, motion)) return motion;
  if (motions.cols() == 1) return {};
  if (const MatX along = null_space(bounds * motions, kParallelRows); along.cols() > 0) {
    const VecX motion = motions * along.col(0);
    if (within(bounds, motion)) return motion.normalized();
  }
  if (const VecX motion = feasible_direction(bounds, motions); !motion.isZero(0)) return motion.normalized();
  return {};
}

LeastCost least_cost(UnilateralStiffness at) { return Search(std::move(at)).run(); }

}  // namespace genu
