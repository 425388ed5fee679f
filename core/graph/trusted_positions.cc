// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/trusted_positions.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>

namespace orbweave {
namespace {

constexpr double kSigmas = 3.0;
constexpr double kSameWay_rad = std::numbers::pi / 9.0;
// A position that is off by a step or two along the street misses a third of its edges.
constexpr double kMostMissing = 0.25;
// Of a position that lies between its neighbours' as a street goes; windows that repeat mislead
// both nearest edges of an image.
constexpr double kMostMissingIfSmooth = 0.5;
constexpr size_t kFewest = 2;

/// Whether the position lies halfway between those of the images before and after it in its drive,
/// as far as they are exact.
bool IsSmooth(const ImageRecord& here,
              const ImageManifest& manifest,
              const PlacesInDrives& places) {
  const std::optional<ImageId> id_before = places.Before(here.id);
  const std::optional<ImageId> id_after = places.After(here.id);
  if (!id_before || !id_after) return false;
  const PosePrior& before = manifest.At(*id_before).prior;
  const PosePrior& after = manifest.At(*id_after).prior;
  const auto& [p, g, n] =
      std::tie(before.position_in_enu, here.prior.position_in_enu, after.position_in_enu);
  if (!p || !g || !n) return false;
  const double sigma_m = std::hypot(here.prior.horizontal_sigma_m,
                                    0.5 * before.horizontal_sigma_m,
                                    0.5 * after.horizontal_sigma_m);
  return (*g - 0.5 * (*p + *n)).head<2>().norm() <= kSigmas * sigma_m;
}

/// Per image: the share of its edges that its position may miss.
std::vector<double> LimitsOf(const ImageManifest& manifest, const PlacesInDrives& places) {
  std::vector<double> limits;
  for (const ImageRecord& image : manifest.images)
    limits.push_back(IsSmooth(image, manifest, places) ? kMostMissingIfSmooth : kMostMissing);
  return limits;
}

/// What an edge says of the positions of its images.
struct Witness {
  uint32_t a = 0;
  uint32_t b = 0;
  double weight = 0.0;
  bool misses = false;
  bool is_in_sequence = false;
};

std::vector<Witness> WitnessesOf(const std::vector<MotionEdge>& edges, const Headings& headings) {
  std::vector<Witness> witnesses;
  for (const MotionEdge& edge : edges) {
    const std::optional<StepError> error = StepErrorOf(edge, headings);
    if (!error || TurnsOtherwise(edge, headings)) continue;
    const bool misses =
        error->miss_m > kSigmas * edge.step->sigma_m && error->Least() > kSameWay_rad;
    witnesses.push_back({edge.a, edge.b, edge.weight, misses, edge.is_in_sequence});
  }
  return witnesses;
}

/// What the edges of an image say together.
struct Tally {
  size_t count = 0;
  double weight = 0.0;
  double missing = 0.0;

  void Add(const Witness& witness) {
    ++count;
    weight += witness.weight;
    missing += witness.misses ? witness.weight : 0.0;
  }
  void Remove(const Witness& witness) {
    --count;
    weight -= witness.weight;
    missing -= witness.misses ? witness.weight : 0.0;
  }
  [[nodiscard]] double MissingShare() const { return count < kFewest ? 1.0 : missing / weight; }
};

/// Takes positions out, the worst first.
class Ledger {
 public:
  /// `limits`: per image.
  Ledger(const std::vector<Witness>& witnesses, const std::vector<double>& limits)
      : witnesses_(witnesses),
        limits_(limits),
        witnesses_of_(limits.size()),
        in_sequence_(limits.size(), 0),
        tallies_(limits.size()),
        is_trusted_(limits.size(), 1) {
    for (uint32_t w = 0; w < witnesses_.size(); ++w) {
      for (const uint32_t image : {witnesses_[w].a, witnesses_[w].b}) {
        witnesses_of_[image].push_back(w);
        in_sequence_[image] += witnesses_[w].is_in_sequence ? 1 : 0;
      }
    }
    for (uint32_t image = 0; image < limits_.size(); ++image) {
      for (const uint32_t w : witnesses_of_[image]) {
        if (Counts(witnesses_[w], image)) tallies_[image].Add(witnesses_[w]);
      }
      if (IsSuspect(image)) suspects_.insert(SuspectOf(image));
    }
  }

  std::vector<uint8_t> RemoveTheWorst() {
    while (!suspects_.empty()) Remove(std::get<2>(*suspects_.begin()));
    return is_trusted_;
  }

 private:
  // Worst first: share and weight of what misses, image.
  using Suspect = std::tuple<double, double, uint32_t>;

  [[nodiscard]] bool Counts(const Witness& witness, uint32_t image) const {
    return witness.is_in_sequence || in_sequence_[image] < kFewest;
  }
  [[nodiscard]] bool IsSuspect(uint32_t image) const {
    return tallies_[image].MissingShare() > limits_[image];
  }
  [[nodiscard]] Suspect SuspectOf(uint32_t image) const {
    return {-tallies_[image].MissingShare(), -tallies_[image].missing, image};
  }
  void Remove(uint32_t image) {
    suspects_.erase(SuspectOf(image));
    is_trusted_[image] = 0;
    for (const uint32_t w : witnesses_of_[image]) {
      const uint32_t other = witnesses_[w].a == image ? witnesses_[w].b : witnesses_[w].a;
      if (is_trusted_[other] == 0 || !Counts(witnesses_[w], other)) continue;
      if (IsSuspect(other)) suspects_.erase(SuspectOf(other));
      tallies_[other].Remove(witnesses_[w]);
      if (IsSuspect(other)) suspects_.insert(SuspectOf(other));
    }
  }

  const std::vector<Witness>& witnesses_;
  const std::vector<double>& limits_;
  std::vector<std::vector<uint32_t>> witnesses_of_;
  std::vector<size_t> in_sequence_;
  std::vector<Tally> tallies_;
  std::vector<uint8_t> is_trusted_;
  std::set<Suspect> suspects_{};
};

}  // namespace

std::vector<uint8_t> TrustedPositions(const std::vector<MotionEdge>& edges,
                                      const Headings& headings,
                                      const ImageManifest& manifest,
                                      const PlacesInDrives& places) {
  const std::vector<Witness> witnesses = WitnessesOf(edges, headings);
  const std::vector<double> limits = LimitsOf(manifest, places);
  return Ledger(witnesses, limits).RemoveTheWorst();
}

}  // namespace orbweave
