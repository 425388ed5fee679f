// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/choose_views.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace orbweave {
namespace {

constexpr int kApron = PlaneField::kApron_px;
constexpr float kLeastVote_zncc = 0.3F;
constexpr float kFullSine = 0.21F;     // 12 degrees
constexpr float kLeastCosine = 0.36F;  // 69 degrees

/// Weight of the parallax that a source at `centre` has of a point.
float ParallaxWeight(const Eigen::Vector3f& point, const Eigen::Vector3f& centre) {
  const Eigen::Vector3f to_source = point - centre;
  const float sizes = std::sqrt(point.squaredNorm() * to_source.squaredNorm());
  if (point.dot(to_source) < kLeastCosine * sizes) return 0.01F;
  return std::clamp(point.cross(to_source).norm() / (kFullSine * sizes), 0.03F, 1.0F);
}

class Voter {
 public:
  Voter(const MatchScale& scale,
        const PlaneField& field,
        const DenseOptions& options,
        MatchFunction match)
      : scale_(scale),
        field_(field),
        noise_variance_(static_cast<float>(options.noise_levels * options.noise_levels)),
        match_(match) {}

  /// Votes of the colour's pixels in one row of a block.
  void Vote(const MatchPlace& place, int colour, std::vector<float>& votes) {
    PreparePatches(scale_, place, patches_);
    const size_t at = field_.At(place.face, colour, place.row, place.column >> 1);
    std::copy_n(&field_.x[at], kMatchLanes, planes_.x.begin());
    std::copy_n(&field_.y[at], kMatchLanes, planes_.y.begin());
    std::copy_n(&field_.z[at], kMatchLanes, planes_.z.begin());
    const int end = kApron + field_.FacePx();
    for (size_t source = 0; source < scale_.sources.size(); ++source) {
      const auto face = static_cast<size_t>(place.face);
      match_(patches_, scale_.views[source][face], planes_, noise_variance_, zncc_);
      for (size_t k = 0; k < kMatchLanes; k += 1) {
        if (place.column + 2 * static_cast<int>(k) >= end) break;
        const Eigen::Vector3f ray(patches_.x[k], patches_.y, 1.0F);
        const float p0 = planes_.x[k] * ray.x() + planes_.y[k] * ray.y() + planes_.z[k];
        if (!(p0 > 0.0F)) continue;
        const float beyond = std::max(zncc_[k] - kLeastVote_zncc, 0.0F);
        const float weight = ParallaxWeight(ray / p0, scale_.centres[source][face]);
        votes[source] += (beyond * beyond + 1e-4F) * weight;
      }
    }
  }

 private:
  const MatchScale& scale_;
  const PlaneField& field_;
  float noise_variance_;
  MatchFunction match_;
  ReferencePatches patches_{};
  PlaneLanes planes_{};
  LaneFloats zncc_{};
};

ChosenViews BestOf(const std::vector<float>& votes, int count) {
  std::vector<uint8_t> order(votes.size());
  std::iota(order.begin(), order.end(), uint8_t{0});
  std::stable_sort(
      order.begin(), order.end(), [&](uint8_t a, uint8_t b) { return votes[a] > votes[b]; });
  ChosenViews chosen;
  chosen.count = std::min(count, static_cast<int>(order.size()));
  std::copy_n(order.begin(), chosen.count, chosen.source.begin());
  return chosen;
}

}  // namespace

BlockViews ChooseViews(const MatchScale& scale,
                       const PlaneField& field,
                       const DenseOptions& options,
                       MatchFunction match) {
  const int face_px = field.FacePx();
  BlockViews views{.rows = (face_px + kBlockRows_px - 1) / kBlockRows_px,
                   .columns = (face_px + kBlockColumns_px - 1) / kBlockColumns_px};
  Voter voter(scale, field, options, match);
  std::vector<float> votes(scale.sources.size());
  for (int face = 0; face < kCubeFaces; ++face) {
    for (int block_row = 0; block_row < views.rows; ++block_row) {
      for (int block_column = 0; block_column < views.columns; ++block_column) {
        std::fill(votes.begin(), votes.end(), 0.0F);
        const int last = std::min(face_px, (block_row + 1) * kBlockRows_px);
        for (int row = block_row * kBlockRows_px + 1; row < last; row += 4) {
          const int colour = (row >> 2) & 1;
          const int in_field = kApron + row;
          const int column = kApron + block_column * kBlockColumns_px + ((in_field + colour) & 1);
          voter.Vote({face, in_field, column}, colour, votes);
        }
        views.blocks.push_back(BestOf(votes, std::min(options.views, kMaxViews)));
      }
    }
  }
  return views;
}

}  // namespace orbweave
