// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/uneven_stops.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/base/quantile.h"
#include "core/scene/usual_step.h"

namespace orbweave {
namespace {

constexpr size_t kFewestSteps = 2;
constexpr size_t kMostSteps = 4;
constexpr uint32_t kMostPlaces = 3;
constexpr size_t kAround = 12;
constexpr size_t kFewestAround = 4;
constexpr double kEven = 0.3;
constexpr double kWhole = 0.15;
constexpr double kQuartiles = 3.0;
constexpr double kKnownShare = 0.4;
constexpr double kSamePlace = 0.02;
constexpr double kRefuted_sigmas = 3.0;
constexpr double kCosineAlike = 0.5;  // to 60 degrees

/// A way from one stop to the next.
struct Step {
  double length = 0.0;
  double places = 0.0;

  [[nodiscard]] double Each() const { return length / places; }
};

std::vector<Step> StepsOf(std::span<const DriveStop> stops) {
  std::vector<Step> steps;
  for (size_t i = 0; i + 1 < stops.size(); ++i) {
    steps.push_back({(stops[i + 1].centre - stops[i].centre).norm(),
                     static_cast<double>(stops[i + 1].place - stops[i].place)});
  }
  return steps;
}

/// Steps as they are around a run, and what is uneven among them.
struct Usual {
  double step = 0.0;
  double limit = 0.0;
};

std::optional<Usual> UsualAround(std::span<const Step> steps, size_t first, size_t last) {
  std::vector<double> around;
  for (size_t i = first > kAround ? first - kAround : 0; i < std::min(last + kAround, steps.size());
       ++i) {
    const bool is_around = (i < first || i >= last) && steps[i].places >= 1.0;
    if (is_around) around.push_back(steps[i].Each());
  }
  if (around.size() < kFewestAround) return std::nullopt;
  const double median = Quantile(around, 0.5);
  const double spread = Quantile(around, 0.75) - Quantile(around, 0.25);
  if (!(median > 0.0) || spread > kEven * median) return std::nullopt;
  return Usual{median, std::max(kLeastUneven_steps, kQuartiles * spread / median)};
}

/// All steps of a run, as long as they are or, of one there and one back, as far as the ends are
/// apart; nullopt where neither is as long as steps are.
std::optional<Step> WholeOf(std::span<const Step> run, double apart, const Usual& usual) {
  Step whole;
  for (const Step& step : run) {
    if (step.places < 1.0 || step.places > kMostPlaces) return std::nullopt;
    whole.length += step.length;
    whole.places += step.places;
  }
  const auto is_as_usual = [&] {
    return std::abs(whole.Each() - usual.step) <= kWhole * usual.step;
  };
  if (is_as_usual()) return whole;
  if (run.size() > kFewestSteps) return std::nullopt;
  whole.length = apart;
  return is_as_usual() ? std::optional(whole) : std::nullopt;
}

/// Whether a video has one of its frames twice there, and lacks another.
bool HasFrameTwice(std::span<const Step> run, const Usual& usual) {
  return std::ranges::any_of(
      run, [&](const Step& step) { return step.length <= kSamePlace * usual.step; });
}

/// The stop of a run of steps [first, last) that is off the most, where that is uneven.
std::optional<UnevenStop> JudgeRun(std::span<const DriveStop> stops,
                                   std::span<const Step> steps,
                                   size_t first,
                                   size_t last) {
  const std::optional<Usual> usual = UsualAround(steps, first, last);
  if (!usual) return std::nullopt;
  const double apart = (stops[last].centre - stops[first].centre).norm();
  const std::span<const Step> run = steps.subspan(first, last - first);
  if (HasFrameTwice(run, *usual)) return std::nullopt;
  const auto known = WholeOf(run, apart, *usual);
  if (!known) return std::nullopt;
  const Step whole = *known;
  UnevenStop worst{.first = first, .last = last, .step = usual->step};
  Step so_far;
  for (size_t i = first; i + 1 < last; ++i) {
    so_far.length += steps[i].length;
    so_far.places += steps[i].places;
    const double share = so_far.length / whole.length;
    const double even_share = so_far.places / whole.places;
    const double off_steps = std::abs(share - even_share) * whole.length / usual->step;
    if (off_steps <= worst.off_steps) continue;
    worst.stop = i + 1;
    worst.share = share;
    worst.even_share = even_share;
    worst.off_steps = off_steps;
  }
  if (worst.off_steps < usual->limit) return std::nullopt;
  return worst;
}

/// Whether a step is as long as those around.
bool IsUsual(const Step& step, const Usual& usual) {
  if (step.places < 1.0 || step.places > kMostPlaces) return false;
  return std::abs(step.Each() - usual.step) <= kEven * usual.step;
}

/// What a vanished step has on one side.
enum class Side { kUsual, kUnusual, kEnd };

/// Of step i; `next`: -1 or 1. Whatever is more than a run's places away is another piece.
Side SideOf(std::span<const Step> steps, size_t i, int next, const Usual& usual) {
  if (next < 0 ? i == 0 : i + 1 == steps.size()) return Side::kEnd;
  const Step& step = steps[next < 0 ? i - 1 : i + 1];
  if (IsUsual(step, usual)) return Side::kUsual;
  return step.length > kMostPlaces * usual.step ? Side::kEnd : Side::kUnusual;
}

bool LeadAlike(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.dot(b) >= kCosineAlike * a.norm() * b.norm();
}

/// Whether step i leads back between two that lead on.
bool LeadsBack(std::span<const DriveStop> stops, size_t i) {
  if (i == 0 || i + 2 >= stops.size()) return false;
  const Eigen::Vector3d before = stops[i].centre - stops[i - 1].centre;
  const Eigen::Vector3d step = stops[i + 1].centre - stops[i].centre;
  const Eigen::Vector3d behind = stops[i + 2].centre - stops[i + 1].centre;
  return LeadAlike(before, behind) && LeadAlike(-step, before + behind);
}

/// A step as positions have it.
struct ByPositions {
  double length_m = 0.0;
  double sigma_m = 0.0;
};

std::optional<ByPositions> AskPositions(const std::function<const PosePrior&(size_t)>& prior_of,
                                        size_t from) {
  const PosePrior& a = prior_of(from);
  const PosePrior& b = prior_of(from + 1);
  if (!a.position_in_enu || !b.position_in_enu) return std::nullopt;
  return ByPositions{DistanceBetween(a, b), SigmaBetween(a, b)};
}

/// Whether positions have the step lead back against the way from the one before it to the one
/// behind it, too.
bool LeadsBackByPositions(const std::function<const PosePrior&(size_t)>& prior_of, size_t from) {
  const auto way = [&](size_t first, size_t last) -> Eigen::Vector2d {
    return (*prior_of(last).position_in_enu - *prior_of(first).position_in_enu).head<2>();
  };
  return way(from, from + 1).dot(way(from - 1, from + 2)) < 0.0;
}

/// The mean length of the steps as usual beside it, as positions have them, per place.
std::optional<double> LengthBeside(const VanishedStep& vanished,
                                   std::span<const DriveStop> stops,
                                   const std::function<const PosePrior&(size_t)>& prior_of) {
  double sum_m = 0.0;
  double count = 0.0;
  for (const size_t stop : {vanished.stop, vanished.stop + 1}) {
    if (vanished.end == stop) continue;
    const size_t from = stop == vanished.stop ? stop - 1 : stop;
    const auto beside = AskPositions(prior_of, from);
    if (!beside) return std::nullopt;
    sum_m += beside->length_m / (stops[from + 1].place - stops[from].place);
    count += 1.0;
  }
  return sum_m / count;
}

bool Overlap(const UnevenStop& one, const UnevenStop& other) {
  return one.first < other.last && other.first < one.last;
}

}  // namespace

std::vector<UnevenStop> FindUnevenStops(std::span<const DriveStop> stops) {
  const std::vector<Step> steps = StepsOf(stops);
  std::vector<UnevenStop> candidates;
  for (size_t first = 0; first < steps.size(); ++first) {
    for (size_t count = kFewestSteps; count <= kMostSteps && first + count <= steps.size();
         ++count) {
      if (const auto uneven = JudgeRun(stops, steps, first, first + count))
        candidates.push_back(*uneven);
    }
  }
  std::ranges::stable_sort(candidates, std::greater<>(), &UnevenStop::off_steps);
  std::vector<UnevenStop> found;
  for (const UnevenStop& candidate : candidates) {
    if (std::ranges::none_of(found,
                             [&](const UnevenStop& other) { return Overlap(candidate, other); }))
      found.push_back(candidate);
  }
  std::ranges::sort(found, {}, &UnevenStop::stop);
  return found;
}

bool IsBorneOut(const UnevenStop& uneven,
                const PosePrior& first,
                const PosePrior& stop,
                const PosePrior& last) {
  if (!first.position_in_enu || !stop.position_in_enu || !last.position_in_enu) return false;
  const Eigen::Vector2d from = first.position_in_enu->head<2>();
  const Eigen::Vector2d way = last.position_in_enu->head<2>() - from;
  const double length_m = way.norm();
  const double at_m = (stop.position_in_enu->head<2>() - from).dot(way.normalized());
  const double sigma_m = std::hypot(stop.horizontal_sigma_m,
                                    uneven.even_share * last.horizontal_sigma_m,
                                    (1.0 - uneven.even_share) * first.horizontal_sigma_m);
  const double off_m = (uneven.share - uneven.even_share) * length_m;
  const double by_gnss_m = at_m - uneven.even_share * length_m;
  return sigma_m <= kKnownShare * std::abs(off_m) &&
         std::abs(by_gnss_m - off_m) < std::abs(by_gnss_m);
}

std::vector<VanishedStep> FindVanishedSteps(std::span<const DriveStop> stops) {
  const std::vector<Step> steps = StepsOf(stops);
  std::vector<VanishedStep> found;
  for (size_t i = 0; i < steps.size(); ++i) {
    const std::optional<Usual> usual = UsualAround(steps, i, i + 1);
    if (!usual) continue;
    const double length = (LeadsBack(stops, i) ? -1.0 : 1.0) * steps[i].length;
    const double share = length / usual->step;
    const double most = std::min(kMostVanished_steps, 1.0 - usual->limit);
    if (std::abs(share) <= kSamePlace || share >= most) continue;
    const Side before = SideOf(steps, i, -1, *usual);
    const Side behind = SideOf(steps, i, 1, *usual);
    VanishedStep vanished{.stop = i, .step = usual->step, .share = share};
    if (before == Side::kEnd && behind == Side::kUsual) vanished.end = i;
    if (before == Side::kUsual && behind == Side::kEnd) vanished.end = i + 1;
    if (vanished.end || (before == Side::kUsual && behind == Side::kUsual))
      found.push_back(vanished);
  }
  return found;
}

bool IsDoubted(const VanishedStep& vanished,
               std::span<const DriveStop> stops,
               const std::function<const PosePrior&(size_t)>& prior_of) {
  const size_t from = vanished.stop;
  const std::optional<ByPositions> own = AskPositions(prior_of, from);
  const auto beside_m = LengthBeside(vanished, stops, prior_of);
  if (!own || !beside_m) return !vanished.end;
  const double short_m = vanished.share * *beside_m;
  const bool leads_back = vanished.share < 0.0 && LeadsBackByPositions(prior_of, from);
  const double own_m = (leads_back ? -1.0 : 1.0) * own->length_m;
  const bool is_as_usual = std::abs(own_m - short_m) >= std::abs(own_m - *beside_m);
  if (vanished.end) return is_as_usual && own_m - short_m > kRefuted_sigmas * own->sigma_m;
  return is_as_usual || own->sigma_m > kKnownShare * (*beside_m - short_m);
}

}  // namespace orbweave
