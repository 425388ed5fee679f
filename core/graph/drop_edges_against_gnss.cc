// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/drop_edges_against_gnss.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/graph/disjoint_sets.h"

namespace orbweave {
namespace {

/// How far apart positions may be: so many standard deviations and so many baselines. Beyond some
/// ratio of baseline to depth few rays meet the same points, and the angle says little.
struct Slack {
  double sigmas = 0.0;
  double baselines = 0.0;
  double max_ratio = 0.0;
};
constexpr Slack kNear = {3.0, 1.5, 1.0};
constexpr Slack kFar = {8.0, 2.5, 3.0};

/// What GNSS says of an edge.
struct Separation {
  double distance_m = 0.0;  ///< horizontal
  double sigma_m = 0.0;     ///< of a difference, per axis
};

/// nullopt for edges without geometry or positions.
std::optional<Separation> SeparationOf(const ViewEdge& edge, const ImageManifest& manifest) {
  if (edge.kind == TwoViewKind::kNone) return std::nullopt;
  const PosePrior& a = manifest.At(edge.pair.a).prior;
  const PosePrior& b = manifest.At(edge.pair.b).prior;
  if (!a.position_in_enu || !b.position_in_enu) return std::nullopt;
  return Separation{(*a.position_in_enu - *b.position_in_enu).head<2>().norm(),
                    std::hypot(a.horizontal_sigma_m, b.horizontal_sigma_m)};
}

/// Baseline of the edge over the depth of what it sees.
double BaselineOverDepth(const ViewEdge& edge) {
  if (edge.kind == TwoViewKind::kPureRotation) return 0.0;
  return 2.0 * std::tan(edge.median_angle_rad / 2.0);
}

/// nullopt where no edge is long enough to tell.
std::optional<double> MedianDepth(const std::vector<ViewEdge>& edges,
                                  const ImageManifest& manifest) {
  std::vector<double> depths_m;
  for (const ViewEdge& edge : edges) {
    const std::optional<Separation> separation = SeparationOf(edge, manifest);
    const double ratio = BaselineOverDepth(edge);
    if (!separation || !(ratio > 0.0) || ratio >= kNear.max_ratio) continue;
    if (separation->distance_m < separation->sigma_m) continue;
    depths_m.push_back(separation->distance_m / ratio);
  }
  if (depths_m.empty()) return std::nullopt;
  const auto middle = depths_m.begin() + static_cast<std::ptrdiff_t>(depths_m.size() / 2);
  std::nth_element(depths_m.begin(), middle, depths_m.end());
  return *middle;
}

bool IsWithin(const Slack& slack,
              const Separation& separation,
              const ViewEdge& edge,
              double depth_m) {
  const double ratio = std::min(slack.max_ratio, BaselineOverDepth(edge));
  return separation.distance_m <=
         slack.sigmas * separation.sigma_m + slack.baselines * depth_m * ratio;
}

enum class Opinion : uint8_t { kNone, kAgrees, kDisagrees };

/// What GNSS thinks of each edge.
std::vector<Opinion> FormOpinions(const std::vector<ViewEdge>& edges,
                                  const ImageManifest& manifest) {
  std::vector<Opinion> opinions(edges.size(), Opinion::kNone);
  const std::optional<double> depth_m = MedianDepth(edges, manifest);
  if (!depth_m) return opinions;
  for (size_t e = 0; e < edges.size(); ++e) {
    const std::optional<Separation> separation = SeparationOf(edges[e], manifest);
    if (!separation) continue;
    if (IsWithin(kNear, *separation, edges[e], *depth_m)) opinions[e] = Opinion::kAgrees;
    if (!IsWithin(kFar, *separation, edges[e], *depth_m)) opinions[e] = Opinion::kDisagrees;
  }
  return opinions;
}

/// Neighbours in the sequence of one drive.
constexpr uint32_t kSequenceSteps = 5;

bool IsInSequence(const ImagePair& pair, const ImageManifest& manifest) {
  return pair.b.value - pair.a.value <= kSequenceSteps &&
         manifest.At(pair.a).drive == manifest.At(pair.b).drive;
}

/// Edges that GNSS disagrees with count against the others.
struct Balance {
  int votes = 0;
  int balance = 0;

  void Add(Opinion opinion) {
    ++votes;
    balance += opinion == Opinion::kDisagrees ? -1 : 1;
  }
};

/// Per image: whether GNSS disagrees with half or less of its edges to neighbours in the sequence,
/// where there are two or more, else of all its edges. Look-alikes may be many; neighbours they are
/// not.
std::vector<uint8_t> FindTrusted(const std::vector<ViewEdge>& edges,
                                 const std::vector<Opinion>& opinions,
                                 const ImageManifest& manifest) {
  std::vector<Balance> all(manifest.images.size());
  std::vector<Balance> in_sequence(manifest.images.size());
  for (size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].kind == TwoViewKind::kNone) continue;
    const bool is_in_sequence = IsInSequence(edges[e].pair, manifest);
    for (const ImageId image : {edges[e].pair.a, edges[e].pair.b}) {
      all[image.value].Add(opinions[e]);
      if (is_in_sequence) in_sequence[image.value].Add(opinions[e]);
    }
  }
  std::vector<uint8_t> trusted(manifest.images.size(), 0);
  for (size_t i = 0; i < trusted.size(); ++i) {
    const Balance& balance = in_sequence[i].votes >= 2 ? in_sequence[i] : all[i];
    trusted[i] = balance.balance >= 0 ? 1 : 0;
  }
  return trusted;
}

}  // namespace

EdgesByGnss DropEdgesAgainstGnss(const std::vector<ViewEdge>& edges,
                                 const ImageManifest& manifest) {
  const std::vector<Opinion> opinions = FormOpinions(edges, manifest);
  const std::vector<uint8_t> trusted = FindTrusted(edges, opinions, manifest);
  DisjointSets joined(static_cast<uint32_t>(manifest.images.size()));
  for (size_t e = 0; e < edges.size(); ++e) {
    if (opinions[e] == Opinion::kAgrees) joined.Unite(edges[e].pair.a.value, edges[e].pair.b.value);
  }
  EdgesByGnss result;
  for (size_t e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges[e].pair;
    const bool is_wrong = opinions[e] == Opinion::kDisagrees && trusted[a.value] != 0 &&
                          trusted[b.value] != 0 && joined.Find(a.value) == joined.Find(b.value);
    if (!is_wrong) {
      result.kept.push_back(edges[e]);
      continue;
    }
    const auto metres = std::lround(SeparationOf(edges[e], manifest)->distance_m);
    result.dropped.push_back(
        {edges[e].pair, "GNSS puts its images " + std::to_string(metres) + " m apart"});
  }
  return result;
}

}  // namespace orbweave
