// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/street_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "core/mapping/lengths/matches_in_planes.h"
#include "core/mapping/model/registered_by_drive.h"
#include "core/mapping/registration/pair_witness.h"
#include "core/scene/left_off.h"
#include "core/scene/order_along_way.h"
#include "core/scene/usual_step.h"

namespace orbweave {
namespace {

constexpr size_t kMaxSpan = 2 * kReachAlongLine;
constexpr double kMinShareAbout = 0.9;
// Of another drive over the same street two images are within half a step of one, four of two: a
// way on which two drives are torn alike is none that a camera was carried elsewhere on.
constexpr double kMuchNearer = 0.5;
constexpr size_t kFewestNear = 2;
constexpr size_t kManyNear = 5;

/// Whether most of a pair's matches are where the model has them.
bool Agrees(const MappingState& state, const LinkedPair& pair, double tolerance_px) {
  const LengthAgreement agreement = AgreementOfMatches(state, pair, tolerance_px);
  return agreement.agreeing > kAgreeingPairShare * agreement.told;
}

/// Images of one drive: as they are, or along the way where they are in no order.
void OrderDrive(const MappingState& state, std::span<ImageSlot> images) {
  std::vector<Eigen::Vector3d> places;
  for (const ImageSlot image : images) places.push_back(state.Centre(image));
  const auto order = OrderIfInNone(places);
  if (!order) return;
  const std::vector<ImageSlot> by_rank(images.begin(), images.end());
  std::ranges::transform(*order, images.begin(), [&](uint32_t i) { return by_rank[i]; });
}

/// Of images that stand drive by drive those of each.
template <typename Slot>
std::vector<std::span<Slot>> DrivesAmong(const MappingState& state, std::span<Slot> images) {
  const auto drive_of = [&](ImageSlot image) { return state.Problem().images[image].drive; };
  std::vector<std::span<Slot>> drives;
  while (!images.empty()) {
    const auto end = std::ranges::upper_bound(images, drive_of(images.front()), {}, drive_of);
    drives.push_back(images.first(static_cast<size_t>(end - images.begin())));
    images = images.subspan(drives.back().size());
  }
  return drives;
}

/// Registered images drive by drive, each in its order.
std::vector<ImageSlot> ByDrives(const MappingState& state) {
  std::vector<ImageSlot> images = RegisteredByDrive(state);
  for (const std::span<ImageSlot> drive : DrivesAmong(state, std::span(images)))
    OrderDrive(state, drive);
  return images;
}

/// Calls visit(pair) for each pair of registered images.
template <typename Visit>
void ForEachPair(const MappingState& state, const Visit& visit) {
  for (const LinkedPair& pair : state.Graph().pairs) {
    if (state.IsRegistered(pair.a) && state.IsRegistered(pair.b)) visit(pair);
  }
}

/// Tells of images that follow each other in a drive which of them are no neighbours: a camera was
/// carried to and fro, through a room say.
class Apartness {
 public:
  Apartness(const MappingState& state, const std::vector<size_t>& place, double tolerance_px)
      : state_(state), place_(place), tolerance_px_(tolerance_px) {}

  /// Whether no pair that agrees joins the two, and both have others much nearer than each other,
  /// elsewhere in the drives, to which pairs join them.
  [[nodiscard]] bool AreApart(ImageSlot a, ImageSlot b) const {
    if (JoinsPair(a, b)) return false;
    const double near = kMuchNearer * (state_.Centre(a) - state_.Centre(b)).norm();
    const size_t of_a = CountWithin(near, a);
    const size_t of_b = CountWithin(near, b);
    return std::min(of_a, of_b) >= kFewestNear && of_a + of_b >= kManyNear;
  }

 private:
  [[nodiscard]] bool JoinsPair(ImageSlot a, ImageSlot b) const {
    return std::ranges::any_of(state_.Graph().pairs_of_image[a], [&](uint32_t p) {
      const LinkedPair& pair = state_.Graph().pairs[p];
      return pair.Other(a) == b && Agrees(state_, pair, tolerance_px_);
    });
  }
  [[nodiscard]] size_t CountWithin(double distance, ImageSlot image) const {
    const auto& pairs = state_.Graph().pairs_of_image[image];
    return static_cast<size_t>(std::ranges::count_if(pairs, [&](uint32_t p) {
      const LinkedPair& pair = state_.Graph().pairs[p];
      const ImageSlot other = pair.Other(image);
      if (!state_.IsRegistered(other) ||
          !((state_.Centre(image) - state_.Centre(other)).norm() < distance))
        return false;
      const auto [first, last] = std::minmax({place_[image], place_[other]});
      return last - first > kReachAlongLine && Agrees(state_, pair, tolerance_px_);
    }));
  }

  const MappingState& state_;
  const std::vector<size_t>& place_;
  double tolerance_px_;
};

uint32_t RankOf(const MappingState& state, ImageSlot image) {
  return state.Problem().images[image].rank_in_drive;
}

bool GoesByRank(const MappingState& state, std::span<const ImageSlot> drive) {
  return std::ranges::is_sorted(drive, {}, [&](ImageSlot image) { return RankOf(state, image); });
}

/// Behind which images so many captures are missing that the next does not see what they see, in
/// drives that go by ranks.
std::vector<uint8_t> GapsBehind(const MappingState& state, const std::vector<ImageSlot>& images) {
  const auto rank_of = [&](ImageSlot image) { return RankOf(state, image); };
  std::vector<uint8_t> gaps;
  for (const std::span<const ImageSlot> drive : DrivesAmong(state, std::span(images))) {
    const bool goes_by_rank = GoesByRank(state, drive);
    for (size_t i = 0; i + 1 < drive.size(); ++i)
      gaps.push_back(goes_by_rank && rank_of(drive[i + 1]) - rank_of(drive[i]) > kReachAlongLine);
    gaps.push_back(0);
  }
  return gaps;
}

/// Behind which images the drive goes on elsewhere.
std::vector<uint8_t> EndsBehind(const MappingState& state,
                                const std::vector<ImageSlot>& images,
                                const Apartness& apartness) {
  std::vector<const PosePrior*> priors;
  for (const ImageSlot image : images) priors.push_back(&state.Problem().images[image].prior);
  std::vector<uint8_t> ends = LeftOffBehind(priors);
  const std::vector<uint8_t> gaps = GapsBehind(state, images);
  for (size_t i = 0; i + 1 < images.size(); ++i) {
    ends[i] = ends[i] != 0 || gaps[i] != 0 || apartness.AreApart(images[i], images[i + 1]);
  }
  return ends;
}

/// Divided where the drive ends or goes on elsewhere, and where no pair leads on.
std::vector<StreetLine> FindRuns(const MappingState& state,
                                 const std::vector<ImageSlot>& images,
                                 double tolerance_px) {
  std::vector<size_t> place(state.Graph().NumImages());
  for (size_t i = 0; i < images.size(); ++i) place[images[i]] = i;
  const auto drive = [&](size_t at) { return state.Problem().images[images[at]].drive; };
  const std::vector<uint8_t> ends =
      EndsBehind(state, images, Apartness(state, place, tolerance_px));
  std::vector<uint8_t> leads_on(images.size(), 0);
  ForEachPair(state, [&](const LinkedPair& pair) {
    const auto [first, last] = std::minmax({place[pair.a], place[pair.b]});
    if (last - first > kReachAlongLine || drive(first) != drive(last)) return;
    std::fill(leads_on.begin() + static_cast<std::ptrdiff_t>(first),
              leads_on.begin() + static_cast<std::ptrdiff_t>(last),
              uint8_t{1});
  });
  std::vector<StreetLine> runs;
  for (size_t i = 0; i < images.size(); ++i) {
    if (i == 0 || leads_on[i - 1] == 0 || ends[i - 1] != 0) runs.emplace_back();
    runs.back().push_back(images[i]);
  }
  return runs;
}

/// How many places on from one image of a street another one is, as far as a drive tells: captures
/// that are missing between them (ranks) count where the way is as long as that, in usual steps.
class PlacesOn {
 public:
  /// `images`: drive by drive.
  PlacesOn(const MappingState& state, const std::vector<ImageSlot>& images) : state_(state) {
    std::vector<double> steps;
    for (const std::span<const ImageSlot> drive : DrivesAmong(state, std::span(images))) {
      if (!GoesByRank(state, drive)) continue;
      by_rank_.insert(state.Problem().images[drive.front()].drive);
      for (size_t i = 0; i + 1 < drive.size(); ++i) steps.push_back(Way(drive[i], drive[i + 1]));
    }
    usual_step_ = UsualStep(std::move(steps));
  }

  /// 1 where nothing tells.
  [[nodiscard]] size_t Between(ImageSlot a, ImageSlot b) const {
    const auto& images = state_.Problem().images;
    if (images[a].drive != images[b].drive || !by_rank_.contains(images[a].drive)) return 1;
    const auto [first, last] = std::minmax({RankOf(state_, a), RankOf(state_, b)});
    const double steps = std::min<double>(last - first, std::round(Way(a, b) / usual_step_));
    return static_cast<size_t>(std::max(1.0, steps));
  }

 private:
  [[nodiscard]] double Way(ImageSlot a, ImageSlot b) const {
    return (state_.Centre(b) - state_.Centre(a)).norm();
  }

  const MappingState& state_;
  std::set<uint32_t> by_rank_{};  ///< drives
  double usual_step_ = 0.0;
};

/// One end of a run.
struct End {
  size_t run = 0;
  bool is_last = false;
  friend auto operator<=>(const End&, const End&) = default;
};

/// Two ends that runs meet at.
struct Meeting {
  End one{};
  End other{};
  size_t matches = 0;  ///< of the pairs between the runs
};

/// The pairs between two runs, lower run first, by the places of their images from either end.
class PairsBetween {
 public:
  /// `from_first`: places from the first image of its run, `from_last` from its last.
  struct Place {
    size_t from_first = 0;
    size_t from_last = 0;
  };

  /// `one` and `other`: the runs.
  PairsBetween(const StreetLine& one, const StreetLine& other, const PlacesOn& places) {
    for (Option& option : options_) {
      option.between = places.Between(option.one_is_last ? one.back() : one.front(),
                                      option.other_is_last ? other.back() : other.front());
    }
  }

  void Add(const Place& one, const Place& other, size_t matches) {
    ++pairs_;
    matches_ += matches;
    for (Option& option : options_) {
      const size_t span = (option.one_is_last ? one.from_last : one.from_first) + option.between +
                          (option.other_is_last ? other.from_last : other.from_first);
      option.about += span <= kMaxSpan ? 1 : 0;
      option.spans += span * matches;
    }
  }

  /// At the two ends that have the pairs the closest together, if they lie about these.
  [[nodiscard]] std::optional<Meeting> Find(size_t one, size_t other) const {
    const Option& best = *std::ranges::min_element(options_, {}, &Option::spans);
    if (static_cast<double>(best.about) < kMinShareAbout * static_cast<double>(pairs_))
      return std::nullopt;
    return Meeting{{one, best.one_is_last}, {other, best.other_is_last}, matches_};
  }

 private:
  struct Option {
    bool one_is_last = false;
    bool other_is_last = false;
    size_t between = 1;  ///< places from the one end to the other
    size_t about = 0;    ///< pairs within kMaxSpan places
    size_t spans = 0;    ///< places between the images of all matches
  };
  std::array<Option, 4> options_ = {{{true, false}, {false, false}, {true, true}, {false, true}}};
  size_t pairs_ = 0;
  size_t matches_ = 0;
};

/// Where runs meet, most matches first. Pairs that the model contradicts say nothing of it: places
/// that look alike.
std::vector<Meeting> FindMeetings(const MappingState& state,
                                  const std::vector<StreetLine>& runs,
                                  const PlacesOn& places,
                                  double tolerance_px) {
  std::vector<size_t> run_of(state.Graph().NumImages());
  std::vector<PairsBetween::Place> place(run_of.size());
  for (size_t run = 0; run < runs.size(); ++run) {
    for (size_t i = 0; i < runs[run].size(); ++i) {
      run_of[runs[run][i]] = run;
      place[runs[run][i]] = {i, runs[run].size() - 1 - i};
    }
  }
  std::map<std::pair<size_t, size_t>, PairsBetween> between;
  ForEachPair(state, [&](const LinkedPair& pair) {
    if (run_of[pair.a] == run_of[pair.b]) return;
    if (!Agrees(state, pair, tolerance_px)) return;
    const bool in_order = run_of[pair.a] < run_of[pair.b];
    const ImageSlot one = in_order ? pair.a : pair.b;
    const ImageSlot other = in_order ? pair.b : pair.a;
    const std::pair two(run_of[one], run_of[other]);
    between.try_emplace(two, runs[two.first], runs[two.second], places)
        .first->second.Add(
            place[one], place[other], state.Problem().pairs[pair.index].inliers.size());
  });
  std::vector<Meeting> meetings;
  for (const auto& [two, pairs] : between) {
    if (const auto meeting = pairs.Find(two.first, two.second)) meetings.push_back(*meeting);
  }
  std::ranges::stable_sort(meetings, std::greater<>(), &Meeting::matches);
  return meetings;
}

/// Runs joined at their ends, each end once, to lines without a loop.
class Joiner {
 public:
  explicit Joiner(const std::vector<StreetLine>& runs) : runs_(runs), line_of_run_(runs.size()) {
    std::iota(line_of_run_.begin(), line_of_run_.end(), 0);
  }

  void Join(const Meeting& meeting) {
    const size_t line = line_of_run_[meeting.one.run];
    const size_t other_line = line_of_run_[meeting.other.run];
    const End one = FreeOf(meeting.one);
    const End other = FreeOf(meeting.other);
    if (line == other_line || next_.contains(one) || next_.contains(other)) return;
    next_[one] = other;
    next_[other] = one;
    std::ranges::replace(line_of_run_, std::max(line, other_line), std::min(line, other_line));
  }

  /// By their lowest runs.
  [[nodiscard]] std::vector<StreetLine> Take() const {
    std::vector<StreetLine> lines;
    std::vector<uint8_t> is_taken(runs_.size(), 0);
    for (size_t run = 0; run < runs_.size(); ++run) {
      if (is_taken[run] != 0) continue;
      StreetLine& line = lines.emplace_back();
      for (std::optional<End> from = BeginOf(run); from; from = After(*from)) {
        is_taken[from->run] = 1;
        const StreetLine& images = runs_[from->run];
        if (from->is_last) {
          std::ranges::copy(images.rbegin(), images.rend(), std::back_inserter(line));
        } else {
          std::ranges::copy(images, std::back_inserter(line));
        }
      }
    }
    return lines;
  }

 private:
  /// Both ends of a run of one image are that image: the one that is free serves.
  [[nodiscard]] End FreeOf(End end) const {
    const bool is_other = runs_[end.run].size() == 1 && next_.contains(end);
    return is_other ? End{end.run, !end.is_last} : end;
  }

  /// The run that the line is entered by next, and at which end, having entered one at `from`.
  [[nodiscard]] std::optional<End> After(End from) const {
    const auto next = next_.find({from.run, !from.is_last});
    return next == next_.end() ? std::nullopt : std::optional(next->second);
  }

  /// The end to begin with of the line that `run` is of: that of the lower run.
  [[nodiscard]] End BeginOf(size_t run) const {
    const auto follow = [&](End from) {
      while (const auto next = After(from)) from = *next;
      return End{from.run, !from.is_last};
    };
    return std::min(follow({run, false}), follow({run, true}));
  }

  const std::vector<StreetLine>& runs_;
  std::vector<size_t> line_of_run_;
  std::map<End, End> next_{};
};

}  // namespace

std::vector<StreetLine> FindStreetLines(const MappingState& state, double tolerance_px) {
  const std::vector<ImageSlot> images = ByDrives(state);
  const std::vector<StreetLine> runs = FindRuns(state, images, tolerance_px);
  const PlacesOn places(state, images);
  Joiner joiner(runs);
  for (const Meeting& meeting : FindMeetings(state, runs, places, tolerance_px))
    joiner.Join(meeting);
  return joiner.Take();
}

}  // namespace orbweave
