// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/build_view_graph.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "core/geometry/rotation.h"
#include "core/geometry/sphere_cells.h"
#include "core/graph/adjacency.h"

namespace orbweave {
namespace {

// Sorts by pair, and drops edges without geometry and all but the strongest edge of a pair.
std::vector<ViewEdge> NormaliseEdges(std::vector<ViewEdge> edges,
                                     std::vector<DroppedEdge>& dropped) {
  std::sort(edges.begin(), edges.end(), [](const ViewEdge& x, const ViewEdge& y) {
    return std::tie(x.pair, y.num_inliers) < std::tie(y.pair, x.num_inliers);
  });
  std::vector<ViewEdge> kept;
  kept.reserve(edges.size());
  for (const ViewEdge& edge : edges) {
    if (edge.kind == TwoViewKind::kNone) {
      dropped.push_back({edge.pair, "no two-view geometry"});
    } else if (!kept.empty() && kept.back().pair == edge.pair) {
      dropped.push_back({edge.pair, "repeats a pair with more inliers"});
    } else {
      kept.push_back(edge);
    }
  }
  return kept;
}

// In thousandths, so that sums are exact in any order; more than none.
uint64_t WeightOf(const ViewEdge& edge) {
  constexpr double kOneCell = 1.0 / (kSpreadCells * kSpreadCells);  // whatever is there is in one
  return 1 + static_cast<uint64_t>(std::llround(1000.0 * std::max(edge.spread, kOneCell) *
                                                std::sqrt(edge.num_inliers)));
}

// The triangles of an edge, and what they weigh.
struct Triangles {
  uint32_t total = 0;
  uint32_t closing = 0;
  uint64_t total_weight = 0;
  uint64_t closing_weight = 0;

  void Add(bool closes, uint64_t weight) {
    ++total;
    total_weight += weight;
    if (!closes) return;
    ++closing;
    closing_weight += weight;
  }
  void Subtract(bool closes, uint64_t weight) {
    --total;
    total_weight -= weight;
    if (!closes) return;
    --closing;
    closing_weight -= weight;
  }
};

// The edges still there and which of their triangles close.
class TriangleLedger {
 public:
  TriangleLedger(uint32_t num_images,
                 const std::vector<ViewEdge>& edges,
                 const ViewGraphOptions& options)
      : edges_(edges),
        options_(options),
        adjacency_(num_images, edges),
        triangles_(edges.size()),
        is_gone_(edges.size(), 0) {
    std::ranges::transform(edges, std::back_inserter(weights_), WeightOf);
    for (uint32_t e = 0; e < edges.size(); ++e) AddTrianglesAbove(e);
    for (uint32_t e = 0; e < edges.size(); ++e) EnlistIfSuspect(e);
  }

  // Takes suspects away, worst first, until none is left.
  void RemoveSuspects(std::vector<DroppedEdge>& dropped) {
    while (!suspects_.empty()) {
      const uint32_t worst = std::get<2>(*suspects_.begin());
      const Triangles& triangles = triangles_[worst];
      dropped.push_back({edges_[worst].pair,
                         std::to_string(triangles.total - triangles.closing) + " of " +
                             std::to_string(triangles.total) + " triplets do not close",
                         DropCause::kTriplets});
      Remove(worst);
    }
  }

  [[nodiscard]] std::vector<ViewEdge> Remaining() const {
    std::vector<ViewEdge> remaining;
    remaining.reserve(edges_.size());
    for (size_t e = 0; e < edges_.size(); ++e) {
      if (is_gone_[e] == 0) remaining.push_back(edges_[e]);
    }
    return remaining;
  }

 private:
  // Worst first: share, inliers, edge in pair order.
  using Suspect = std::tuple<double, uint32_t, uint32_t>;

  [[nodiscard]] double ClosingShare(uint32_t e) const {
    return static_cast<double>(weights_[e] + triangles_[e].closing_weight) /
           static_cast<double>(weights_[e] + triangles_[e].total_weight);
  }
  [[nodiscard]] Suspect SuspectOf(uint32_t e) const {
    return {ClosingShare(e), edges_[e].num_inliers, e};
  }
  [[nodiscard]] bool IsSuspect(uint32_t e) const {
    return is_gone_[e] == 0 && triangles_[e].closing < triangles_[e].total &&
           ClosingShare(e) <= options_.min_closing_share;
  }
  void EnlistIfSuspect(uint32_t e) {
    if (IsSuspect(e)) suspects_.insert(SuspectOf(e));
  }

  [[nodiscard]] Eigen::Quaterniond Rotation(uint32_t e, uint32_t to, uint32_t from) const {
    const Eigen::Quaterniond& b_from_a = edges_[e].b_from_a.rotation;
    return from < to ? b_from_a : b_from_a.conjugate();
  }
  [[nodiscard]] bool Closes(uint32_t ab, uint32_t bc, uint32_t ca, uint32_t c) const {
    const uint32_t a = edges_[ab].pair.a.value;
    const uint32_t b = edges_[ab].pair.b.value;
    const Eigen::Quaterniond a_from_a =
        Rotation(ca, a, c) * Rotation(bc, c, b) * Rotation(ab, b, a);
    return RotationAngle(a_from_a) * 180.0 / std::numbers::pi <= options_.max_triplet_deg;
  }

  // Visits the triangles of edge e whose sides are all there: visit(c, edge bc, edge ca).
  template <typename Visitor>
  void ForEachTriangle(uint32_t e, Visitor&& visit) const {
    ForEachCommonLink(adjacency_.Of(edges_[e].pair.a.value),
                      adjacency_.Of(edges_[e].pair.b.value),
                      [&](uint32_t c, uint32_t ca, uint32_t bc) {
                        if (is_gone_[ca] == 0 && is_gone_[bc] == 0) visit(c, bc, ca);
                      });
  }

  // Every triangle is added once, at the edge opposite to its largest image.
  void AddTrianglesAbove(uint32_t e) {
    ForEachTriangle(e, [&](uint32_t c, uint32_t bc, uint32_t ca) {
      if (c < edges_[e].pair.b.value) return;
      const bool closes = Closes(e, bc, ca, c);
      triangles_[e].Add(closes, Weaker(bc, ca));
      triangles_[bc].Add(closes, Weaker(ca, e));
      triangles_[ca].Add(closes, Weaker(e, bc));
    });
  }

  void Remove(uint32_t e) {
    suspects_.erase(SuspectOf(e));
    ForEachTriangle(e, [&](uint32_t c, uint32_t bc, uint32_t ca) {
      const bool closes = Closes(e, bc, ca, c);
      for (const auto& [side, other] : {std::pair(bc, ca), std::pair(ca, bc)}) {
        if (IsSuspect(side)) suspects_.erase(SuspectOf(side));
        triangles_[side].Subtract(closes, Weaker(e, other));
        EnlistIfSuspect(side);
      }
    });
    is_gone_[e] = 1;
  }

  [[nodiscard]] uint64_t Weaker(uint32_t x, uint32_t y) const {
    return std::min(weights_[x], weights_[y]);
  }

  const std::vector<ViewEdge>& edges_;
  const ViewGraphOptions& options_;
  Adjacency adjacency_;
  std::vector<uint64_t> weights_{};
  std::vector<Triangles> triangles_;
  std::vector<uint8_t> is_gone_;
  std::set<Suspect> suspects_;
};

}  // namespace

FilteredViewGraph BuildViewGraph(uint32_t num_images,
                                 std::vector<ViewEdge> edges,
                                 const ViewGraphOptions& options) {
  FilteredViewGraph filtered;
  const std::vector<ViewEdge> kept = NormaliseEdges(std::move(edges), filtered.dropped);
  TriangleLedger ledger(num_images, kept, options);
  ledger.RemoveSuspects(filtered.dropped);
  filtered.graph = {.num_images = num_images, .edges = ledger.Remaining()};
  std::stable_sort(filtered.dropped.begin(),
                   filtered.dropped.end(),
                   [](const DroppedEdge& x, const DroppedEdge& y) { return x.pair < y.pair; });
  return filtered;
}

}  // namespace orbweave
