// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/bundle_layout.h"

#include <algorithm>
#include <tuple>

namespace orbweave {
namespace {

constexpr uint32_t kMaxPointsPerChunk = 512;
constexpr size_t kMaxBlocksPerChunk = 48;

void NumberBlocks(const BundleProblem& problem, const Gauge& gauge, BundleLayout& layout) {
  for (const uint8_t is_held : gauge.pose_is_held) {
    layout.pose_block.push_back(is_held ? kHeld : layout.num_blocks++);
  }
  layout.bias_block.assign(problem.bias_sigma_m.size(), kHeld);
  for (size_t group = 0; group < problem.bias_sigma_m.size(); ++group) {
    if (problem.bias_sigma_m[group] > 0.0) layout.bias_block[group] = layout.num_blocks++;
  }
  layout.first_retained_point = layout.num_blocks;
}

// Observation indices by point (start has one entry more than there are points).
struct ObservationsByPoint {
  std::vector<uint32_t> start{};
  std::vector<uint32_t> indices{};
};

ObservationsByPoint SortByPoint(const BundleProblem& problem) {
  ObservationsByPoint sorted;
  sorted.start.assign(problem.points_in_world.size() + 1, 0);
  for (const BundleObservation& seen : problem.observations) ++sorted.start[seen.point + 1];
  for (size_t i = 1; i < sorted.start.size(); ++i) sorted.start[i] += sorted.start[i - 1];
  sorted.indices.resize(problem.observations.size());
  std::vector<uint32_t> fill(sorted.start.begin(), sorted.start.end() - 1);
  for (uint32_t i = 0; i < problem.observations.size(); ++i) {
    sorted.indices[fill[problem.observations[i].point]++] = i;
  }
  for (size_t point = 0; point + 1 < sorted.start.size(); ++point) {
    std::sort(sorted.indices.begin() + sorted.start[point],
              sorted.indices.begin() + sorted.start[point + 1],
              [&](uint32_t x, uint32_t y) {
                const uint32_t pose_x = problem.observations[x].pose;
                const uint32_t pose_y = problem.observations[y].pose;
                return std::tie(pose_x, x) < std::tie(pose_y, y);
              });
  }
  return sorted;
}

// Points with observations but the retained ones; those that start at the same pose become
// neighbours.
std::vector<uint32_t> OrderPoints(const BundleProblem& problem,
                                  const ObservationsByPoint& by_point,
                                  const std::vector<uint32_t>& pose_block,
                                  const std::vector<uint32_t>& retained_points) {
  std::vector<uint32_t> first_block(problem.points_in_world.size(), kHeld);
  std::vector<uint32_t> order;
  for (uint32_t point = 0; point < first_block.size(); ++point) {
    if (by_point.start[point] == by_point.start[point + 1]) continue;
    if (std::binary_search(retained_points.begin(), retained_points.end(), point)) continue;
    order.push_back(point);
    for (uint32_t k = by_point.start[point]; k < by_point.start[point + 1]; ++k) {
      const uint32_t block = pose_block[problem.observations[by_point.indices[k]].pose];
      first_block[point] = std::min(first_block[point], block);
    }
  }
  std::sort(order.begin(), order.end(), [&](uint32_t x, uint32_t y) {
    return std::tie(first_block[x], x) < std::tie(first_block[y], y);
  });
  return order;
}

void PackObservations(const BundleProblem& problem,
                      const std::vector<uint32_t>& retained_points,
                      BundleLayout& layout) {
  const ObservationsByPoint by_point = SortByPoint(problem);
  layout.observations.reserve(problem.observations.size());
  const auto pack = [&](uint32_t point, std::vector<PackedPoint>& points) {
    PackedPoint packed{.point = point, .first = static_cast<uint32_t>(layout.observations.size())};
    for (uint32_t k = by_point.start[point]; k < by_point.start[point + 1]; ++k) {
      const BundleObservation& seen = problem.observations[by_point.indices[k]];
      layout.observations.push_back({.bearing = seen.bearing,
                                     .weight = 1.0 / (seen.sigma_rad * seen.sigma_rad),
                                     .pose = seen.pose});
    }
    packed.end = static_cast<uint32_t>(layout.observations.size());
    packed.is_fixed = !problem.point_is_fixed.empty() && problem.point_is_fixed[point];
    points.push_back(packed);
  };
  for (const uint32_t point : OrderPoints(problem, by_point, layout.pose_block, retained_points)) {
    pack(point, layout.points);
  }
  for (const uint32_t point : retained_points) pack(point, layout.retained_points);
  layout.num_blocks += static_cast<uint32_t>(retained_points.size());
}

void CutIntoChunks(BundleLayout& layout) {
  std::vector<uint32_t> chunk_of_block(layout.num_blocks, kHeld);
  for (uint32_t p = 0; p < layout.points.size(); ++p) {
    const PackedPoint& point = layout.points[p];
    const auto for_new_blocks = [&](const auto& visit) {
      const auto current = static_cast<uint32_t>(layout.chunks.size()) - 1;
      for (uint32_t k = point.first; k < point.end; ++k) {
        const uint32_t block = layout.pose_block[layout.observations[k].pose];
        if (block != kHeld && chunk_of_block[block] != current) visit(block, current);
      }
    };
    size_t num_new = 0;
    for_new_blocks([&](uint32_t, uint32_t) { ++num_new; });
    if (layout.chunks.empty() || p - layout.chunks.back().first_point >= kMaxPointsPerChunk ||
        (layout.chunks.back().blocks.size() + num_new > kMaxBlocksPerChunk && num_new > 0 &&
         p > layout.chunks.back().first_point)) {
      layout.chunks.push_back({.first_point = p});
    }
    PointChunk& chunk = layout.chunks.back();
    for_new_blocks([&](uint32_t block, uint32_t current) {
      chunk_of_block[block] = current;
      chunk.blocks.push_back(block);
    });
    chunk.end_point = p + 1;
  }
}

// Numbers the chunk's blocks in ascending order and returns the block pairs that its points touch.
std::vector<BlockIndex> NumberLocally(PointChunk& chunk,
                                      BundleLayout& layout,
                                      std::vector<uint32_t>& local) {
  std::sort(chunk.blocks.begin(), chunk.blocks.end());
  for (uint32_t i = 0; i < chunk.blocks.size(); ++i) local[chunk.blocks[i]] = i;
  std::vector<uint8_t> touched(chunk.NumPairs(), 0);
  for (uint32_t p = chunk.first_point; p < chunk.end_point; ++p) {
    const PackedPoint& point = layout.points[p];
    for (uint32_t k = point.first; k < point.end; ++k) {
      PackedObservation& seen = layout.observations[k];
      const uint32_t block = layout.pose_block[seen.pose];
      if (block == kHeld) continue;
      seen.local = local[block];
      touched[PairIndex(seen.local, seen.local)] = 1;
      for (uint32_t m = point.first; m < k && !point.is_fixed; ++m) {
        const uint32_t other = layout.observations[m].local;
        if (other != kHeld) touched[PairIndex(other, seen.local)] = 1;
      }
    }
  }
  std::vector<BlockIndex> pairs;
  for (uint32_t j = 0; j < chunk.blocks.size(); ++j) {
    for (uint32_t i = 0; i <= j; ++i) {
      const auto pair = static_cast<uint32_t>(PairIndex(i, j));
      if (!touched[pair]) continue;
      chunk.targets.push_back({.pair = pair});
      pairs.push_back({.column = chunk.blocks[j], .row = chunk.blocks[i]});
    }
  }
  return pairs;
}

void BuildMatrix(const BundleProblem& problem, BundleLayout& layout) {
  std::vector<uint32_t> local(layout.num_blocks);
  std::vector<std::vector<BlockIndex>> chunk_pairs;
  std::vector<BlockIndex> pattern;
  for (PointChunk& chunk : layout.chunks) {
    chunk_pairs.push_back(NumberLocally(chunk, layout, local));
    pattern.insert(pattern.end(), chunk_pairs.back().begin(), chunk_pairs.back().end());
  }
  for (const PositionPrior& prior : problem.position_priors) {
    const uint32_t pose = layout.pose_block[prior.pose];
    const uint32_t bias = prior.bias_group ? layout.bias_block[*prior.bias_group] : kHeld;
    if (pose != kHeld && bias != kHeld) pattern.push_back({.column = bias, .row = pose});
  }
  for (uint32_t k = 0; k < layout.retained_points.size(); ++k) {
    const PackedPoint& point = layout.retained_points[k];
    for (uint32_t i = point.first; i < point.end; ++i) {
      const uint32_t pose = layout.pose_block[layout.observations[i].pose];
      if (pose != kHeld)
        pattern.push_back({.column = layout.first_retained_point + k, .row = pose});
    }
  }
  layout.matrix = MakeBlockMatrix(layout.num_blocks, std::move(pattern));
  layout.matrix.values = {};
  for (size_t c = 0; c < layout.chunks.size(); ++c) {
    std::vector<PointChunk::Target>& targets = layout.chunks[c].targets;
    for (size_t t = 0; t < targets.size(); ++t) {
      targets[t].value = layout.matrix.Find(chunk_pairs[c][t]);
    }
  }
}

}  // namespace

BundleLayout MakeBundleLayout(const BundleProblem& problem,
                              const Gauge& gauge,
                              const std::vector<uint32_t>& retained_points) {
  BundleLayout layout;
  NumberBlocks(problem, gauge, layout);
  PackObservations(problem, retained_points, layout);
  CutIntoChunks(layout);
  BuildMatrix(problem, layout);
  return layout;
}

}  // namespace orbweave
