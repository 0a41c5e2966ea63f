// Vectors, matrices and poses for an archive that saves and restores them to the last bit on the same machine. The
// archive is any object with operator()(fields ...), such as cereal's binary archives.
#pragma once

#include <cstdint>

#include "genu/core/pose.h"

namespace Eigen {

template <typename Archive, int Rows, int Columns, int Options, int MostRows, int MostColumns>
void save(Archive& archive, const Matrix<double, Rows, Columns, Options, MostRows, MostColumns>& m) {
  archive(static_cast<std::int64_t>(m.rows()), static_cast<std::int64_t>(m.cols()));
  for (Index i = 0; i < m.size(); ++i) archive(m.data()[i]);
}

template <typename Archive, int Rows, int Columns, int Options, int MostRows, int MostColumns>
void load(Archive& archive, Matrix<double, Rows, Columns, Options, MostRows, MostColumns>& m) {
  std::int64_t rows = 0, columns = 0;
  archive(rows, columns);
  m.resize(rows, columns);
  for (Index i = 0; i < m.size(); ++i) archive(m.data()[i]);
}

}  // namespace Eigen

namespace genu {

template <typename Archive>
void serialize(Archive& a, Pose& x) {
  a(x.R, x.p);
}

}  // namespace genu
