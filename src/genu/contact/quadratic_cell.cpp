#include "genu/contact/quadratic_cell.h"

#include "genu/contact/clipped_triangle.h"

namespace genu {
namespace {

constexpr int kPlaces = 15;         // of the lattice with 4 divisions
constexpr std::size_t kCoarse = 4;  // triangles of 2 divisions; the others have 4

using AtPlaces = Eigen::Matrix<double, kPlaces, 1>;

struct Piece {
  std::array<Eigen::Index, 3> corners;  // in the lattice
  Eigen::Matrix<double, 3, 6> shares;   // shape functions of the nodes at them
  double weight;                        // of Richardson's extrapolation
};

struct Lattice {
  Eigen::Matrix<double, kPlaces, 6> shares;
  std::array<Piece, 20> pieces;
};

Eigen::Index place(int i, int j) { return j * 5 - j * (j - 1) / 2 + i; }

Lattice make_lattice() {
  Lattice out;
  for (int j = 0; j <= 4; ++j)
    for (int i = 0; i + j <= 4; ++i) out.shares.row(place(i, j)) = quadratic_shares(i / 4.0, j / 4.0).transpose();
  std::size_t k = 0;
  const auto add = [&](Eigen::Index a, Eigen::Index b, Eigen::Index c) {
    Piece& piece = out.pieces[k];
    piece.corners = {a, b, c};
    for (Eigen::Index i = 0; i < 3; ++i)
      piece.shares.row(i) = out.shares.row(piece.corners[static_cast<std::size_t>(i)]);
    piece.weight = k < kCoarse ? -1.0 / 3 : 4.0 / 3;
    ++k;
  };
  for (const int stride : {2, 1})
    for (int j = 0; j < 4; j += stride)
      for (int i = 0; i + j < 4; i += stride) {
        const Eigen::Index b = place(i + stride, j), c = place(i, j + stride);
        add(place(i, j), b, c);
        if (i + j + 2 * stride <= 4) add(b, place(i + stride, j + stride), c);
      }
  return out;
}

const Lattice& lattice() {
  static const Lattice kLattice = make_lattice();
  return kLattice;
}

void add_piece(const Piece& piece, const ClippedIntegrals& part, CellIntegrals& out) {
  out.mass.noalias() += piece.shares.transpose() * (piece.weight * part.mass * piece.shares);
  out.share.noalias() += piece.shares.transpose() * (piece.weight * part.share);
}

}  // namespace

QuadraticCell::QuadraticCell(const SixPlaces& x) {
  std::array<Vec3, kPlaces> at;
  for (Eigen::Index q = 0; q < kPlaces; ++q) {
    at[static_cast<std::size_t>(q)].setZero();
    for (Eigen::Index i = 0; i < 6; ++i)
      at[static_cast<std::size_t>(q)] += lattice().shares(q, i) * x[static_cast<std::size_t>(i)];
  }
  for (std::size_t k = 0; k < areas_.size(); ++k) {
    const Piece& piece = lattice().pieces[k];
    const Vec3 &a = at[static_cast<std::size_t>(piece.corners[0])], &b = at[static_cast<std::size_t>(piece.corners[1])],
               &c = at[static_cast<std::size_t>(piece.corners[2])];
    areas_[k] = 0.5 * (b - a).cross(c - a).norm();
    ClippedIntegrals part;
    clipped_integrals(areas_[k], Vec3::Ones(), part);
    add_piece(piece, part, whole_);
    removed_ += (k < kCoarse ? -4.0 : 4.0) / 3 * piece.shares.transpose() * part.mass.rowwise().sum();
  }
}

QuadraticCell::Part QuadraticCell::integrate(const Vec6& p, CellIntegrals& out, double& removed) const {
  const AtPlaces at = lattice().shares * p;
  if (at.minCoeff() > 0) {
    removed = removed_.dot(p);
    return Part::whole;
  }
  out = {};
  removed = 0;
  bool some = false;
  for (std::size_t k = 0; k < areas_.size(); ++k) {
    const Piece& piece = lattice().pieces[k];
    const Vec3 here(at[piece.corners[0]], at[piece.corners[1]], at[piece.corners[2]]);
    ClippedIntegrals part;
    if (!clipped_integrals(areas_[k], here, part)) continue;
    some = true;
    add_piece(piece, part, out);
    removed += (k < kCoarse ? -4.0 : 4.0) / 3 * part.mass.colwise().sum().dot(here);
  }
  return some ? Part::some : Part::none;
}

}  // namespace genu
