// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include <webp/decode.h>

#include <cstdint>

#include "core/pictures/decoders.h"

namespace orbweave {

absl::Status DecodeWebp(std::string_view encoded, cv::Mat& bgr) {
  const auto* bytes = reinterpret_cast<const uint8_t*>(encoded.data());
  int width_px = 0;
  int height_px = 0;
  if (WebPGetInfo(bytes, encoded.size(), &width_px, &height_px) == 0)
    return absl::InvalidArgumentError("the data are corrupt");
  if (width_px != bgr.cols || height_px != bgr.rows) return DataContradictHeader();
  const auto stride = static_cast<int>(bgr.step[0]);
  const size_t size = bgr.step[0] * static_cast<size_t>(bgr.rows);
  if (WebPDecodeBGRInto(bytes, encoded.size(), bgr.data, size, stride) == nullptr)
    return absl::InvalidArgumentError("the data are corrupt");
  return absl::OkStatus();
}

}  // namespace orbweave
