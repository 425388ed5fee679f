// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/options.h"
#include "core/base/stage_context.h"
#include "core/scene/features.h"
#include "core/scene/ids.h"

namespace orbweave {

struct RetrievalOptions {
  int descriptors_per_image = 256;
  int num_words = 64;
  int num_neighbours = 10;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("descriptors_per_image",
          self.descriptors_per_image,
          "largest features used to recognise a place",
          Range{16, 4096});
    visit("num_words",
          self.num_words,
          "visual words of the VLAD vocabulary, trained on the job's own images",
          Range{8, 1024});
    visit("num_neighbours",
          self.num_neighbours,
          "most similar images proposed per image",
          Range{0, 1000});
  }
};

/// The descriptors by which a place is recognised: those of the largest-scale features,
/// descriptors_per_image x kDescriptorSize bytes (fewer when the image has fewer).
[[nodiscard]] std::vector<uint8_t> SampleDescriptors(const Features& features,
                                                     const RetrievalOptions& options);

/// For every image the most similar others by VLAD (Jegou et al., CVPR 2010), best first.
/// `samples[i]` belongs to image i; empty ones get an empty list. Deterministic.
[[nodiscard]] absl::StatusOr<std::vector<std::vector<ImageId>>> RetrieveSimilarImages(
    const std::vector<std::vector<uint8_t>>& samples,
    const RetrievalOptions& options,
    const StageContext& context);

}  // namespace orbweave
