// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/cubes/cube_face_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/pictures/decode_picture.h"
#include "core/pictures/encode_picture.h"
#include "core/pictures/image_header.h"

namespace orbweave {
namespace {

using Faces = std::array<std::string, kCubeFaces>;

constexpr int kMaxSamples = 16;  // of a pixel, along an axis
constexpr int kJpegQuality = 95;

const uint8_t* PixelAt(const PanoramaPixels& panorama, int row, int column) {
  const auto [width, height] = panorama.camera;
  if (row < 0 || row >= height) {  // over the pole, down the other side
    row = row < 0 ? -1 - row : 2 * height - 1 - row;
    column += width / 2;
  }
  const int wrapped = (column % width + width) % width;
  const auto place =
      static_cast<size_t>(row) * static_cast<size_t>(width) + static_cast<size_t>(wrapped);
  return panorama.bytes.data() + place * static_cast<size_t>(panorama.channels);
}

/// Adds the bilinear value in a direction.
void AddSample(const PanoramaPixels& panorama,
               const Eigen::Vector3d& bearing,
               std::span<double> sum) {
  const Eigen::Vector2d place = panorama.camera.PixelFromBearing(bearing).array() - 0.5;
  const auto column = static_cast<int>(std::floor(place.x()));
  const auto row = static_cast<int>(std::floor(place.y()));
  const double right = place.x() - column;
  const double down = place.y() - row;
  const uint8_t* a = PixelAt(panorama, row, column);
  const uint8_t* b = PixelAt(panorama, row, column + 1);
  const uint8_t* c = PixelAt(panorama, row + 1, column);
  const uint8_t* d = PixelAt(panorama, row + 1, column + 1);
  for (size_t i = 0; i < sum.size(); ++i) {
    sum[i] += (1.0 - down) * ((1.0 - right) * a[i] + right * b[i]) +
              down * ((1.0 - right) * c[i] + right * d[i]);
  }
}

PanoramaPixels PixelsOf(const cv::Mat& image) {
  return {
      {image.cols, image.rows}, image.channels(), {image.data, image.total() * image.elemSize()}};
}

/// A face as a matrix that lies in the bytes of `pixels`.
cv::Mat FaceOf(std::vector<uint8_t>& pixels, PinholeFace pinhole, int type) {
  return {pinhole.size_px, pinhole.size_px, type, pixels.data()};
}

}  // namespace

std::vector<uint8_t> ResampleFace(const PanoramaPixels& panorama, int face, PinholeFace pinhole) {
  const auto size = static_cast<size_t>(pinhole.size_px);
  const auto channels = static_cast<size_t>(panorama.channels);
  const double reduction = panorama.camera.width_px / (std::numbers::pi * pinhole.size_px);
  const int samples = std::clamp(static_cast<int>(std::ceil(reduction - 0.01)), 1, kMaxSamples);
  const Eigen::Matrix3d cam_from_face = FaceFromCamera(face).transpose();
  std::vector<uint8_t> pixels(size * size * channels);
  std::vector<double> sum(channels);
  for (size_t pixel = 0; pixel < size * size; ++pixel) {
    std::ranges::fill(sum, 0.0);
    for (int sample = 0; sample < samples * samples; ++sample) {
      const Eigen::Vector2d place(
          static_cast<double>(pixel % size) + (sample % samples + 0.5) / samples,
          static_cast<double>(pixel / size) + (sample / samples + 0.5) / samples);
      AddSample(panorama, cam_from_face * pinhole.BearingFromPixel(place), sum);
    }
    for (size_t i = 0; i < channels; ++i) {
      pixels[pixel * channels + i] =
          static_cast<uint8_t>(std::lround(sum[i] / (samples * samples)));
    }
  }
  return pixels;
}

absl::StatusOr<Faces> EncodeCubeFaces(std::string_view encoded,
                                      const EquirectangularCamera& camera,
                                      PinholeFace pinhole) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageHeader header, ReadImageHeader(encoded));
  if (header.width_px != camera.width_px || header.height_px != camera.height_px) {
    return absl::InvalidArgumentError(absl::StrCat("the panorama has ",
                                                   header.width_px,
                                                   " x ",
                                                   header.height_px,
                                                   " pixels, not the ",
                                                   camera.width_px,
                                                   " x ",
                                                   camera.height_px,
                                                   " it was reconstructed with"));
  }
  const absl::StatusOr<cv::Mat> image = DecodePicture(encoded);
  if (!image.ok()) return Annotate(image.status(), "the panorama cannot be decoded");
  Faces faces;
  for (int face = 0; face < kCubeFaces; ++face) {
    std::vector<uint8_t> pixels = ResampleFace(PixelsOf(*image), face, pinhole);
    ORBWEAVE_ASSIGN_OR_RETURN(faces[static_cast<size_t>(face)],
                              EncodeJpeg(FaceOf(pixels, pinhole, CV_8UC3), kJpegQuality));
  }
  return faces;
}

absl::StatusOr<Faces> EncodeCubeMasks(std::string_view encoded,
                                      bool ignores_white,
                                      PinholeFace pinhole) {
  const absl::StatusOr<cv::Mat> mask = DecodeGreyPicture(encoded);
  if (!mask.ok()) return Annotate(mask.status(), "the mask cannot be decoded");
  Faces faces;
  for (int face = 0; face < kCubeFaces; ++face) {
    std::vector<uint8_t> pixels = ResampleFace(PixelsOf(*mask), face, pinhole);
    for (uint8_t& pixel : pixels) pixel = (pixel > 127) == ignores_white ? 0 : 255;
    ORBWEAVE_ASSIGN_OR_RETURN(faces[static_cast<size_t>(face)],
                              EncodePng(FaceOf(pixels, pinhole, CV_8UC1)));
  }
  return faces;
}

}  // namespace orbweave
