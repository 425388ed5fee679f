// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/find_carrier.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "core/geometry/sphere_cells.h"
#include "core/scene/carrier.h"

namespace orbweave {
namespace {

constexpr double kFixed_rad = 0.5 * std::numbers::pi / 180.0;  // of which the chord is as long
constexpr double kFarthest_m = 2000.0;
constexpr double kSigmasApart = 4.0;
constexpr int32_t kSame = 205;  // 0.4 of a unit descriptor
constexpr double kRatio = 0.8;
constexpr int kReach = 2;  // cells: seven degrees
constexpr double kFewestPairs = 3.0;
constexpr double kShareOfPairs = 0.05;
constexpr double kShareBesideOthers = 0.01;

bool AreFarApart(const PlacedPanorama& a, const PlacedPanorama& b) {
  const double apart_m = (b.position_in_enu - a.position_in_enu).norm();
  return apart_m >=
         std::max(kFarthest_m * kFixed_rad, kSigmasApart * std::hypot(a.sigma_m, b.sigma_m));
}

int32_t SquaredDistance(const uint8_t* a, const uint8_t* b) {
  int32_t squared = 0;
  for (int i = 0; i < kDescriptorSize; ++i) {
    const int32_t difference = int32_t{a[i]} - int32_t{b[i]};
    squared += difference * difference;
  }
  return squared;
}

/// The cells at most `reach` bands and sectors from one, itself among them; fewer beside a pole.
std::vector<uint32_t> CellsAround(uint32_t cell, int reach) {
  const int band = static_cast<int>(cell) / kCarrierCells;
  const int sector = static_cast<int>(cell) % kCarrierCells;
  std::vector<uint32_t> around;
  for (int b = std::max(band - reach, 0); b <= std::min(band + reach, kCarrierCells - 1); ++b) {
    for (int s = sector - reach; s <= sector + reach; ++s)
      around.push_back(
          static_cast<uint32_t>(b * kCarrierCells + (s + kCarrierCells) % kCarrierCells));
  }
  return around;
}

/// The features of a panorama, those of facade views too, cell by cell; none where they are not
/// described.
class FeaturesByCell {
 public:
  explicit FeaturesByCell(const Features& features)
      : features_(features), first_(kNumCarrierCells + 1) {
    if (features.descriptors.empty()) return;
    const std::vector<Eigen::Vector3d> bearings = BearingsOf(features);
    std::vector<uint32_t> cells;
    for (const Eigen::Vector3d& bearing : bearings)
      cells.push_back(SphereCell(bearing, kCarrierCells));
    for (const uint32_t cell : cells) ++first_[cell + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    order_.resize(cells.size());
    std::iota(order_.begin(), order_.end(), FeatureIndex{0});
    std::ranges::stable_sort(order_, {}, [&](FeatureIndex i) { return cells[i]; });
    for (const FeatureIndex i : order_) bearings_.push_back(bearings[i]);
  }

  /// Whether a feature of the cell is fixed.
  [[nodiscard]] bool SharesOneWith(const FeaturesByCell& other, uint32_t cell) const {
    for (uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
      for (uint32_t j = other.first_[cell]; j < other.first_[cell + 1]; ++j) {
        if (!IsWithin(kFixed_rad, bearings_[i], other.bearings_[j])) continue;
        const int32_t squared = SquaredDistance(Descriptor(i), other.Descriptor(j));
        if (squared <= kSame * kSame && !IsLike(i, other, cell, squared)) return true;
      }
    }
    return false;
  }

 private:
  static bool IsWithin(double angle_rad, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return (a - b).squaredNorm() <= angle_rad * angle_rad;
  }
  [[nodiscard]] const uint8_t* Descriptor(uint32_t i) const {
    return features_.Descriptor(order_[i]);
  }
  /// Whether feature i of the cell looks like what the other has beside the same place as well, but
  /// for the ratio that matches are to have.
  [[nodiscard]] bool IsLike(uint32_t i,
                            const FeaturesByCell& other,
                            uint32_t cell,
                            int32_t squared_at_place) const {
    for (const uint32_t near : CellsAround(cell, kReach)) {
      for (uint32_t k = other.first_[near]; k < other.first_[near + 1]; ++k) {
        if (IsWithin(2.0 * kFixed_rad, bearings_[i], other.bearings_[k])) continue;
        if (kRatio * kRatio * SquaredDistance(Descriptor(i), other.Descriptor(k)) <
            squared_at_place)
          return true;
      }
    }
    return false;
  }

  const Features& features_;
  std::vector<uint32_t> first_;            ///< by cell, and the end of the last one
  std::vector<FeatureIndex> order_;        ///< of the cells
  std::vector<Eigen::Vector3d> bearings_;  ///< in this order
};

/// In how many of the pairs each cell has fixed features.
struct FixedPairs {
  std::vector<double> in_cell = std::vector<double>(kNumCarrierCells);
  double all = 0.0;
};

FixedPairs CountFixedPairs(std::span<const PlacedPanorama> panoramas) {
  std::vector<FeaturesByCell> by_cell;
  for (const PlacedPanorama& panorama : panoramas) by_cell.emplace_back(panorama.features);
  FixedPairs pairs;
  for (size_t a = 0; a < panoramas.size(); ++a) {
    for (size_t b = a + 1; b < panoramas.size(); ++b) {
      if (!AreFarApart(panoramas[a], panoramas[b])) continue;
      ++pairs.all;
      for (uint32_t cell = 0; cell < kNumCarrierCells; ++cell)
        if (by_cell[a].SharesOneWith(by_cell[b], cell)) ++pairs.in_cell[cell];
    }
  }
  return pairs;
}

}  // namespace

std::vector<uint32_t> FindCarrier(std::span<const PlacedPanorama> panoramas) {
  const FixedPairs pairs = CountFixedPairs(panoramas);
  const auto has = [&](uint32_t cell, double share) {
    return pairs.in_cell[cell] >= std::max(kFewestPairs, share * pairs.all);
  };
  std::set<uint32_t> carrier;
  std::vector<uint32_t> to_grow;
  const auto take = [&](uint32_t cell) {
    if (carrier.insert(cell).second) to_grow.push_back(cell);
  };
  for (uint32_t cell = 0; cell < kNumCarrierCells; ++cell)
    if (has(cell, kShareOfPairs)) take(cell);
  while (!to_grow.empty()) {
    const std::vector<uint32_t> around = CellsAround(to_grow.back(), 1);
    to_grow.pop_back();
    for (const uint32_t cell : around)
      if (has(cell, kShareBesideOthers)) take(cell);
  }
  return {carrier.begin(), carrier.end()};
}

}  // namespace orbweave
