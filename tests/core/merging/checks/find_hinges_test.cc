// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/find_hinges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr uint32_t kHolding = kFewestThatTellSize;

std::map<ImageId, RegisteredImage> Images(uint32_t count) {
  std::map<ImageId, RegisteredImage> images;
  for (uint32_t i = 0; i < count; ++i) images[ImageId(i)] = {};
  return images;
}

Track SeenFrom(const std::vector<uint32_t>& images) {
  Track track;
  for (const uint32_t image : images)
    track.observations.push_back({.ref = {.image = ImageId(image)}});
  return track;
}

void AddTracks(uint32_t count, const std::vector<uint32_t>& images, std::vector<Track>& tracks) {
  for (uint32_t i = 0; i < count; ++i) tracks.push_back(SeenFrom(images));
}

/// A street of images of which each three in a row see so many points.
std::vector<Track> Street(uint32_t first, uint32_t last, uint32_t points) {
  std::vector<Track> tracks;
  for (uint32_t i = first; i + 2 <= last; ++i) AddTracks(points, {i, i + 1, i + 2}, tracks);
  return tracks;
}

std::vector<Track> Joined(std::vector<Track> tracks, const std::vector<Track>& others) {
  tracks.insert(tracks.end(), others.begin(), others.end());
  return tracks;
}

std::vector<HingedPiece> Hinges(const std::map<ImageId, RegisteredImage>& images,
                                const std::vector<Track>& tracks) {
  HingeFinder finder(images);
  for (const Track& track : tracks) finder.Add(track);
  return std::move(finder).Finish();
}

TEST(HingeFinder, FindsNothingInAStreetThatPointsHold) {
  EXPECT_THAT(Hinges(Images(40), Street(0, 39, kHolding)), IsEmpty());
  EXPECT_THAT(Hinges({}, {}), IsEmpty());
}

TEST(HingeFinder, FindsWhatHangsAtFewPoints) {
  std::vector<Track> tracks = Joined(Street(0, 29, 100), Street(30, 39, 100));
  AddTracks(kHolding - 1, {28, 29, 30}, tracks);
  const std::vector<HingedPiece> hinged = Hinges(Images(40), tracks);
  ASSERT_THAT(hinged, SizeIs(1));
  EXPECT_THAT(hinged[0].images, SizeIs(10));
  EXPECT_EQ(hinged[0].images.front(), ImageId(30));
  EXPECT_EQ(hinged[0].points, kHolding - 1);
  AddTracks(1, {29, 30, 31}, tracks);
  EXPECT_THAT(Hinges(Images(40), tracks), IsEmpty());
}

TEST(HingeFinder, PointsOfTwoPanoramasTellNoLength) {
  std::vector<Track> tracks = Joined(Street(0, 9, 100), Street(10, 19, 100));
  AddTracks(1000, {9, 10}, tracks);
  const std::vector<HingedPiece> hinged = Hinges(Images(20), tracks);
  ASSERT_THAT(hinged, SizeIs(1));
  EXPECT_EQ(hinged[0].points, 0U);
}

TEST(HingeFinder, AddsUpWhatSeveralPanoramasOfAPieceHave) {
  std::vector<Track> tracks = Joined(Street(0, 9, 100), Street(10, 19, 100));
  for (const uint32_t i : {7U, 8U, 9U}) AddTracks(kHolding / 3, {i, 10, 11}, tracks);
  EXPECT_THAT(Hinges(Images(20), tracks), IsEmpty());
}

TEST(HingeFinder, SeesThePiecesOfAChainAndWhoIsAlone) {
  std::vector<Track> tracks =
      Joined(Joined(Street(0, 9, 50), Street(10, 14, 50)), Street(15, 17, 50));
  AddTracks(5, {8, 9, 10}, tracks);
  AddTracks(7, {13, 14, 15}, tracks);
  std::map<ImageId, RegisteredImage> images = Images(20);
  images[ImageId(19)].loose = true;
  const std::vector<HingedPiece> hinged = Hinges(images, tracks);
  ASSERT_THAT(hinged, SizeIs(3));
  EXPECT_EQ(hinged[0].points, 12U);
  EXPECT_EQ(hinged[1].points, 7U);
  EXPECT_THAT(hinged[2].images, ElementsAre(ImageId(18)));
}

TEST(HingeFinder, FindsTheSameInAnyOrder) {
  std::vector<Track> tracks = Joined(Street(0, 299, 20), Street(300, 399, 20));
  AddTracks(9, {298, 299, 300}, tracks);
  std::vector<uint32_t> stop;  // so many pairs that they are counted more than once
  for (uint32_t i = 40; i < 240; ++i) stop.push_back(i);
  AddTracks(60, stop, tracks);
  std::mt19937 random(7);
  for (int draw = 0; draw < 5; ++draw) {
    std::ranges::shuffle(tracks, random);
    const std::vector<HingedPiece> hinged = Hinges(Images(400), tracks);
    ASSERT_THAT(hinged, SizeIs(1));
    EXPECT_THAT(hinged[0].images, SizeIs(100));
    EXPECT_EQ(hinged[0].points, 9U);
  }
}

}  // namespace
}  // namespace orbweave
