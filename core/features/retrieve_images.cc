// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/retrieve_images.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>
#include <span>

#include "core/features/order_by_scale.h"
#include "core/features/vlad.h"

namespace orbweave {
namespace {

constexpr size_t kMaxComponents = 512;
constexpr float kSmallestEigenvalue = 1e-4F;  // of the largest
constexpr Eigen::Index kImagesAtOnce = 256;

std::vector<size_t> NonEmpty(const std::vector<std::vector<uint8_t>>& samples) {
  std::vector<size_t> indices;
  for (size_t i = 0; i < samples.size(); ++i) {
    if (!samples[i].empty()) indices.push_back(i);
  }
  return indices;
}

/// Principal directions (columns) of the VLAD vectors of at most kMaxComponents images, evenly
/// chosen, by the eigenvectors of their small Gram matrix. Up to that many images the projection
/// keeps all angles; beyond it keeps memory at 2 kB per image. Jegou, Chum, ECCV 2012.
Eigen::MatrixXf PrincipalDirections(const std::vector<std::vector<uint8_t>>& samples,
                                    const std::vector<size_t>& images,
                                    const Eigen::MatrixXf& words) {
  const size_t count = std::min(images.size(), kMaxComponents);
  Eigen::MatrixXf vlads(words.size(), static_cast<Eigen::Index>(count));
  for (size_t i = 0; i < count; ++i) {
    vlads.col(static_cast<Eigen::Index>(i)) =
        ComputeVlad(samples[images[i * images.size() / count]], words);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXf> gram(vlads.transpose() * vlads);
  const Eigen::VectorXf& values = gram.eigenvalues();  // ascending
  const float smallest = std::max(kSmallestEigenvalue * values[values.size() - 1], 1e-12F);
  const Eigen::Index kept = (values.array() > smallest).count();
  return vlads * gram.eigenvectors().rightCols(kept) *
         values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
}

/// Unit signatures of the images, one per column.
absl::StatusOr<Eigen::MatrixXf> Signatures(const std::vector<std::vector<uint8_t>>& samples,
                                           const std::vector<size_t>& images,
                                           int num_words,
                                           const StageContext& context) {
  const Eigen::MatrixXf words = TrainWords(samples, num_words);
  const Eigen::MatrixXf directions = PrincipalDirections(samples, images, words);
  Eigen::MatrixXf signatures(directions.cols(), static_cast<Eigen::Index>(images.size()));
  for (size_t i = 0; i < images.size(); ++i) {
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    signatures.col(static_cast<Eigen::Index>(i)) =
        (directions.transpose() * ComputeVlad(samples[images[i]], words)).normalized();
  }
  return signatures;
}

/// The images with the highest scores except `self`, best first, smaller ids first among equals.
std::vector<ImageId> BestOthers(const Eigen::VectorXf& scores,
                                const std::vector<size_t>& images,
                                size_t self,
                                size_t count) {
  std::vector<size_t> order(images.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::erase(order, self);
  const auto end = order.begin() + static_cast<ptrdiff_t>(std::min(count, order.size()));
  std::partial_sort(order.begin(), end, order.end(), [&](size_t x, size_t y) {
    const float score_x = scores[static_cast<Eigen::Index>(x)];
    const float score_y = scores[static_cast<Eigen::Index>(y)];
    return score_x != score_y ? score_x > score_y : x < y;
  });
  std::vector<ImageId> best;
  for (auto it = order.begin(); it != end; ++it)
    best.emplace_back(static_cast<uint32_t>(images[*it]));
  return best;
}

}  // namespace

std::vector<uint8_t> SampleDescriptors(const Features& features, const RetrievalOptions& options) {
  if (features.descriptors.empty()) return {};
  std::vector<FeatureIndex> order = OrderByScale(features);
  order.resize(std::min(order.size(), static_cast<size_t>(options.descriptors_per_image)));
  std::vector<uint8_t> sample;
  for (const FeatureIndex i : order) {
    sample.insert(sample.end(), features.Descriptor(i), features.Descriptor(i) + kDescriptorSize);
  }
  return sample;
}

absl::StatusOr<std::vector<std::vector<ImageId>>> RetrieveSimilarImages(
    const std::vector<std::vector<uint8_t>>& samples,
    const RetrievalOptions& options,
    const StageContext& context) {
  std::vector<std::vector<ImageId>> similar(samples.size());
  const std::vector<size_t> images = NonEmpty(samples);
  if (images.size() < 2 || options.num_neighbours == 0) return similar;
  ORBWEAVE_ASSIGN_OR_RETURN(const Eigen::MatrixXf signatures,
                            Signatures(samples, images, options.num_words, context));
  for (Eigen::Index first = 0; first < signatures.cols(); first += kImagesAtOnce) {
    const Eigen::Index count = std::min(kImagesAtOnce, signatures.cols() - first);
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    const Eigen::MatrixXf scores = signatures.transpose() * signatures.middleCols(first, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto self = static_cast<size_t>(first + i);
      similar[images[self]] =
          BestOthers(scores.col(i), images, self, static_cast<size_t>(options.num_neighbours));
    }
  }
  return similar;
}

}  // namespace orbweave
