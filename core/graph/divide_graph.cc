// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/divide_graph.h"

#include <metis.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/base/status.h"

namespace orbweave {
namespace {

// Sum of all weights handed to METIS: far from the end of a 32-bit idx_t.
constexpr double kTotalWeight = 2.0e8;
// METIS counts costs in whole numbers: so many are an image of cost 1.
constexpr double kCostUnits = 64.0;

// The piece in METIS's compressed rows, images numbered by position.
struct MetisGraph {
  std::vector<idx_t> begin{0};
  std::vector<idx_t> neighbour{};
  std::vector<idx_t> weight{};
  std::vector<idx_t> cost{};
};

MetisGraph ToMetisGraph(const ConnectedPiece& piece) {
  const auto position = [&](uint32_t image) {
    return static_cast<idx_t>(std::lower_bound(piece.images.begin(), piece.images.end(), image) -
                              piece.images.begin());
  };
  const std::span<const double> cost_of =
      piece.cut_cost.empty() ? piece.edge_weight : piece.cut_cost;
  double total = 0.0;
  for (const uint32_t image : piece.images) {
    for (const Adjacency::Link& link : piece.adjacency.Of(image)) total += cost_of[link.edge];
  }
  const double scale = std::min(1.0, kTotalWeight / total);
  MetisGraph graph;
  for (const uint32_t image : piece.images) {
    for (const Adjacency::Link& link : piece.adjacency.Of(image)) {
      graph.neighbour.push_back(position(link.image));
      const double weight = std::round(scale * cost_of[link.edge]);
      graph.weight.push_back(std::max<idx_t>(1, static_cast<idx_t>(weight)));
    }
    graph.begin.push_back(static_cast<idx_t>(graph.neighbour.size()));
    const double cost = std::round(kCostUnits * piece.image_cost[image]);
    graph.cost.push_back(std::max<idx_t>(1, static_cast<idx_t>(cost)));
  }
  return graph;
}

// Part of each image of the piece.
absl::StatusOr<std::vector<idx_t>> RunMetis(MetisGraph graph,
                                            uint32_t num_parts,
                                            double unevenness) {
  idx_t num_vertices = static_cast<idx_t>(graph.begin.size() - 1);
  idx_t num_constraints = 1;
  idx_t parts = static_cast<idx_t>(num_parts);
  idx_t cut = 0;
  std::array<idx_t, METIS_NOPTIONS> options{};
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_UFACTOR] = static_cast<idx_t>(std::lround(1000.0 * unevenness));
  options[METIS_OPTION_CONTIG] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  std::vector<idx_t> part(graph.begin.size() - 1, 0);
  const int result = METIS_PartGraphKway(&num_vertices,
                                         &num_constraints,
                                         graph.begin.data(),
                                         graph.neighbour.data(),
                                         graph.cost.data(),
                                         nullptr,
                                         graph.weight.data(),
                                         &parts,
                                         nullptr,
                                         nullptr,
                                         options.data(),
                                         &cut,
                                         part.data());
  if (result != METIS_OK) {
    return absl::InternalError("METIS_PartGraphKway failed with code " + std::to_string(result));
  }
  return part;
}

using Chunk = std::vector<uint32_t>;

// Chunks of equal part that strong links hold together, sorted, in order of their first image. To
// METIS a weak link keeps a part in one piece as well.
class StrongChunks {
 public:
  StrongChunks(const ConnectedPiece& piece, const std::vector<idx_t>& part)
      : piece_(piece), part_of_(piece.adjacency.num_images(), -1) {
    for (size_t i = 0; i < piece.images.size(); ++i) part_of_[piece.images[i]] = part[i];
  }

  [[nodiscard]] std::vector<Chunk> Find() const {
    std::vector<Chunk> chunks;
    std::vector<uint8_t> is_seen(part_of_.size(), 0);
    for (const uint32_t start : piece_.images) {
      if (is_seen[start] != 0) continue;
      is_seen[start] = 1;
      Chunk& chunk = chunks.emplace_back(1, start);
      for (size_t next = 0; next < chunk.size(); ++next) {
        for (const Adjacency::Link& link : piece_.adjacency.Of(chunk[next])) {
          if (is_seen[link.image] != 0 || !Holds(chunk[next], link)) continue;
          is_seen[link.image] = 1;
          chunk.push_back(link.image);
        }
      }
      std::ranges::sort(chunk);
    }
    return chunks;
  }

  [[nodiscard]] idx_t PartOf(const Chunk& chunk) const { return part_of_[chunk.front()]; }

 private:
  [[nodiscard]] bool Holds(uint32_t image, const Adjacency::Link& link) const {
    return part_of_[image] == part_of_[link.image] && piece_.strong.Has(image, link);
  }

  const ConnectedPiece& piece_;
  std::vector<idx_t> part_of_;
};

// Chunks that become parts, or join others.
class Settlement {
 public:
  Settlement(const ConnectedPiece& piece, const StrongChunks& strong) : chunks_(strong.Find()) {
    std::map<idx_t, size_t> largest;
    for (size_t chunk = 0; chunk < chunks_.size(); ++chunk) {
      const size_t best = largest.emplace(strong.PartOf(chunks_[chunk]), chunk).first->second;
      if (chunks_[chunk].size() > chunks_[best].size())
        largest[strong.PartOf(chunks_[chunk])] = chunk;
    }
    is_core_.resize(chunks_.size(), 0);
    for (const auto& [part, chunk] : largest) is_core_[chunk] = 1;
    WeighLinks(piece);
  }

  // Chunks of fewer images than this stay alone only as the largest of their part, and none of
  // fewer than `min_size`: smallest first, they join the neighbour they share most weight with.
  void Settle(size_t min_size, size_t own_size) {
    while (const std::optional<size_t> chunk = SmallestHomeless(min_size, own_size)) {
      const std::map<size_t, double>& weights = weight_to_[*chunk];
      const auto strongest = std::ranges::max_element(
          weights, {}, [](const auto& neighbour) { return neighbour.second; });
      if (strongest == weights.end()) return;  // nobody else is left
      Join(*chunk, strongest->first);
    }
  }

  [[nodiscard]] std::vector<Chunk> Parts() && {
    std::erase_if(chunks_, [](const Chunk& chunk) { return chunk.empty(); });
    for (Chunk& chunk : chunks_) std::ranges::sort(chunk);
    std::ranges::sort(chunks_);
    return std::move(chunks_);
  }

 private:
  void WeighLinks(const ConnectedPiece& piece) {
    std::vector<size_t> chunk_of(piece.adjacency.num_images(), 0);
    for (size_t chunk = 0; chunk < chunks_.size(); ++chunk) {
      for (const uint32_t image : chunks_[chunk]) chunk_of[image] = chunk;
    }
    weight_to_.resize(chunks_.size());
    for (const uint32_t image : piece.images) {
      for (const Adjacency::Link& link : piece.adjacency.Of(image)) {
        if (chunk_of[link.image] == chunk_of[image]) continue;
        weight_to_[chunk_of[image]][chunk_of[link.image]] += piece.edge_weight[link.edge];
      }
    }
  }

  [[nodiscard]] std::optional<size_t> SmallestHomeless(size_t min_size, size_t own_size) const {
    std::optional<size_t> smallest;
    for (size_t chunk = 0; chunk < chunks_.size(); ++chunk) {
      const size_t size = chunks_[chunk].size();
      const bool stays = size >= own_size || (is_core_[chunk] != 0 && size >= min_size);
      if (size == 0 || stays) continue;
      if (!smallest || size < chunks_[*smallest].size()) smallest = chunk;
    }
    return smallest;
  }

  void Join(size_t from, size_t to) {
    chunks_[to].insert(chunks_[to].end(), chunks_[from].begin(), chunks_[from].end());
    chunks_[from].clear();
    is_core_[to] |= is_core_[from];
    for (const auto& [other, weight] : weight_to_[from]) {
      weight_to_[other].erase(from);
      if (other == to) continue;
      weight_to_[to][other] += weight;
      weight_to_[other][to] += weight;
    }
    weight_to_[from].clear();
  }

  std::vector<Chunk> chunks_;  // empty: joined another
  std::vector<uint8_t> is_core_;
  std::vector<std::map<size_t, double>> weight_to_;
};

}  // namespace

absl::StatusOr<std::vector<std::vector<uint32_t>>> DivideGraph(const ConnectedPiece& piece,
                                                               uint32_t num_parts,
                                                               uint32_t min_part_size,
                                                               double unevenness) {
  if (num_parts <= 1) return std::vector<Chunk>{{piece.images.begin(), piece.images.end()}};
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<idx_t> part,
                            RunMetis(ToMetisGraph(piece), num_parts, unevenness));
  Settlement settlement(piece, StrongChunks(piece, part));
  const size_t half = piece.images.size() / num_parts / 2;
  settlement.Settle(min_part_size, std::max<size_t>(min_part_size, half));
  return std::move(settlement).Parts();
}

}  // namespace orbweave
