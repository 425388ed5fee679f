// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>

#include "core/pictures/decoders.h"
#include "core/pictures/image_header.h"

namespace orbweave {
namespace {

/// Samples of one byte or two (the more significant first), brought from 0..largest to 0..255.
class PnmSamples {
 public:
  PnmSamples(std::string_view bytes, int largest) : bytes_(bytes), largest_(largest) {}

  [[nodiscard]] uint8_t operator[](size_t index) const {
    const auto byte = [this](size_t at) { return int{static_cast<uint8_t>(bytes_[at])}; };
    const int value = largest_ > 255 ? byte(2 * index) << 8 | byte(2 * index + 1) : byte(index);
    return static_cast<uint8_t>((std::min(value, largest_) * 255 + largest_ / 2) / largest_);
  }

 private:
  std::string_view bytes_;
  int largest_ = 0;
};

}  // namespace

absl::Status DecodePnm(std::string_view encoded, cv::Mat& bgr) {
  const PnmHeader header = ReadPnmHeader(encoded);
  if (header.width_px != bgr.cols || header.height_px != bgr.rows) return DataContradictHeader();
  if (header.largest < 1 || header.largest > 65535)
    return absl::InvalidArgumentError("the header names no largest value of 1 to 65535");
  if (encoded.size() < header.pixels_at + header.NumBytes())
    return absl::InvalidArgumentError("the file is truncated");
  const PnmSamples samples(encoded.substr(header.pixels_at), header.largest);
  const auto channels = static_cast<size_t>(header.channels);
  for (int row = 0; row < bgr.rows; ++row) {
    uint8_t* target = bgr.ptr(row);
    for (int column = 0; column < bgr.cols; ++column) {
      const size_t pixel =
          static_cast<size_t>(row) * static_cast<size_t>(bgr.cols) + static_cast<size_t>(column);
      for (size_t i = 0; i < 3; ++i)
        *target++ = samples[pixel * channels + (channels == 1 ? 0 : 2 - i)];
    }
  }
  return absl::OkStatus();
}

}  // namespace orbweave
