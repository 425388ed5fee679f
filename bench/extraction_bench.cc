// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

/// Features of an encoded panorama on one thread, decoding included: noise that was blurred at many
/// scales, JPEG of quality 95. Arguments: width in pixels; 1: from the doubled panorama, 0: from
/// the panorama itself (OpenCV's always doubles). Counter: time per megapixel.

#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/features/extract_features.h"

namespace orbweave {
namespace {

/// Noise of equal contrast in all octaves, 8-bit BGR.
cv::Mat NoiseOfAllScales(int width) {
  const cv::Size size(width, width / 2);
  cv::Mat sum(size, CV_32FC1, cv::Scalar(128.0));
  cv::RNG random(1);
  for (int cell = 1; cell <= 64; cell *= 2) {
    cv::Mat noise(size / cell, CV_32FC1);
    random.fill(noise, cv::RNG::NORMAL, 0.0, 12.0);
    cv::resize(noise, noise, size, 0, 0, cv::INTER_CUBIC);
    sum += noise;
  }
  cv::Mat bgr;
  sum.convertTo(sum, CV_8UC1);
  cv::cvtColor(sum, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

std::string EncodedPanorama(int width) {
  std::vector<uint8_t> bytes;
  cv::imencode(".jpg", NoiseOfAllScales(width), bytes);
  return {bytes.begin(), bytes.end()};
}

void Extract(benchmark::State& state, SiftDetector detector) {
  const auto width = static_cast<int>(state.range(0));
  const std::string image = EncodedPanorama(width);
  ExtractOptions options;
  options.detector = detector;
  options.first_octave = state.range(1) == 1 ? FirstOctave::kDoubled : FirstOctave::kFull;
  for (auto _ : state)
    benchmark::DoNotOptimize(ExtractFeatures({.encoded_image = image}, options, {}));
  const double megapixels = 0.5e-6 * width * width;
  state.counters["per_mpx"] =
      benchmark::Counter(megapixels * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(Extract, opencv, SiftDetector::kOpencv)
    ->ArgNames({"width", "doubled"})
    ->Args({2048, 1})
    ->Args({5376, 1})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Extract, streaming, SiftDetector::kStreaming)
    ->ArgNames({"width", "doubled"})
    ->Args({2048, 1})
    ->Args({2048, 0})
    ->Args({5376, 1})
    ->Args({5376, 0})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace orbweave
