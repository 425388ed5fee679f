// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/plane_relief.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/geometry/cube_face.h"

namespace orbweave {
namespace {

constexpr int kCell_px = 16;
constexpr int kApart = 2;  // cells

struct Cell {
  double count = 0.0;
  double weight = 0.0;
  double sum = 0.0;
};

/// The cells of one raster.
class Cells {
 public:
  explicit Cells(int face_px)
      : face_px_(face_px),
        along_((face_px + kCell_px - 1) / kCell_px),
        cells_(static_cast<size_t>(kCubeFaces * along_ * along_)) {}

  void Add(const PlaneResidual& residual) {
    const auto pixel = static_cast<int>(residual.pixel);
    const int row = pixel / face_px_ % face_px_ / kCell_px;
    const int column = pixel % face_px_ / kCell_px;
    Cell& cell = cells_[At(pixel / (face_px_ * face_px_), row, column)];
    cell.count += 1.0;
    cell.weight += residual.weight;
    cell.sum += residual.weight * residual.off_m;
  }

  /// Calls visit(cell, other) for the pairs that are so many rows and columns apart.
  template <typename Visitor>
  void ForEachPair(int rows, int columns, Visitor&& visit) const {
    for (int face = 0; face < kCubeFaces; ++face) {
      for (int row = 0; row + rows < along_; ++row) {
        for (int column = 0; column + columns < along_; ++column) {
          const Cell& cell = cells_[At(face, row, column)];
          const Cell& other = cells_[At(face, row + rows, column + columns)];
          if (cell.count > 0.0 && other.count > 0.0) visit(cell, other);
        }
      }
    }
  }

  [[nodiscard]] double Count() const {
    return static_cast<double>(
        std::ranges::count_if(cells_, [](const Cell& cell) { return cell.count > 0.0; }));
  }

 private:
  [[nodiscard]] size_t At(int face, int row, int column) const {
    return static_cast<size_t>((face * along_ + row) * along_ + column);
  }

  int face_px_;
  int along_;
  std::vector<Cell> cells_;
};

/// Of the mean residuals of two cells.
struct Covariance {
  double weights = 0.0;
  double sum = 0.0;
  double squares = 0.0;

  [[nodiscard]] double Mean() const { return weights > 0.0 ? sum / weights : -kHuge; }
  [[nodiscard]] double Sigma() const { return weights > 0.0 ? std::sqrt(squares) / weights : 0.0; }

 private:
  static constexpr double kHuge = 1e9;
};

Covariance CovarianceOf(const Cells& cells, int rows, int columns) {
  Covariance covariance;
  cells.ForEachPair(rows, columns, [&](const Cell& a, const Cell& b) {
    const double weight = std::sqrt(a.count * b.count);
    const double product = weight * (a.sum / a.weight) * (b.sum / b.weight);
    covariance.weights += weight;
    covariance.sum += product;
    covariance.squares += product * product;
  });
  return covariance;
}

/// The mean of a normal distribution of which what is below zero is cut off.
double MeanAboveZero(double mean, double sigma) {
  if (!(sigma > 0.0)) return std::max(mean, 0.0);
  const double t = std::max(mean / sigma, -5.0);
  const double density = std::exp(-0.5 * t * t) / std::sqrt(2.0 * std::numbers::pi);
  return sigma * (t + density / (0.5 * std::erfc(-t / std::numbers::sqrt2)));
}

}  // namespace

std::optional<Relief> ReliefOf(int face_px, std::span<const PlaneResidual> residuals) {
  Cells cells(face_px);
  for (const PlaneResidual& residual : residuals) cells.Add(residual);
  const Covariance down = CovarianceOf(cells, kApart, 0);
  const Covariance across = CovarianceOf(cells, 0, kApart);
  if (!(down.weights + across.weights > 0.0)) return std::nullopt;
  const Covariance& larger = down.Mean() > across.Mean() ? down : across;
  return Relief{MeanAboveZero(larger.Mean(), larger.Sigma()), std::max(1.0, cells.Count())};
}

}  // namespace orbweave
