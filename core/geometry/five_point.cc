// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/five_point.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <array>
#include <cmath>

#include "core/geometry/real_roots.h"

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Polynomials in (x, y, z) as arrays of coefficients; E = x E0 + y E1 + z E2 + E3.
struct Monomial {
  int x, y, z;
  friend constexpr bool operator==(const Monomial&, const Monomial&) = default;
};
constexpr std::array<Monomial, 4> kLinear = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}};
constexpr std::array<Monomial, 10> kQuadratic = {{{2, 0, 0},
                                                  {1, 1, 0},
                                                  {0, 2, 0},
                                                  {1, 0, 1},
                                                  {0, 1, 1},
                                                  {0, 0, 2},
                                                  {1, 0, 0},
                                                  {0, 1, 0},
                                                  {0, 0, 1},
                                                  {0, 0, 0}}};
/// Nister's order: the first ten are eliminated, the others are x, y or 1 times a power of z.
constexpr std::array<Monomial, 20> kCubic = {
    {{3, 0, 0}, {0, 3, 0}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}, {2, 0, 0}, {0, 2, 1},
     {0, 2, 0}, {1, 1, 1}, {1, 1, 0}, {1, 0, 2}, {1, 0, 1}, {1, 0, 0}, {0, 1, 2},
     {0, 1, 1}, {0, 1, 0}, {0, 0, 3}, {0, 0, 2}, {0, 0, 1}, {0, 0, 0}}};

/// products[i][j]: index in `result` of left[i] * right[j].
template <size_t L, size_t R, size_t N>
constexpr std::array<std::array<int, R>, L> ProductTable(const std::array<Monomial, L>& left,
                                                         const std::array<Monomial, R>& right,
                                                         const std::array<Monomial, N>& result) {
  std::array<std::array<int, R>, L> products{};
  for (size_t i = 0; i < L; ++i) {
    for (size_t j = 0; j < R; ++j) {
      const Monomial product = {
          left[i].x + right[j].x, left[i].y + right[j].y, left[i].z + right[j].z};
      for (size_t k = 0; k < N; ++k) {
        if (result[k] == product) products[i][j] = static_cast<int>(k);
      }
    }
  }
  return products;
}
constexpr auto kLinearTimesLinear = ProductTable(kLinear, kLinear, kQuadratic);
constexpr auto kQuadraticTimesLinear = ProductTable(kQuadratic, kLinear, kCubic);

using Linear = std::array<double, 4>;
using Quadratic = std::array<double, 10>;
using Cubic = std::array<double, 20>;

void AddProduct(const Linear& a, const Linear& b, double sign, Quadratic& sum) {
  for (size_t i = 0; i < 4; ++i) {
    for (size_t j = 0; j < 4; ++j) sum[kLinearTimesLinear[i][j]] += sign * a[i] * b[j];
  }
}

void AddProduct(const Quadratic& a, const Linear& b, Cubic& sum) {
  for (size_t i = 0; i < 10; ++i) {
    for (size_t j = 0; j < 4; ++j) sum[kQuadraticTimesLinear[i][j]] += a[i] * b[j];
  }
}

using NullSpace = std::array<Matrix3d, 4>;
using LinearMatrix = std::array<std::array<Linear, 3>, 3>;

NullSpace EpipolarNullSpace(std::span<const Vector3d, 5> a, std::span<const Vector3d, 5> b) {
  Eigen::Matrix<double, 9, 5> equations;  // one column per pair, E by rows
  for (int i = 0; i < 5; ++i) {
    for (int row = 0; row < 3; ++row) equations.col(i).segment<3>(3 * row) = b[i][row] * a[i];
  }
  const Eigen::HouseholderQR<Eigen::Matrix<double, 9, 5>> qr(equations);
  Eigen::Matrix<double, 9, 4> last = Eigen::Matrix<double, 9, 4>::Zero();
  last.bottomRows<4>().setIdentity();
  const Eigen::Matrix<double, 9, 4> basis = qr.householderQ() * last;
  NullSpace null_space;
  for (int k = 0; k < 4; ++k) {
    for (int row = 0; row < 3; ++row)
      null_space[k].row(row) = basis.col(k).segment<3>(3 * row).transpose();
  }
  return null_space;
}

/// E E^T - tr(E E^T) / 2, symmetric.
std::array<std::array<Quadratic, 3>, 3> HalfTracelessSquare(const LinearMatrix& E) {
  std::array<std::array<Quadratic, 3>, 3> square{};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = i; j < 3; ++j) {
      for (size_t k = 0; k < 3; ++k) AddProduct(E[i][k], E[j][k], 1.0, square[i][j]);
      square[j][i] = square[i][j];
    }
  }
  for (size_t m = 0; m < 10; ++m) {
    const double half_trace = 0.5 * (square[0][0][m] + square[1][1][m] + square[2][2][m]);
    for (size_t i = 0; i < 3; ++i) square[i][i][m] -= half_trace;
  }
  return square;
}

Cubic Determinant(const LinearMatrix& E) {
  Cubic det{};
  for (size_t k = 0; k < 3; ++k) {
    Quadratic minor{};
    AddProduct(E[1][(k + 1) % 3], E[2][(k + 2) % 3], 1.0, minor);
    AddProduct(E[1][(k + 2) % 3], E[2][(k + 1) % 3], -1.0, minor);
    AddProduct(minor, E[0][k], det);
  }
  return det;
}

/// The ten cubic constraints, one per row.
Eigen::Matrix<double, 10, 20> Constraints(const NullSpace& null_space) {
  LinearMatrix E{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (size_t k = 0; k < 4; ++k) E[i][j][k] = null_space[k](i, j);
    }
  }
  const auto square = HalfTracelessSquare(E);
  Eigen::Matrix<double, 10, 20> rows;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      Cubic entry{};
      for (size_t k = 0; k < 3; ++k) AddProduct(square[i][k], E[k][j], entry);
      rows.row(static_cast<int>(3 * i + j)) =
          Eigen::Map<const Eigen::Matrix<double, 1, 20>>(entry.data());
    }
  }
  const Cubic det = Determinant(E);
  rows.row(9) = Eigen::Map<const Eigen::Matrix<double, 1, 20>>(det.data());
  return rows;
}

/// Polynomial in z of degree <= D, lowest power first.
template <size_t D>
using InZ = std::array<double, D + 1>;

template <size_t M, size_t N>
InZ<M + N - 2> Times(const std::array<double, M>& a, const std::array<double, N>& b) {
  InZ<M + N - 2> product{};
  for (size_t i = 0; i < M; ++i) {
    for (size_t j = 0; j < N; ++j) product[i + j] += a[i] * b[j];
  }
  return product;
}

template <size_t N>
double At(const std::array<double, N>& c, double z) {
  double value = 0.0;
  for (size_t k = N; k-- > 0;) value = value * z + c[k];
  return value;
}

/// x(z) x + y(z) y + one(z) = 0.
struct ReducedRow {
  InZ<3> x{};
  InZ<3> y{};
  InZ<4> one{};
};
using ReducedRows = std::array<ReducedRow, 3>;

/// Row `upper` (leading monomial m z) minus z times row `lower` (leading monomial m).
ReducedRow Subtract(const Eigen::Matrix<double, 10, 10>& tail, int upper, int lower) {
  ReducedRow row;
  for (int power = 0; power < 3; ++power) {
    row.x[power] += tail(upper, 2 - power);
    row.x[power + 1] -= tail(lower, 2 - power);
    row.y[power] += tail(upper, 5 - power);
    row.y[power + 1] -= tail(lower, 5 - power);
  }
  for (int power = 0; power < 4; ++power) {
    row.one[power] += tail(upper, 9 - power);
    row.one[power + 1] -= tail(lower, 9 - power);
  }
  return row;
}

InZ<10> Determinant(const ReducedRows& rows) {
  InZ<10> det{};
  for (size_t i = 0; i < 3; ++i) {
    const ReducedRow& a = rows[(i + 1) % 3];
    const ReducedRow& b = rows[(i + 2) % 3];
    const InZ<6> positive = Times(a.x, b.y);
    const InZ<6> negative = Times(a.y, b.x);
    InZ<6> minor{};
    for (size_t k = 0; k < minor.size(); ++k) minor[k] = positive[k] - negative[k];
    const InZ<10> term = Times(minor, rows[i].one);
    for (size_t k = 0; k < det.size(); ++k) det[k] += term[k];
  }
  return det;
}

/// (x, y, 1) up to scale, orthogonal to the three rows at z: the longest cross product of two.
Vector3d SolveForXY(const ReducedRows& rows, double z) {
  std::array<Vector3d, 3> r;
  for (size_t i = 0; i < 3; ++i) r[i] = {At(rows[i].x, z), At(rows[i].y, z), At(rows[i].one, z)};
  Vector3d best = r[0].cross(r[1]);
  for (const Vector3d& other : {r[1].cross(r[2]).eval(), r[2].cross(r[0]).eval()}) {
    if (other.squaredNorm() > best.squaredNorm()) best = other;
  }
  return best;
}

}  // namespace

absl::InlinedVector<Matrix3d, 10> SolveFivePoint(std::span<const Vector3d, 5> bearings_a,
                                                 std::span<const Vector3d, 5> bearings_b) {
  const NullSpace null_space = EpipolarNullSpace(bearings_a, bearings_b);
  const Eigen::Matrix<double, 10, 20> rows = Constraints(null_space);
  const Eigen::Matrix<double, 10, 10> tail =
      rows.leftCols<10>().partialPivLu().solve(rows.rightCols<10>());
  const ReducedRows reduced = {Subtract(tail, 4, 5), Subtract(tail, 6, 7), Subtract(tail, 8, 9)};

  absl::InlinedVector<Matrix3d, 10> solutions;
  for (const double z : RealRoots(Determinant(reduced))) {
    const Vector3d xy = SolveForXY(reduced, z);
    const Matrix3d E = xy.x() * null_space[0] + xy.y() * null_space[1] +
                       xy.z() * (z * null_space[2] + null_space[3]);
    const double norm = E.norm();
    if (norm > 0.0 && std::isfinite(norm)) solutions.push_back(std::sqrt(2.0) / norm * E);
  }
  return solutions;
}

}  // namespace orbweave
