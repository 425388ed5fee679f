// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/drive_chain.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>

#include "core/geometry/rotation.h"
#include "core/graph/in_sequence.h"
#include "core/scene/sequence_of_drive.h"

namespace orbweave {
namespace {

constexpr double kMaxRatio = 3.0;
// Images of a drive that a step may pass by: single failures, no missing street.
constexpr size_t kMostPassedBy = 3;
// Third images that may confirm a step: those that matching pairs with both ends.
constexpr size_t kWitnesses = 4;
// As for triplets of the view graph: ten times what noise makes of three good rotations.
constexpr double kMaxTriplet_rad = 3.0 * std::numbers::pi / 180.0;

// Inliers of a pair over those of a nearer one, where both see the same; what chance may do.
constexpr double kMoreInliers = 1.5;

using Sequence = std::vector<uint32_t>;

// The strongest edge with a geometry of every two images.
class EdgeIndex {
 public:
  explicit EdgeIndex(const std::vector<ViewEdge>& edges) {
    for (const ViewEdge& edge : edges) {
      if (edge.kind == TwoViewKind::kNone) continue;
      const ViewEdge*& best = by_pair_[edge.pair];
      if (best == nullptr || edge.num_inliers > best->num_inliers) best = &edge;
    }
  }

  [[nodiscard]] const ViewEdge* Find(uint32_t a, uint32_t b) const {
    const auto found = by_pair_.find(MakePair(ImageId(a), ImageId(b)));
    return found == by_pair_.end() ? nullptr : found->second;
  }
  [[nodiscard]] const std::map<ImagePair, const ViewEdge*>& all() const { return by_pair_; }

 private:
  std::map<ImagePair, const ViewEdge*> by_pair_;
};

Eigen::Quaterniond RotationOf(const ViewEdge& edge, uint32_t to) {
  return edge.pair.b.value == to ? edge.b_from_a.rotation : edge.b_from_a.rotation.conjugate();
}

// Images with an edge, by drive and stretch of it.
std::vector<Sequence> SequencesOf(const EdgeIndex& index, const ImageManifest& manifest) {
  std::vector<uint8_t> has_edge(manifest.images.size(), 0);
  for (const auto& [pair, edge] : index.all()) has_edge[pair.a.value] = has_edge[pair.b.value] = 1;
  const PlacesInDrives places(manifest);
  std::vector<Sequence> list;
  for (const auto& [drive, images] : SequenceOfDrives(manifest)) {
    std::optional<ImageId> before;
    for (const ImageId image : images) {
      if (has_edge[image.value] == 0) continue;
      if (!before || !IsInSequence(MakePair(*before, image), places)) list.emplace_back();
      list.back().push_back(image.value);
      before = image;
    }
  }
  return list;
}

// Whether images around confirm the rotation of the edge between sequence[p] and sequence[q], each
// by the weaker of its edges with them: what looks alike at a corner makes many weak ones.
bool IsConfirmed(const EdgeIndex& index, const Sequence& sequence, size_t p, size_t q) {
  const uint32_t a = sequence[p];
  const uint32_t b = sequence[q];
  const Eigen::Quaterniond b_from_a = RotationOf(*index.Find(a, b), b);
  const size_t first = p - std::min(p, kWitnesses);
  const size_t last = std::min(q + kWitnesses, sequence.size() - 1);
  uint64_t closing = 0;
  uint64_t open = 0;
  for (size_t m = first; m <= last; ++m) {
    const uint32_t c = sequence[m];
    if (c == a || c == b) continue;
    const ViewEdge* const ac = index.Find(a, c);
    const ViewEdge* const cb = index.Find(c, b);
    if (ac == nullptr || cb == nullptr) continue;
    const Eigen::Quaterniond round = b_from_a.conjugate() * RotationOf(*cb, b) * RotationOf(*ac, c);
    (RotationAngle(round) <= kMaxTriplet_rad ? closing : open) +=
        std::min(ac->num_inliers, cb->num_inliers);
  }
  return closing > 0 && closing >= open;
}

// What edges of sequence[p] reach, ahead or behind, with the inliers of the weakest so far.
std::vector<std::pair<uint32_t, uint32_t>> SightOf(const EdgeIndex& index,
                                                   const Sequence& sequence,
                                                   size_t p,
                                                   bool ahead) {
  std::vector<std::pair<uint32_t, uint32_t>> sight;
  const size_t most = ahead ? sequence.size() - 1 - p : p;
  size_t reach = 0;
  uint32_t weakest = std::numeric_limits<uint32_t>::max();
  for (size_t step = 1; step <= most && step <= reach + 2; ++step) {
    const uint32_t other = sequence[ahead ? p + step : p - step];
    const ViewEdge* const edge = index.Find(sequence[p], other);
    if (edge == nullptr) continue;
    reach = step;
    weakest = std::min(weakest, edge->num_inliers);
    sight.emplace_back(other, weakest);
  }
  return sight;
}

std::array<Eigen::Vector3d, DriveChain::kAxes> MakeAxes() {
  std::array<Eigen::Vector3d, DriveChain::kAxes> axes;
  size_t count = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const bool is_upper = z > 0 || (z == 0 && (y > 0 || (y == 0 && x > 0)));
        if (is_upper) axes[count++] = Eigen::Vector3d(x, y, z).normalized();
      }
    }
  }
  return axes;
}

}  // namespace

double BaselineOverDepth(const ViewEdge& edge) {
  if (edge.kind == TwoViewKind::kPureRotation) return 0.0;
  return std::min(kMaxRatio, 2.0 * std::tan(std::min(edge.median_angle_rad, 3.0) / 2.0));
}

const std::array<Eigen::Vector3d, DriveChain::kAxes>& DriveChain::Axes() {
  static const std::array<Eigen::Vector3d, kAxes> axes = MakeAxes();
  return axes;
}

DriveChain::DriveChain(const std::vector<ViewEdge>& edges, const ImageManifest& manifest)
    : places_(manifest.images.size()),
      ahead_(manifest.images.size()),
      behind_(manifest.images.size()) {
  const EdgeIndex index(edges);
  uint32_t stretch = 0;
  for (const Sequence& sequence : SequencesOf(index, manifest)) {
    for (size_t p = 0; p < sequence.size(); ++p) {
      Place& place = places_[sequence[p]];
      if (place.stretch == 0) place.stretch = ++stretch;
      ahead_[sequence[p]] = SightOf(index, sequence, p, true);
      behind_[sequence[p]] = SightOf(index, sequence, p, false);
    }
    for (size_t p = 0; p < sequence.size(); ++p) {
      const size_t last = std::min(p + 1 + kMostPassedBy, sequence.size() - 1);
      for (size_t q = p + 1; q <= last; ++q) {
        const ViewEdge* const step = index.Find(sequence[p], sequence[q]);
        if (step == nullptr || !IsConfirmed(index, sequence, p, q)) continue;
        const ImageId from(sequence[p]);
        Append(from,
               ImageId(sequence[q]),
               step->pair.a == from ? step->b_from_a : step->b_from_a.Inverse(),
               BaselineOverDepth(*step));
        break;
      }
    }
  }
}

void DriveChain::Append(ImageId from, ImageId to, const Rigid3& next_from_cam, double length) {
  const Place& before = places_[from.value];
  Place& place = places_[to.value];
  if (place.step > 0) return;  // an image that was passed by goes on to where others came
  const Eigen::Vector3d moved = before.stretch_from_cam * next_from_cam.Centre().normalized();
  place = before;
  ++place.step;
  place.stretch_from_cam =
      (before.stretch_from_cam * next_from_cam.rotation.conjugate()).normalized();
  if (length == 0.0) return;
  place.length += length;
  for (size_t axis = 0; axis < kAxes; ++axis) {
    const double progress = length * Axes()[axis].dot(moved);
    (progress > 0.0 ? place.forward : place.backward)[axis] += std::abs(progress);
  }
}

std::optional<DriveChain::Way> DriveChain::Between(ImageId a, ImageId b) const {
  const bool a_is_first = places_[a.value].step <= places_[b.value].step;
  const Place& from = places_[a_is_first ? a.value : b.value];
  const Place& to = places_[a_is_first ? b.value : a.value];
  if (from.stretch == 0 || from.stretch != to.stretch || from.step == to.step) return std::nullopt;
  Way way{.first = a_is_first ? a : b,
          .steps = to.step - from.step,
          .length = to.length - from.length,
          .last_from_first = to.stretch_from_cam.conjugate() * from.stretch_from_cam,
          .stretch_from_first = from.stretch_from_cam};
  for (size_t axis = 0; axis < kAxes; ++axis) {
    way.forward[axis] = to.forward[axis] - from.forward[axis];
    way.backward[axis] = to.backward[axis] - from.backward[axis];
  }
  return way;
}

bool DriveChain::IsInSight(const Sight& sight, uint32_t image, uint32_t num_inliers) {
  const auto found =
      std::ranges::find(sight, image, [](const auto& reached) { return reached.first; });
  if (found == sight.end() || found == sight.begin()) return found != sight.end();
  return num_inliers <= kMoreInliers * std::prev(found)->second;
}

bool DriveChain::MaySeeFar(const ViewEdge& edge) const {
  const auto [a, b] = edge.pair;
  const auto is_seen = [&](const std::vector<Sight>& sights, ImageId from, ImageId to) {
    return IsInSight(sights[from.value], to.value, edge.num_inliers);
  };
  return is_seen(ahead_, a, b) || is_seen(behind_, b, a) || is_seen(ahead_, b, a) ||
         is_seen(behind_, a, b);
}

}  // namespace orbweave
