// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/vlad.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/base/random.h"
#include "core/scene/features.h"

namespace orbweave {
namespace {

constexpr size_t kTrainingDescriptorsPerWord = 256;
constexpr int kMaxIterations = 20;
constexpr float kDescriptorLength = 512.0F;

using ByteMatrix = Eigen::Map<const Eigen::Matrix<uint8_t, kDescriptorSize, Eigen::Dynamic>>;

/// Unit descriptors as columns.
Eigen::MatrixXf ToColumns(std::span<const uint8_t> bytes) {
  const ByteMatrix columns(
      bytes.data(), kDescriptorSize, static_cast<Eigen::Index>(bytes.size() / kDescriptorSize));
  return columns.cast<float>() / kDescriptorLength;
}

/// At most `limit` descriptors, evenly from all samples.
std::vector<uint8_t> TrainingBytes(const std::vector<std::vector<uint8_t>>& samples, size_t limit) {
  std::vector<const uint8_t*> all;
  for (const std::vector<uint8_t>& sample : samples) {
    for (size_t at = 0; at < sample.size(); at += kDescriptorSize) all.push_back(&sample[at]);
  }
  const size_t count = std::min(limit, all.size());
  std::vector<uint8_t> bytes;
  bytes.reserve(count * kDescriptorSize);
  for (size_t i = 0; i < count; ++i) {
    const uint8_t* const descriptor = all[i * all.size() / count];
    bytes.insert(bytes.end(), descriptor, descriptor + kDescriptorSize);
  }
  return bytes;
}

/// Index drawn with probability proportional to its weight; uniform when all weights are zero.
Eigen::Index Draw(const Eigen::VectorXf& weights, Random& random) {
  const double total = weights.cast<double>().sum();
  if (total <= 0.0) return random.Index(static_cast<uint32_t>(weights.size()));
  double rest = random.Uniform() * total;
  Eigen::Index last = 0;
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    if (weights[i] <= 0.0F) continue;
    last = i;
    rest -= weights[i];
    if (rest < 0.0) break;
  }
  return last;
}

Eigen::MatrixXf SeedWords(const Eigen::MatrixXf& descriptors,
                          Eigen::Index num_words,
                          Random& random) {
  Eigen::MatrixXf words(descriptors.rows(), num_words);
  words.col(0) = descriptors.col(random.Index(static_cast<uint32_t>(descriptors.cols())));
  Eigen::VectorXf nearest = (descriptors.colwise() - words.col(0)).colwise().squaredNorm();
  for (Eigen::Index w = 1; w < num_words; ++w) {
    words.col(w) = descriptors.col(Draw(nearest, random));
    const Eigen::VectorXf distances =
        (descriptors.colwise() - words.col(w)).colwise().squaredNorm();
    nearest = nearest.cwiseMin(distances);
  }
  return words;
}

/// Index of the nearest word per descriptor, the first of equals.
std::vector<Eigen::Index> NearestWords(const Eigen::MatrixXf& descriptors,
                                       const Eigen::MatrixXf& words) {
  const Eigen::VectorXf half_norms = 0.5F * words.colwise().squaredNorm().transpose();
  const Eigen::MatrixXf scores = (words.transpose() * descriptors).colwise() - half_norms;
  std::vector<Eigen::Index> nearest(static_cast<size_t>(descriptors.cols()));
  for (size_t i = 0; i < nearest.size(); ++i)
    scores.col(static_cast<Eigen::Index>(i)).maxCoeff(&nearest[i]);
  return nearest;
}

/// Means of the descriptors nearest to each word; a word without any stays.
Eigen::MatrixXf MeanOfNearest(const Eigen::MatrixXf& descriptors,
                              const std::vector<Eigen::Index>& nearest,
                              const Eigen::MatrixXf& words) {
  Eigen::MatrixXf sums = Eigen::MatrixXf::Zero(words.rows(), words.cols());
  Eigen::VectorXf counts = Eigen::VectorXf::Zero(words.cols());
  for (size_t i = 0; i < nearest.size(); ++i) {
    sums.col(nearest[i]) += descriptors.col(static_cast<Eigen::Index>(i));
    counts[nearest[i]] += 1.0F;
  }
  for (Eigen::Index w = 0; w < words.cols(); ++w) {
    sums.col(w) =
        counts[w] > 0.0F ? Eigen::VectorXf(sums.col(w) / counts[w]) : Eigen::VectorXf(words.col(w));
  }
  return sums;
}

}  // namespace

Eigen::MatrixXf TrainWords(const std::vector<std::vector<uint8_t>>& samples, int num_words) {
  const std::vector<uint8_t> bytes =
      TrainingBytes(samples, kTrainingDescriptorsPerWord * static_cast<size_t>(num_words));
  const Eigen::MatrixXf descriptors = ToColumns(bytes);
  if (descriptors.cols() <= num_words) return descriptors;
  Random random(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  Eigen::MatrixXf words = SeedWords(descriptors, num_words, random);
  std::vector<Eigen::Index> nearest;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    std::vector<Eigen::Index> now_nearest = NearestWords(descriptors, words);
    if (now_nearest == nearest) break;
    nearest = std::move(now_nearest);
    words = MeanOfNearest(descriptors, nearest, words);
  }
  return words;
}

Eigen::VectorXf ComputeVlad(std::span<const uint8_t> sample, const Eigen::MatrixXf& words) {
  const Eigen::MatrixXf descriptors = ToColumns(sample);
  const std::vector<Eigen::Index> nearest = NearestWords(descriptors, words);
  Eigen::MatrixXf residuals = Eigen::MatrixXf::Zero(words.rows(), words.cols());
  for (size_t i = 0; i < nearest.size(); ++i) {
    residuals.col(nearest[i]) +=
        descriptors.col(static_cast<Eigen::Index>(i)) - words.col(nearest[i]);
  }
  residuals = residuals.cwiseSign().cwiseProduct(residuals.cwiseAbs().cwiseSqrt());
  for (Eigen::Index w = 0; w < words.cols(); ++w) residuals.col(w).normalize();  // zero stays zero
  return Eigen::Map<const Eigen::VectorXf>(residuals.data(), residuals.size()).normalized();
}

}  // namespace orbweave
