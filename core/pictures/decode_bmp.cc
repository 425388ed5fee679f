// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>

#include "core/pictures/decoders.h"

namespace orbweave {
namespace {

constexpr uint32_t kRgb = 0;        // compression: none
constexpr uint32_t kBitFields = 3;  // none, the channels' places are told

/// The fields of a BMP that its pixels are found by; numbers are little-endian, 0 beyond the end.
struct BmpLayout {
  explicit BmpLayout(std::string_view file) : bytes(file) {
    is_os2 = Number(14, 4) == 12;
    pixels_at = Number(10, 4);
    bits = Number(is_os2 ? 24 : 28, 2);
    compression = is_os2 ? kRgb : Number(30, 4);
    from_top = !is_os2 && static_cast<int32_t>(Number(22, 4)) < 0;
    palette_at = 14 + size_t{Number(14, 4)};
  }

  [[nodiscard]] uint32_t Number(size_t at, size_t size) const {
    uint32_t value = 0;
    for (size_t i = size; i-- > 0;)
      value = value << 8 | (at + i < bytes.size() ? static_cast<uint8_t>(bytes[at + i]) : 0U);
    return value;
  }

  /// Whether blue, green and red are the first three bytes of a pixel (of a palette's entry).
  [[nodiscard]] bool IsPlain() const {
    if (bits == 8 || bits == 24) return compression == kRgb;
    if (bits != 32) return false;
    return compression == kRgb || (compression == kBitFields && Number(54, 4) == 0xFF0000U &&
                                   Number(58, 4) == 0xFF00U && Number(62, 4) == 0xFFU);
  }

  std::string_view bytes;
  bool is_os2 = false;
  bool from_top = false;
  size_t pixels_at = 0;
  size_t palette_at = 0;
  uint32_t bits = 0;
  uint32_t compression = kRgb;
};

void StoreRow(const BmpLayout& layout, size_t row_at, uint8_t* bgr, int width_px) {
  const size_t pixel_bytes = layout.bits / 8;
  const size_t entry_bytes = layout.is_os2 ? 3 : 4;
  for (size_t i = 0; i < static_cast<size_t>(width_px); ++i) {
    size_t at = row_at + i * pixel_bytes;
    if (pixel_bytes == 1) at = layout.palette_at + entry_bytes * layout.Number(at, 1);
    for (size_t channel = 0; channel < 3; ++channel)
      bgr[3 * i + channel] = static_cast<uint8_t>(layout.Number(at + channel, 1));
  }
}

}  // namespace

absl::Status DecodeBmp(std::string_view encoded, cv::Mat& bgr) {
  const BmpLayout layout(encoded);
  if (!layout.IsPlain()) {
    return absl::InvalidArgumentError(
        "a BMP that is compressed or has other than 8, 24 or 32 bits a pixel; make it a PNG");
  }
  const size_t row_bytes = (static_cast<size_t>(bgr.cols) * layout.bits + 31) / 32 * 4;
  for (int row = 0; row < bgr.rows; ++row) {
    const int stored = layout.from_top ? row : bgr.rows - 1 - row;
    StoreRow(
        layout, layout.pixels_at + row_bytes * static_cast<size_t>(stored), bgr.ptr(row), bgr.cols);
  }
  return absl::OkStatus();
}

}  // namespace orbweave
