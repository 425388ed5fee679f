// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/mending/candidate_moves.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <span>

#include "core/mapping/lengths/centre_by_lengths.h"
#include "core/mapping/lengths/find_gap_shift.h"
#include "core/mapping/lengths/find_wall_shift.h"
#include "core/mapping/lengths/line_pieces.h"
#include "core/mapping/lengths/log_length_of_pair.h"
#include "core/mapping/lengths/matches_in_planes.h"
#include "core/mapping/lengths/measure_gap_lengths.h"
#include "core/mapping/lengths/measure_pair_lengths.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr size_t kMaxPairs = 2;

/// A way that rays contradict, what each of its sides says, and the shifts that they or the rays to
/// one wall clearly want.
struct ToldGap {
  ImageSlot image = 0;
  ImageSlot next = 0;
  GapShift before{};
  GapShift behind{};
  std::vector<double> shifts{};
};

std::vector<ToldGap> FindToldGaps(const AskedRays& asked) {
  std::vector<ToldGap> told;
  for (const GapVotes& votes : CollectGapVotes(asked)) {
    ToldGap gap{votes.image,
                votes.next,
                FindGapShift(asked, votes, votes.before),
                FindGapShift(asked, votes, votes.behind)};
    for (const GapShift& side : {gap.before, gap.behind}) {
      if (side.IsClear()) gap.shifts.push_back(side.shift);
    }
    const GapShift wall = FindWallShift(asked, votes);
    if (IsToldByWall(wall.here, wall.elsewhere)) gap.shifts.push_back(wall.shift);
    if (!gap.shifts.empty()) told.push_back(std::move(gap));
  }
  return told;
}

class ShiftLister {
 public:
  ShiftLister(const MappingState& state, const MappingOptions& options)
      : state_(state), options_(options), pieces_(state, options) {}

  std::vector<CandidateMove> Run() {
    const std::vector<ToldGap> gaps = FindToldGaps({state_, options_});
    for (size_t i = 0; i < gaps.size(); ++i) {
      const ToldGap* const following = i + 1 < gaps.size() ? &gaps[i + 1] : nullptr;
      for (const double shift : gaps[i].shifts) AddShifts(gaps[i], shift, following);
      AddScale(gaps[i]);
    }
    AddSingles(gaps);
    return std::move(moves_);
  }

 private:
  [[nodiscard]] Vector3d WayOf(const ToldGap& gap) const {
    return (state_.Centre(gap.next) - state_.Centre(gap.image)).normalized();
  }

  void AddShifts(const ToldGap& gap, double shift, const ToldGap* following) {
    const Vector3d by = shift * WayOf(gap);
    Add(pieces_.From(gap.next), by);
    const bool is_of_line =
        following != nullptr && pieces_.AreOfOneLine(following->image, gap.image);
    if (is_of_line) Add(pieces_.Between(gap.next, following->image), by);
    Add({gap.next}, by);
    Add({gap.image}, -by);
  }

  void Add(const std::vector<ImageSlot>& images, const Vector3d& by) {
    moves_.push_back(Shifted(state_, images, by));
  }

  [[nodiscard]] Rigid3 At(ImageSlot image, const Vector3d& centre) const {
    return Rigid3::FromCentre(state_.CamFromWorld(image).rotation, centre);
  }

  /// Everything behind the gap on the scale of what is before it.
  void AddScale(const ToldGap& gap) {
    const double length = (state_.Centre(gap.next) - state_.Centre(gap.image)).norm();
    const double before = length + gap.before.shift;
    const double behind = length + gap.behind.shift;
    if (!(before > 0.0) || !(behind > 0.0)) return;
    const double scale = before / behind;
    if (std::abs(std::log(scale)) <= kCloseTolerance) return;
    const Vector3d pivot = state_.Centre(gap.next);
    const Vector3d by = gap.before.shift * WayOf(gap);
    CandidateMove move;
    for (const ImageSlot image : pieces_.From(gap.next))
      move[image] = At(image, pivot + scale * (state_.Centre(image) - pivot) + by);
    moves_.push_back(std::move(move));
  }

  void AddSingles(std::span<const ToldGap> gaps) {
    std::set<ImageSlot> images;
    for (const ToldGap& gap : gaps) images.insert({gap.image, gap.next});
    for (const LengthFault& fault : FindLengthFaults(state_, options_)) {
      images.insert(SlotOf(state_.Problem(), fault.image).value());
      if (fault.next) images.insert(SlotOf(state_.Problem(), *fault.next).value());
    }
    for (const ImageSlot image : images) {
      if (!state_.IsRegistered(image)) continue;
      if (const auto centre = CentreByLengths(state_, image, options_))
        moves_.push_back({{image, At(image, *centre)}});
    }
  }

  const MappingState& state_;
  const MappingOptions& options_;
  LinePieces pieces_;
  std::vector<CandidateMove> moves_{};
};

/// The general ones of most matches, kMaxPairs at most.
std::vector<uint32_t> StrongestOf(const MappingState& state, std::vector<uint32_t> pairs) {
  const auto geometry = [&](uint32_t p) -> const TwoViewGeometry& {
    return state.Problem().pairs[state.Graph().pairs[p].index];
  };
  std::erase_if(pairs, [&](uint32_t p) { return geometry(p).kind != TwoViewKind::kGeneral; });
  std::ranges::stable_sort(
      pairs, std::greater<>(), [&](uint32_t p) { return geometry(p).inliers.size(); });
  pairs.resize(std::min(pairs.size(), kMaxPairs));
  return pairs;
}

/// The piece as the pair has one of its images stand to one that is not of it; none where it has
/// both or neither.
CandidateMove TurnedBy(const MappingState& state,
                       const LinkedPair& pair,
                       const std::vector<ImageSlot>& piece) {
  const bool a_moves = std::ranges::find(piece, pair.a) != piece.end();
  const bool b_moves = std::ranges::find(piece, pair.b) != piece.end();
  if (a_moves == b_moves) return {};
  const Rigid3& b_from_a = state.Problem().pairs[pair.index].b_from_a;
  const ImageSlot stays = b_moves ? pair.a : pair.b;
  const ImageSlot moves = b_moves ? pair.b : pair.a;
  Rigid3 moving_from_staying = b_moves ? b_from_a : b_from_a.Inverse();
  moving_from_staying.translation *=
      (state.Centre(moves) - state.Centre(stays)).norm() / moving_from_staying.translation.norm();
  const Rigid3 before_from_after =
      state.CamFromWorld(moves).Inverse() * moving_from_staying * state.CamFromWorld(stays);
  CandidateMove move;
  for (const ImageSlot image : piece) move[image] = state.CamFromWorld(image) * before_from_after;
  return move;
}

}  // namespace

std::vector<CandidateMove> ListShifts(const MappingState& state, const MappingOptions& options) {
  return ShiftLister(state, options).Run();
}

std::vector<CandidateMove> ListTurns(const MappingState& state, const MappingOptions& options) {
  const LinePieces pieces(state, options);
  std::vector<CandidateMove> turns;
  AgreeingMatches matches(state, kMatchTolerance * options.max_error_px);
  for (const WayAlongLine& way : WaysAlongLines(state, pieces.Places())) {
    if (!IsAskew(matches.Across(way))) continue;
    const std::vector<ImageSlot> piece = pieces.From(way.next);
    for (const uint32_t pair : StrongestOf(state, way.pairs)) {
      CandidateMove turn = TurnedBy(state, state.Graph().pairs[pair], piece);
      if (!turn.empty()) turns.push_back(std::move(turn));
    }
  }
  return turns;
}

}  // namespace orbweave
