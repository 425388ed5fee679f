// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "core/pictures/decoders.h"
#include "core/pictures/jpeg_judge.h"

namespace orbweave {
namespace {

/// Inks as Adobe's programs store them, inverted: what is left of white.
void BgrFromInverseInks(const std::vector<JSAMPLE>& cmyk, uint8_t* bgr) {
  for (size_t i = 0; 4 * i < cmyk.size(); ++i) {
    const int black = cmyk[4 * i + 3];
    for (size_t ink = 0; ink < 3; ++ink)
      bgr[3 * i + 2 - ink] = static_cast<uint8_t>(cmyk[4 * i + ink] * black / 255);
  }
}

/// Owns nothing itself: errors jump over it.
void DecodeAllRows(jpeg_decompress_struct& codec, std::vector<JSAMPLE>& inks, cv::Mat& bgr) {
  const bool has_inks = codec.num_components == 4;
  codec.out_color_space = has_inks ? JCS_CMYK : JCS_EXT_BGR;
  jpeg_start_decompress(&codec);
  if (has_inks) inks.resize(size_t{codec.output_width} * 4);
  while (codec.output_scanline < codec.output_height) {
    uint8_t* target = bgr.ptr(static_cast<int>(codec.output_scanline));
    JSAMPROW rows[1] = {has_inks ? inks.data() : target};
    jpeg_read_scanlines(&codec, rows, 1);
    if (has_inks) BgrFromInverseInks(inks, target);
  }
  jpeg_finish_decompress(&codec);
}

bool HasSizeOf(const cv::Mat& bgr, const jpeg_decompress_struct& codec) {
  return static_cast<int>(codec.image_width) == bgr.cols &&
         static_cast<int>(codec.image_height) == bgr.rows;
}

}  // namespace

absl::Status DecodeJpeg(std::string_view encoded, cv::Mat& bgr) {
  JpegJudge judge;
  std::vector<JSAMPLE> inks;
  jpeg_decompress_struct codec{};
  SetJudge(reinterpret_cast<j_common_ptr>(&codec), encoded.size(), judge);
  if (setjmp(judge.stop) == 0) {
    jpeg_create_decompress(&codec);
    jpeg_mem_src(&codec, reinterpret_cast<const unsigned char*>(encoded.data()), encoded.size());
    jpeg_read_header(&codec, TRUE);
    if (HasSizeOf(bgr, codec)) DecodeAllRows(codec, inks, bgr);
  }
  const bool fits = HasSizeOf(bgr, codec);
  jpeg_destroy_decompress(&codec);
  if (judge.problem[0] == '\0') return fits ? absl::OkStatus() : DataContradictHeader();
  return absl::InvalidArgumentError("the data are damaged (" + std::string(judge.problem) + ")");
}

}  // namespace orbweave
