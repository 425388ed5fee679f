// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/drop_edges_against_gnss.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/base/quantile.h"
#include "core/graph/disjoint_sets.h"
#include "core/graph/in_sequence.h"
#include "core/scene/places_in_drives.h"
#include "core/scene/usual_step.h"

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
/// kFar where positions show that they err no more than they say: by chance one in 300,000.
constexpr Slack kFarAndSmooth = {5.0, 2.5, 3.0};

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
  return Separation{DistanceBetween(a, b), SigmaBetween(a, b)};
}

/// Baseline of the edge over the depth of what it sees.
double BaselineOverDepth(const ViewEdge& edge) {
  if (edge.kind == TwoViewKind::kPureRotation) return 0.0;
  return 2.0 * std::tan(edge.median_angle_rad / 2.0);
}

/// Depths of the scene that edges and positions say together, all or those `in_sequence`.
std::vector<double> Depths(const std::vector<ViewEdge>& edges,
                           const ImageManifest& manifest,
                           const PlacesInDrives* in_sequence) {
  std::vector<double> depths_m;
  for (const ViewEdge& edge : edges) {
    if (in_sequence != nullptr && !IsInSequence(edge.pair, *in_sequence)) continue;
    const std::optional<Separation> separation = SeparationOf(edge, manifest);
    const double ratio = BaselineOverDepth(edge);
    if (!separation || !(ratio > 0.0) || ratio >= kNear.max_ratio) continue;
    if (separation->distance_m < separation->sigma_m) continue;
    depths_m.push_back(separation->distance_m / ratio);
  }
  return depths_m;
}

/// By neighbours in the sequence, where enough of them tell; nullopt where no edge does.
std::optional<double> MedianDepth(const std::vector<ViewEdge>& edges,
                                  const ImageManifest& manifest,
                                  const PlacesInDrives& places) {
  constexpr size_t kEnough = 10;
  std::vector<double> depths_m = Depths(edges, manifest, &places);
  if (depths_m.size() < kEnough) depths_m = Depths(edges, manifest, nullptr);
  if (depths_m.empty()) return std::nullopt;
  return UpperMedian(std::move(depths_m));
}

bool IsWithin(const Slack& slack,
              const Separation& separation,
              const ViewEdge& edge,
              double depth_m) {
  const double ratio = std::min(slack.max_ratio, BaselineOverDepth(edge));
  return separation.distance_m <=
         slack.sigmas * separation.sigma_m + slack.baselines * depth_m * ratio;
}

enum class Agreement : uint8_t { kNone, kAgrees, kDoubts, kDisagrees };

/// What GNSS thinks of each edge.
std::vector<Agreement> FindAgreements(const std::vector<ViewEdge>& edges,
                                      const ImageManifest& manifest,
                                      const PlacesInDrives& places) {
  std::vector<Agreement> agreements(edges.size(), Agreement::kNone);
  const std::optional<double> depth_m = MedianDepth(edges, manifest, places);
  if (!depth_m) return agreements;
  for (size_t e = 0; e < edges.size(); ++e) {
    const std::optional<Separation> separation = SeparationOf(edges[e], manifest);
    if (!separation) continue;
    if (IsWithin(kNear, *separation, edges[e], *depth_m)) agreements[e] = Agreement::kAgrees;
    if (!IsWithin(kFarAndSmooth, *separation, edges[e], *depth_m))
      agreements[e] = Agreement::kDoubts;
    if (!IsWithin(kFar, *separation, edges[e], *depth_m)) agreements[e] = Agreement::kDisagrees;
  }
  return agreements;
}

/// Edges that GNSS disagrees with count against the others.
struct Votes {
  int all = 0;
  int agreeing = 0;
  int disagreeing = 0;

  void Add(Agreement agreement) {
    ++all;
    agreeing += agreement == Agreement::kAgrees ? 1 : 0;
    disagreeing += agreement == Agreement::kDisagrees ? 1 : 0;
  }
};

enum class Trust : uint8_t { kNone, kUsual, kSmooth };

/// Per image: none where GNSS disagrees with more than half of its edges to neighbours in the
/// sequence, where there are two or more, else of all its edges; smooth where it agrees with every
/// such neighbour. Look-alikes may be many; neighbours they are not.
std::vector<Trust> FindTrust(const std::vector<ViewEdge>& edges,
                             const std::vector<Agreement>& agreements,
                             const PlacesInDrives& places,
                             size_t num_images) {
  std::vector<Votes> all(num_images);
  std::vector<Votes> in_sequence(num_images);
  for (size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].kind == TwoViewKind::kNone) continue;
    const bool is_in_sequence = IsInSequence(edges[e].pair, places);
    for (const ImageId image : {edges[e].pair.a, edges[e].pair.b}) {
      all[image.value].Add(agreements[e]);
      if (is_in_sequence) in_sequence[image.value].Add(agreements[e]);
    }
  }
  std::vector<Trust> trust(num_images, Trust::kNone);
  for (size_t i = 0; i < trust.size(); ++i) {
    const bool has_neighbours = in_sequence[i].all >= 2;
    const Votes& votes = has_neighbours ? in_sequence[i] : all[i];
    if (2 * votes.disagreeing <= votes.all) trust[i] = Trust::kUsual;
    if (has_neighbours && votes.agreeing == votes.all) trust[i] = Trust::kSmooth;
  }
  return trust;
}

/// Whether GNSS speaks against an edge of two images that it is trusted with so far.
bool SpeaksAgainst(Agreement agreement, Trust a, Trust b) {
  if (agreement == Agreement::kDoubts) return a == Trust::kSmooth && b == Trust::kSmooth;
  return agreement == Agreement::kDisagrees && a != Trust::kNone && b != Trust::kNone;
}

/// Parts that edges which agree with GNSS hold together, and what joins them against it.
class Crossings {
 public:
  Crossings(const std::vector<ViewEdge>& edges,
            const std::vector<Agreement>& agreements,
            uint32_t num_images)
      : parts_(num_images) {
    for (size_t e = 0; e < edges.size(); ++e) {
      if (agreements[e] == Agreement::kAgrees)
        parts_.Unite(edges[e].pair.a.value, edges[e].pair.b.value);
    }
    for (size_t e = 0; e < edges.size(); ++e) {
      if (agreements[e] != Agreement::kDisagrees) continue;
      const auto [a, b] = edges[e].pair;
      images_[{parts_.Find(a.value), parts_.Find(b.value)}].insert(a.value);
      images_[{parts_.Find(b.value), parts_.Find(a.value)}].insert(b.value);
    }
  }

  [[nodiscard]] bool IsWithinAPart(const ImagePair& pair) {
    return parts_.Find(pair.a.value) == parts_.Find(pair.b.value);
  }

  /// Positions that jumped take a stretch along, and so do a drive that comes back and its pairs.
  /// Two parts that hold together by themselves and meet in a panorama or two look alike there.
  [[nodiscard]] bool IsAChanceMeeting(const ImagePair& pair) {
    constexpr uint32_t kOwnImages = 5;
    constexpr size_t kStretch = 3;
    const uint32_t a = parts_.Find(pair.a.value);
    const uint32_t b = parts_.Find(pair.b.value);
    if (a == b || parts_.SizeOf(a) < kOwnImages || parts_.SizeOf(b) < kOwnImages) return false;
    return images_.at({a, b}).size() < kStretch && images_.at({b, a}).size() < kStretch;
  }

 private:
  DisjointSets parts_;
  std::map<std::pair<uint32_t, uint32_t>, std::set<uint32_t>> images_{};
};

}  // namespace

SiftedEdges DropEdgesAgainstGnss(const std::vector<ViewEdge>& edges,
                                 const ImageManifest& manifest) {
  const PlacesInDrives places(manifest);
  const std::vector<Agreement> agreements = FindAgreements(edges, manifest, places);
  const std::vector<Trust> trust = FindTrust(edges, agreements, places, manifest.images.size());
  Crossings crossings(edges, agreements, static_cast<uint32_t>(manifest.images.size()));
  return SiftEdges(edges, DropCause::kGnss, [&](uint32_t e) -> std::string {
    const auto [a, b] = edges[e].pair;
    const bool is_wrong =
        SpeaksAgainst(agreements[e], trust[a.value], trust[b.value]) &&
        (crossings.IsWithinAPart(edges[e].pair) ||
         (agreements[e] == Agreement::kDisagrees && crossings.IsAChanceMeeting(edges[e].pair)));
    if (!is_wrong) return "";
    const auto metres = std::lround(SeparationOf(edges[e], manifest)->distance_m);
    return "GNSS puts its images " + std::to_string(metres) + " m apart";
  });
}

}  // namespace orbweave
