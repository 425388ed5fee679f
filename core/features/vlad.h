// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace orbweave {

/// Visual words: columns (kDescriptorSize x at most `num_words`) by k-means on descriptors of all
/// samples, k-means++ seeded from their bytes (Arthur, Vassilvitskii, SODA 2007). A word for every
/// descriptor when there are fewer descriptors than words; none without descriptors.
[[nodiscard]] Eigen::MatrixXf TrainWords(const std::vector<std::vector<uint8_t>>& samples,
                                         int num_words);

/// Vector of locally aggregated descriptors, kDescriptorSize x words: per word the sum of the
/// residuals of the descriptors nearest to it, signed square root, each word of unit length (intra-
/// normalisation), all of unit length; zero when every descriptor is a word.
/// Jegou et al., CVPR 2010; Arandjelovic, Zisserman, CVPR 2013.
[[nodiscard]] Eigen::VectorXf ComputeVlad(std::span<const uint8_t> sample,
                                          const Eigen::MatrixXf& words);

}  // namespace orbweave
