// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/mending/carry_on_by_gnss.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/mapping/adjustment/adjust_global.h"
#include "core/mapping/checks/compare_models.h"
#include "core/mapping/checks/placed_images.h"
#include "core/mapping/lengths/line_pieces.h"
#include "core/mapping/lengths/measure_pair_lengths.h"
#include "core/mapping/model/move_images.h"
#include "core/mapping/positioning/position_agreement.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using Complex = std::complex<double>;
using PlacedSpan = std::span<const PlacedImage>;

constexpr size_t kPlacesAbout = 30;
constexpr size_t kFewestOnASide = 10;
constexpr double kDeviations = 4.0;
constexpr double kHardlyAnother = 0.05;  // of scales
constexpr size_t kMaxTries = 6;

/// A way behind which all is on another scale, or further on, by GNSS.
struct Break {
  ImageSlot image = 0;
  ImageSlot next = 0;
  double scale = 1.0;  ///< what lies behind times this
  double shift = 0.0;  ///< then, along the way, in units of the model
  double deviations = 0.0;
  size_t place = 0;  ///< among images with positions
};

/// One side of a way by its positions.
struct Side {
  std::vector<PlanStation> stations{};
  PlanFit fit{};

  explicit Side(PlacedSpan images) {
    for (const PlacedImage& image : images) stations.push_back(image.plan);
    fit = FitPlanRobustly(stations);
  }
  [[nodiscard]] bool IsKnown() const { return std::abs(fit.turn) > 0.0 && fit.extent_sigmas > 0.0; }
  /// If stated sigmas were true, like the next one.
  [[nodiscard]] double SigmaOfEnd_m() const {
    double sum_m2 = 0.0;
    for (const PlanStation& station : stations) sum_m2 += station.sigma_m * station.sigma_m;
    return 2.0 * std::sqrt(sum_m2) / static_cast<double>(stations.size());
  }
  /// Of the logarithm of its scale.
  [[nodiscard]] double SigmaOfScale() const { return fit.SigmaOfScale(stations.size()); }
};

/// By how much more positions scatter than they state, and share with their neighbours.
double InflationOf(const Side& before, const Side& behind) {
  std::vector<double> errors;
  for (const Side* side : {&before, &behind}) {
    for (const PlanStation& station : side->stations)
      errors.push_back(side->fit.ErrorSigmas(station));
  }
  return kErrorsShared * ScatterOfPositions(errors);
}

/// How far along a way the fit of what lies behind has its end from where that of what lies before
/// has it, in the model's unit. A line through n measurements is known at its ends to 2 / sqrt(n)
/// of one.
struct Shift {
  double along = 0.0;
  double sigma = 0.0;
};

Shift ShiftOf(const Side& before, const Side& behind, Complex way) {
  const Complex end = behind.stations.front().centre;
  const Complex off_m =
      behind.fit.turn * end + behind.fit.shift - (before.fit.turn * end + before.fit.shift);
  const Complex off = off_m / before.fit.turn;
  return {(std::conj(way) * off).real() / std::abs(way),
          std::hypot(before.SigmaOfEnd_m(), behind.SigmaOfEnd_m()) / std::abs(before.fit.turn)};
}

/// What GNSS says of the way between the last image of the one and the first of the other.
std::optional<Break> AskWay(PlacedSpan images_before, PlacedSpan images_behind) {
  const Side before(images_before);
  const Side behind(images_behind);
  if (!before.IsKnown() || !behind.IsKnown()) return std::nullopt;
  const double inflation = InflationOf(before, behind);
  const double log_scale = std::log(std::abs(behind.fit.turn) / std::abs(before.fit.turn));
  const double scale_deviations =
      std::abs(log_scale) / (inflation * std::hypot(before.SigmaOfScale(), behind.SigmaOfScale()));
  const bool is_other_scale =
      scale_deviations > kDeviations && std::abs(log_scale) > kHardlyAnother;
  Break found{.image = images_before.back().image,
              .next = images_behind.front().image,
              .scale = is_other_scale ? std::exp(log_scale) : 1.0};
  const Complex way = images_behind.front().plan.centre - images_before.back().plan.centre;
  if (!(std::abs(way) > 0.0)) return std::nullopt;
  const Shift shift = ShiftOf(before, behind, way);
  const double shift_deviations = std::abs(shift.along) / (inflation * shift.sigma);
  if (shift_deviations > kDeviations) found.shift = shift.along;
  found.deviations = std::max(is_other_scale ? scale_deviations : 0.0,
                              found.shift != 0.0 ? shift_deviations : 0.0);
  return found.deviations > 0.0 ? std::optional(found) : std::nullopt;
}

/// The images of the same line, as many as are asked, of those up to `end` or from there on.
PlacedSpan OfOneLine(PlacedSpan images, const LinePieces& pieces, size_t end, bool before) {
  const ImageSlot first = images[before ? end - 1 : end].image;
  size_t count = 0;
  const size_t most = std::min(kPlacesAbout, before ? end : images.size() - end);
  while (count < most &&
         pieces.AreOfOneLine(first, images[before ? end - 1 - count : end + count].image))
    ++count;
  return images.subspan(before ? end - count : end, count);
}

/// All of a model, in the order of places.
std::vector<Break> BreaksOf(const PlacedImages& placed, const LinePieces& pieces) {
  const PlacedSpan images = placed.images;
  std::vector<Break> found;
  for (size_t end = 1; end < images.size(); ++end) {
    if (!pieces.AreOfOneLine(images[end - 1].image, images[end].image)) continue;
    const PlacedSpan before = OfOneLine(images, pieces, end, true);
    const PlacedSpan behind = OfOneLine(images, pieces, end, false);
    if (std::min(before.size(), behind.size()) < kFewestOnASide) continue;
    if (auto way = AskWay(before, behind)) {
      way->place = end;
      found.push_back(*way);
    }
  }
  return found;
}

/// The worst first, no two within the reach of one.
std::vector<Break> WorstOf(std::vector<Break> breaks) {
  std::ranges::stable_sort(breaks, std::greater<>(), &Break::deviations);
  std::vector<Break> worst;
  for (const Break& candidate : breaks) {
    const auto is_near = [&](const Break& other) {
      const auto [first, last] = std::minmax(candidate.place, other.place);
      return last - first < kFewestOnASide / 2;
    };
    if (std::ranges::none_of(worst, is_near)) worst.push_back(candidate);
  }
  return worst;
}

/// Whether most of what GNSS minded at a way is gone: where points hold what was before, all
/// springs back as it is adjusted.
bool IsSettled(const MappingState& moved, const Break& way, const MappingOptions& options) {
  const LinePieces pieces(moved, options);
  const std::vector<Break> left = BreaksOf(FindPlacedImages(moved, pieces.Places()), pieces);
  return std::ranges::none_of(left, [&](const Break& other) {
    return other.image == way.image && 2.0 * other.deviations > way.deviations;
  });
}

/// What speaks against a model, and for it.
struct Standing {
  size_t faults = 0;
  size_t places = 0;

  Standing(const MappingState& state, const MappingOptions& options)
      : faults(FindLengthFaults(state, options).size()), places(CountHeldPlaces(state)) {}
};

/// Whether rays contradict a model with a way mended in fewer places, or in no more, and as many
/// places hold: where points hold the way as it was, it comes apart there.
bool DoPointsAllow(const Standing& moved, const Standing& before) {
  if (moved.faults != before.faults) return moved.faults < before.faults;
  return moved.places >= before.places;
}

CandidateMove MoveFor(const MappingState& state, const LinePieces& pieces, const Break& way) {
  const Vector3d pivot = state.Centre(way.next);
  const Vector3d by = way.shift * (pivot - state.Centre(way.image)).normalized();
  CandidateMove move;
  for (const ImageSlot image : pieces.From(way.next)) {
    const Vector3d centre = pivot + way.scale * (state.Centre(image) - pivot) + by;
    move[image] = Rigid3::FromCentre(state.CamFromWorld(image).rotation, centre);
  }
  return move;
}

}  // namespace

absl::StatusOr<bool> CarryOnByGnss(MappingState& state,
                                   const MappingOptions& options,
                                   const StageContext& context) {
  bool was_taken = false;
  for (size_t tries = 0; tries < kMaxTries;) {
    const LinePieces pieces(state, options);
    const std::vector<Break> breaks =
        WorstOf(BreaksOf(FindPlacedImages(state, pieces.Places()), pieces));
    if (breaks.empty()) break;
    const Standing standing(state, options);
    bool is_better = false;
    for (const Break& way : breaks) {
      if (is_better || tries++ >= kMaxTries) break;
      ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
      MappingState moved = state;
      PutAt(moved, MoveFor(state, pieces, way));
      RemakePoints(moved, state, options);
      ORBWEAVE_RETURN_IF_ERROR(AdjustGrowingModel(moved, options, context));
      is_better = moved.Registered().size() >= state.Registered().size() &&
                  DoPointsAllow(Standing(moved, options), standing) &&
                  IsSettled(moved, way, options) && IsLikedByGnss(moved, state, options);
      if (is_better) state = std::move(moved);
    }
    if (!is_better) break;
    was_taken = true;
  }
  return was_taken;
}

}  // namespace orbweave
