// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/divide_graph.h"

#include <metis.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "core/base/status.h"

namespace orbweave {
namespace {

constexpr uint32_t kNoPart = std::numeric_limits<uint32_t>::max();
// Sum of all weights handed to METIS: far from the end of a 32-bit idx_t.
constexpr double kTotalWeight = 2.0e8;

// The piece in METIS's compressed rows, images numbered by position.
struct MetisGraph {
  std::vector<idx_t> begin{0};
  std::vector<idx_t> neighbour{};
  std::vector<idx_t> weight{};
};

MetisGraph ToMetisGraph(const ConnectedPiece& piece) {
  const auto position = [&](uint32_t image) {
    return static_cast<idx_t>(std::lower_bound(piece.images.begin(), piece.images.end(), image) -
                              piece.images.begin());
  };
  double total = 0.0;
  for (const uint32_t image : piece.images) {
    for (const Adjacency::Link& link : piece.adjacency.Of(image))
      total += piece.edge_weight[link.edge];
  }
  const double scale = std::min(1.0, kTotalWeight / total);
  MetisGraph graph;
  for (const uint32_t image : piece.images) {
    for (const Adjacency::Link& link : piece.adjacency.Of(image)) {
      graph.neighbour.push_back(position(link.image));
      const double weight = std::round(scale * piece.edge_weight[link.edge]);
      graph.weight.push_back(std::max<idx_t>(1, static_cast<idx_t>(weight)));
    }
    graph.begin.push_back(static_cast<idx_t>(graph.neighbour.size()));
  }
  return graph;
}

// Part of each image of the piece.
absl::StatusOr<std::vector<idx_t>> RunMetis(MetisGraph graph, uint32_t num_parts) {
  idx_t num_vertices = static_cast<idx_t>(graph.begin.size() - 1);
  idx_t num_constraints = 1;
  idx_t parts = static_cast<idx_t>(num_parts);
  idx_t cut = 0;
  std::array<idx_t, METIS_NOPTIONS> options{};
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_CONTIG] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  std::vector<idx_t> part(graph.begin.size() - 1, 0);
  const int result = METIS_PartGraphKway(&num_vertices,
                                         &num_constraints,
                                         graph.begin.data(),
                                         graph.neighbour.data(),
                                         nullptr,
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

// A part that may hold several unconnected chunks of images.
class Division {
 public:
  Division(const ConnectedPiece& piece, const std::vector<idx_t>& part)
      : piece_(piece), part_of_(piece.adjacency.num_images(), kNoPart) {
    for (size_t i = 0; i < piece.images.size(); ++i) {
      part_of_[piece.images[i]] = static_cast<uint32_t>(part[i]);
    }
  }

  using Chunk = std::vector<uint32_t>;

  // Connected chunks of images of equal part, in order of their first image.
  [[nodiscard]] std::vector<Chunk> Chunks() const {
    std::vector<Chunk> chunks;
    std::vector<uint8_t> is_seen(part_of_.size(), 0);
    for (const uint32_t start : piece_.images) {
      if (is_seen[start] != 0) continue;
      is_seen[start] = 1;
      Chunk& chunk = chunks.emplace_back(1, start);
      for (size_t next = 0; next < chunk.size(); ++next) {
        for (const Adjacency::Link& link : piece_.adjacency.Of(chunk[next])) {
          if (is_seen[link.image] != 0 || part_of_[link.image] != part_of_[start]) continue;
          is_seen[link.image] = 1;
          chunk.push_back(link.image);
        }
      }
      std::sort(chunk.begin(), chunk.end());
    }
    return chunks;
  }

  // Gives a chunk to the part it shares most weight with.
  void GiveAway(const Chunk& chunk) {
    std::map<uint32_t, double> weight_to_part;
    for (const uint32_t image : chunk) {
      for (const Adjacency::Link& link : piece_.adjacency.Of(image)) {
        const uint32_t part = part_of_[link.image];
        if (part != part_of_[image]) weight_to_part[part] += piece_.edge_weight[link.edge];
      }
    }
    if (weight_to_part.empty()) return;
    const auto strongest = std::max_element(
        weight_to_part.begin(), weight_to_part.end(), [](const auto& x, const auto& y) {
          return x.second < y.second;
        });
    for (const uint32_t image : chunk) part_of_[image] = strongest->first;
  }

  [[nodiscard]] uint32_t PartOf(const Chunk& chunk) const { return part_of_[chunk.front()]; }

 private:
  const ConnectedPiece& piece_;
  std::vector<uint32_t> part_of_;
};

// The smallest chunk that cannot stay: one too small, or not the largest of its part.
const Division::Chunk* SmallestHomeless(const Division& division,
                                        const std::vector<Division::Chunk>& chunks,
                                        size_t min_size) {
  std::map<uint32_t, const Division::Chunk*> largest;
  for (const Division::Chunk& chunk : chunks) {
    const Division::Chunk*& best = largest[division.PartOf(chunk)];
    if (best == nullptr || chunk.size() > best->size()) best = &chunk;
  }
  const Division::Chunk* homeless = nullptr;
  for (const Division::Chunk& chunk : chunks) {
    if (chunk.size() >= min_size && largest[division.PartOf(chunk)] == &chunk) continue;
    if (homeless == nullptr || chunk.size() < homeless->size()) homeless = &chunk;
  }
  return homeless;
}

}  // namespace

absl::StatusOr<std::vector<std::vector<uint32_t>>> DivideGraph(const ConnectedPiece& piece,
                                                               uint32_t num_parts,
                                                               uint32_t min_part_size) {
  if (num_parts <= 1) {
    return std::vector<Division::Chunk>{{piece.images.begin(), piece.images.end()}};
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<idx_t> part,
                            RunMetis(ToMetisGraph(piece), num_parts));
  Division division(piece, part);
  std::vector<Division::Chunk> chunks = division.Chunks();
  // Each gift unites two chunks, so this ends.
  while (chunks.size() > 1) {
    const Division::Chunk* homeless = SmallestHomeless(division, chunks, min_part_size);
    if (homeless == nullptr) break;
    division.GiveAway(*homeless);
    chunks = division.Chunks();
  }
  return chunks;
}

}  // namespace orbweave
