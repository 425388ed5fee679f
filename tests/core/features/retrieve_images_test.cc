// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/retrieve_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// Images of places: an image of a place shows most of the place's descriptors, with noise.
std::vector<std::vector<uint8_t>> ImagesOfPlaces(int num_places,
                                                 int images_per_place,
                                                 uint64_t seed) {
  constexpr size_t kDescriptors = 60;
  Random random(seed);
  std::vector<std::vector<uint8_t>> samples;
  for (int place = 0; place < num_places; ++place) {
    std::vector<uint8_t> look(kDescriptors * kDescriptorSize);
    for (uint8_t& byte : look)
      byte = static_cast<uint8_t>(90.0 * random.Uniform() * random.Uniform());
    for (int image = 0; image < images_per_place; ++image) {
      std::vector<uint8_t> sample = look;
      for (uint8_t& byte : sample) byte = static_cast<uint8_t>(byte + random.Index(10));
      sample.erase(sample.end() - kDescriptorSize * static_cast<ptrdiff_t>(random.Index(10)),
                   sample.end());
      samples.push_back(sample);
    }
  }
  return samples;
}

TEST(RetrieveSimilarImages, FindsImagesOfTheSamePlaceFirst) {
  const auto samples = ImagesOfPlaces(30, 4, 1);
  const auto similar = *RetrieveSimilarImages(samples, {.num_neighbours = 3}, {});
  ASSERT_EQ(similar.size(), samples.size());
  for (uint32_t i = 0; i < similar.size(); ++i) {
    ASSERT_THAT(similar[i], SizeIs(3));
    for (const ImageId other : similar[i]) {
      EXPECT_NE(other.value, i);
      EXPECT_EQ(other.value / 4, i / 4);
    }
  }
}

TEST(RetrieveSimilarImages, FindsPlacesAmongMoreImagesThanComponents) {
  const auto samples = ImagesOfPlaces(300, 2, 2);
  const auto similar = *RetrieveSimilarImages(samples, {.num_words = 8, .num_neighbours = 1}, {});
  int right = 0;
  for (uint32_t i = 0; i < similar.size(); ++i)
    right += similar[i].front().value / 2 == i / 2 ? 1 : 0;
  EXPECT_GT(right, 590);
}

TEST(RetrieveSimilarImages, IsDeterministic) {
  const auto samples = ImagesOfPlaces(10, 3, 3);
  EXPECT_EQ(*RetrieveSimilarImages(samples, {}, {}), *RetrieveSimilarImages(samples, {}, {}));
}

TEST(RetrieveSimilarImages, GivesImagesWithoutDescriptorsAnEmptyList) {
  auto samples = ImagesOfPlaces(2, 2, 4);
  samples.insert(samples.begin() + 1, std::vector<uint8_t>());
  const auto similar = *RetrieveSimilarImages(samples, {.num_neighbours = 1}, {});
  EXPECT_THAT(similar[1], IsEmpty());
  EXPECT_THAT(similar[0], ElementsAre(ImageId(2)));
  EXPECT_THAT(similar[4], ElementsAre(ImageId(3)));
}

TEST(RetrieveSimilarImages, HandlesFewerDescriptorsThanWords) {
  std::vector<std::vector<uint8_t>> samples = ImagesOfPlaces(3, 1, 5);
  for (auto& sample : samples) sample.resize(2 * kDescriptorSize);
  const auto similar = *RetrieveSimilarImages(samples, {}, {});
  for (const auto& list : similar) EXPECT_THAT(list, SizeIs(2));
}

TEST(RetrieveSimilarImages, HandlesNoneOneAndEqualImages) {
  EXPECT_THAT(*RetrieveSimilarImages({}, {}, {}), IsEmpty());
  const auto one = ImagesOfPlaces(1, 1, 6);
  EXPECT_THAT(*RetrieveSimilarImages(one, {}, {}), ElementsAre(IsEmpty()));
  const std::vector<std::vector<uint8_t>> equal(4, std::vector<uint8_t>(kDescriptorSize * 300, 45));
  EXPECT_THAT((*RetrieveSimilarImages(equal, {}, {}))[2],
              ElementsAre(ImageId(0), ImageId(1), ImageId(3)));
}

TEST(RetrieveSimilarImages, StopsWhenToldToAndShowsLifeForEveryImage) {
  const auto samples = ImagesOfPlaces(5, 2, 7);
  int signs = 0;
  ASSERT_TRUE(RetrieveSimilarImages(samples, {}, {.alive = [&signs] { ++signs; }}).ok());
  EXPECT_GE(signs, 10);
  std::stop_source stop;
  stop.request_stop();
  const auto stopped = RetrieveSimilarImages(samples, {}, {.stop = stop.get_token()});
  EXPECT_TRUE(absl::IsCancelled(stopped.status()));
}

TEST(SampleDescriptors, TakesTheLargestFeatures) {
  Features features;
  for (int i = 0; i < 40; ++i) {
    features.keypoints.push_back({.scale_px = static_cast<float>((i * 7) % 40)});
    features.descriptors.insert(
        features.descriptors.end(), kDescriptorSize, static_cast<uint8_t>((i * 7) % 40));
  }
  const auto sample = SampleDescriptors(features, {.descriptors_per_image = 16});
  ASSERT_THAT(sample, SizeIs(16 * kDescriptorSize));
  EXPECT_EQ(sample.front(), 39);
  EXPECT_EQ(sample.back(), 24);
  EXPECT_THAT(SampleDescriptors(features, {.descriptors_per_image = 64}),
              SizeIs(40 * kDescriptorSize));
  EXPECT_THAT(SampleDescriptors({}, {}), IsEmpty());
}

}  // namespace
}  // namespace orbweave
