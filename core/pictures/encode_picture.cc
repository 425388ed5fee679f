// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pictures/encode_picture.h"

#include <png.h>

#include <cstdint>
#include <utility>

#include "core/pictures/jpeg_judge.h"

namespace orbweave {
namespace {

/// Takes libjpeg's bytes into a string, which grows as they come. libjpeg's own growing buffer is
/// told to its owner only at the end, and an error would leave it with one that is gone.
struct JpegSink {
  jpeg_destination_mgr manager{};  ///< first: libjpeg knows this address alone
  std::string bytes{};
};

JpegSink& SinkOf(j_compress_ptr codec) { return *reinterpret_cast<JpegSink*>(codec->dest); }

/// Room for as many bytes again as there are, and some.
void Grow(j_compress_ptr codec) {
  JpegSink& sink = SinkOf(codec);
  const size_t taken = sink.bytes.size();
  sink.bytes.resize(2 * taken + (size_t{64} << 10));
  sink.manager.next_output_byte = reinterpret_cast<JOCTET*>(sink.bytes.data() + taken);
  sink.manager.free_in_buffer = sink.bytes.size() - taken;
}

boolean GrowFull(j_compress_ptr codec) {
  Grow(codec);
  return TRUE;
}

void CutOff(j_compress_ptr codec) {
  JpegSink& sink = SinkOf(codec);
  sink.bytes.resize(sink.bytes.size() - sink.manager.free_in_buffer);
}

/// Owns nothing itself: errors jump over it.
void EncodeAllRows(jpeg_compress_struct& codec, const cv::Mat& pixels, int quality) {
  codec.image_width = static_cast<JDIMENSION>(pixels.cols);
  codec.image_height = static_cast<JDIMENSION>(pixels.rows);
  codec.input_components = pixels.channels();
  codec.in_color_space = pixels.channels() == 1 ? JCS_GRAYSCALE : JCS_EXT_BGR;
  jpeg_set_defaults(&codec);
  jpeg_set_quality(&codec, quality, TRUE);
  jpeg_start_compress(&codec, TRUE);
  while (codec.next_scanline < codec.image_height) {
    // libjpeg knows no const, and writes no pixel.
    JSAMPROW rows[1] = {const_cast<uint8_t*>(pixels.ptr(static_cast<int>(codec.next_scanline)))};
    jpeg_write_scanlines(&codec, rows, 1);
  }
  jpeg_finish_compress(&codec);
}

int PngFormatOf(const cv::Mat& pixels) {
  switch (pixels.channels()) {
    case 1:
      return PNG_FORMAT_GRAY;
    case 3:
      return PNG_FORMAT_BGR;
    default:
      return PNG_FORMAT_BGRA;
  }
}

}  // namespace

absl::StatusOr<std::string> EncodePng(const cv::Mat& pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(pixels.cols);
  image.height = static_cast<png_uint_32>(pixels.rows);
  image.format = static_cast<png_uint_32>(PngFormatOf(pixels));
  image.flags = PNG_IMAGE_FLAG_FAST;
  const auto row_stride = static_cast<png_int_32>(pixels.step[0]);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data, row_stride, nullptr) ==
      0) {
    return absl::InternalError("cannot encode the picture: " + std::string(image.message));
  }
  bytes.resize(size);
  return bytes;
}

absl::StatusOr<std::string> EncodeJpeg(const cv::Mat& pixels, int quality) {
  JpegJudge judge;
  JpegSink sink;
  sink.manager.init_destination = Grow;
  sink.manager.empty_output_buffer = GrowFull;
  sink.manager.term_destination = CutOff;
  jpeg_compress_struct codec{};
  SetJudge(reinterpret_cast<j_common_ptr>(&codec), 0, judge);
  if (setjmp(judge.stop) == 0) {
    jpeg_create_compress(&codec);
    codec.dest = &sink.manager;
    EncodeAllRows(codec, pixels, quality);
  }
  jpeg_destroy_compress(&codec);
  if (judge.problem[0] != '\0')
    return absl::InternalError("cannot encode the picture: " + std::string(judge.problem));
  return std::move(sink.bytes);
}

}  // namespace orbweave
