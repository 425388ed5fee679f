// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/find_hinges.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace orbweave {
namespace {

// Pairs are counted when there are so many, or twice as many as were left over.
constexpr size_t kPairsAtOnce = 1 << 18;

std::vector<ImageId> ImagesInPlace(const std::map<ImageId, RegisteredImage>& images) {
  std::vector<ImageId> in_place;
  for (const auto& [id, image] : images) {
    if (!image.loose) in_place.push_back(id);
  }
  return in_place;
}

size_t PairsAmong(size_t pieces) { return pieces * (pieces - 1) / 2; }

void SortUnique(std::vector<uint32_t>& places) {
  std::ranges::sort(places);
  const auto repeated = std::ranges::unique(places);
  places.erase(repeated.begin(), repeated.end());
}

}  // namespace

HingeFinder::HingeFinder(const std::map<ImageId, RegisteredImage>& images)
    : images_(ImagesInPlace(images)),
      pieces_(static_cast<uint32_t>(images_.size())),
      pairs_to_reduce_(kPairsAtOnce) {}

void HingeFinder::Add(const Track& track) {
  std::vector<Place> seen_from;
  for (const Observation& seen : track.observations) {
    const auto at = std::ranges::lower_bound(images_, seen.ref.image);
    if (at != images_.end() && *at == seen.ref.image)
      seen_from.push_back(static_cast<Place>(at - images_.begin()));
  }
  SortUnique(seen_from);
  if (seen_from.size() < kImagesThatTellSize) return;
  std::vector<Place> pieces = PiecesOf(seen_from);
  if (pieces.size() < 2) return;
  pairs_ += PairsAmong(pieces.size());
  open_.push_back(std::move(pieces));
  if (pairs_ >= pairs_to_reduce_) Reduce();
}

std::vector<HingedPiece> HingeFinder::Finish() && {
  Reduce();
  std::map<Place, HingedPiece> pieces;
  for (Place place = 0; place < images_.size(); ++place)
    pieces[pieces_.Find(place)].images.push_back(images_[place]);
  for (const std::vector<Place>& track : open_) {
    for (const Place piece : track) ++pieces[piece].points;
  }
  std::vector<HingedPiece> hinged;
  for (auto& [representative, piece] : pieces) hinged.push_back(std::move(piece));
  std::ranges::sort(hinged, {}, [](const HingedPiece& piece) { return piece.images.front(); });
  std::ranges::stable_sort(
      hinged, std::greater<>(), [](const HingedPiece& piece) { return piece.images.size(); });
  if (!hinged.empty()) hinged.erase(hinged.begin());
  return hinged;
}

std::vector<HingeFinder::Place> HingeFinder::PiecesOf(const std::vector<Place>& track) {
  std::vector<Place> pieces;
  for (const Place place : track) pieces.push_back(pieces_.Find(place));
  SortUnique(pieces);
  return pieces;
}

bool HingeFinder::UnitePieces() {
  std::vector<std::pair<Place, Place>> in_common;
  for (const std::vector<Place>& track : open_) {
    for (size_t i = 0; i < track.size(); ++i) {
      for (size_t j = i + 1; j < track.size(); ++j) in_common.emplace_back(track[i], track[j]);
    }
  }
  std::ranges::sort(in_common);
  bool has_united = false;
  for (auto run = in_common.begin(); run != in_common.end();) {
    const auto end = std::upper_bound(run, in_common.end(), *run);
    if (end - run >= kFewestThatTellSize) has_united |= pieces_.Unite(run->first, run->second);
    run = end;
  }
  return has_united;
}

void HingeFinder::Reduce() {
  while (UnitePieces()) {
    for (std::vector<Place>& track : open_) track = PiecesOf(track);
    std::erase_if(open_, [](const std::vector<Place>& track) { return track.size() < 2; });
  }
  pairs_ = 0;
  for (const std::vector<Place>& track : open_) pairs_ += PairsAmong(track.size());
  pairs_to_reduce_ = std::max(kPairsAtOnce, 2 * pairs_);
}

}  // namespace orbweave
