// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstdint>
#include <string>
#include <vector>

#include "core/pictures/decoders.h"

namespace orbweave {
namespace {

/// The bytes that are still to be read, and libpng's last words.
struct PngSource {
  std::string_view rest{};
  std::jmp_buf stop{};
  char problem[128] = {};
};

void TakeBytes(png_structp png, png_bytep target, size_t size) {
  auto& source = *static_cast<PngSource*>(png_get_io_ptr(png));
  if (source.rest.size() < size) png_error(png, "the data end early");
  std::copy_n(source.rest.data(), size, reinterpret_cast<char*>(target));
  source.rest.remove_prefix(size);
}

[[noreturn]] void StopAtError(png_structp png, png_const_charp message) {
  auto& source = *static_cast<PngSource*>(png_get_error_ptr(png));
  const std::string_view words(message);
  std::copy_n(words.data(), std::min(words.size(), sizeof(source.problem) - 1), source.problem);
  std::longjmp(source.stop, 1);
}

void StaySilent(png_structp /*png*/, png_const_charp /*message*/) {}

/// Whatever the file holds becomes 8-bit BGR.
void AskForBgr(png_structp png) {
  png_set_expand(png);
  png_set_strip_16(png);
  png_set_strip_alpha(png);
  png_set_gray_to_rgb(png);
  png_set_bgr(png);
  png_set_interlace_handling(png);
}

/// False where the size is another one. Owns nothing itself: errors jump over it.
bool DecodeAllRows(png_structp png, png_infop info, std::vector<png_bytep>& rows, cv::Mat& bgr) {
  png_read_info(png, info);
  AskForBgr(png);
  png_read_update_info(png, info);
  if (static_cast<int>(png_get_image_width(png, info)) != bgr.cols ||
      static_cast<int>(png_get_image_height(png, info)) != bgr.rows ||
      png_get_rowbytes(png, info) != static_cast<size_t>(bgr.cols) * 3)
    return false;
  for (int row = 0; row < bgr.rows; ++row) rows.push_back(bgr.ptr(row));
  png_read_image(png, rows.data());
  png_read_end(png, nullptr);
  return true;
}

}  // namespace

absl::Status DecodePng(std::string_view encoded, cv::Mat& bgr) {
  PngSource source{.rest = encoded};
  std::vector<png_bytep> rows;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, StopAtError, StaySilent);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  bool fits = true;
  if (info == nullptr) {
    png_destroy_read_struct(&png, nullptr, nullptr);
    return absl::ResourceExhaustedError("no memory to decode a PNG");
  }
  if (setjmp(source.stop) == 0) {
    // A panorama's text and profiles may be large; what they take of memory is libpng's limit.
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_read_fn(png, &source, TakeBytes);
    fits = DecodeAllRows(png, info, rows, bgr);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  if (source.problem[0] != '\0')
    return absl::InvalidArgumentError("the data are damaged (" + std::string(source.problem) + ")");
  return fits ? absl::OkStatus() : DataContradictHeader();
}

}  // namespace orbweave
