// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "core/pictures/decoders.h"

namespace orbweave {
namespace {

/// The file in memory, where libtiff reads, and what it complained of first.
struct TiffSource {
  std::string_view bytes{};
  size_t at = 0;
  char problem[256] = {};
};

TiffSource& SourceOf(thandle_t handle) { return *static_cast<TiffSource*>(handle); }

tmsize_t ReadBytes(thandle_t handle, void* target, tmsize_t size) {
  TiffSource& source = SourceOf(handle);
  const size_t rest = source.bytes.size() - std::min(source.at, source.bytes.size());
  const size_t taken = std::min(rest, static_cast<size_t>(std::max<tmsize_t>(size, 0)));
  if (taken > 0) std::memcpy(target, source.bytes.data() + source.at, taken);
  source.at += taken;
  return static_cast<tmsize_t>(taken);
}

tmsize_t WriteNothing(thandle_t /*handle*/, void* /*bytes*/, tmsize_t /*size*/) { return 0; }

toff_t Seek(thandle_t handle, toff_t offset, int from) {
  TiffSource& source = SourceOf(handle);
  const size_t start = from == SEEK_CUR ? source.at : from == SEEK_END ? source.bytes.size() : 0;
  return source.at = start + offset;
}

toff_t SizeOf(thandle_t handle) { return SourceOf(handle).bytes.size(); }

int CloseNothing(thandle_t /*handle*/) { return 0; }

int KeepProblem(TIFF* /*tiff*/, void* user, const char*, const char* format, va_list values) {
  auto& source = *static_cast<TiffSource*>(user);
  if (source.problem[0] == '\0')
    std::vsnprintf(source.problem, sizeof(source.problem), format, values);
  return 1;
}

int StaySilent(TIFF* /*tiff*/, void* /*user*/, const char*, const char*, va_list) { return 1; }

struct CloseTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using OpenedTiff = std::unique_ptr<TIFF, CloseTiff>;

OpenedTiff Open(TiffSource& source) {
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                             TIFFOpenOptionsFree);
  if (options == nullptr) return nullptr;
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), KeepProblem, &source);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), StaySilent, &source);
  // "m": the bytes are copied, not mapped.
  return OpenedTiff(TIFFClientOpenExt("picture",
                                      "rm",
                                      &source,
                                      ReadBytes,
                                      WriteNothing,
                                      Seek,
                                      CloseNothing,
                                      SizeOf,
                                      nullptr,
                                      nullptr,
                                      options.get()));
}

/// Rows that are decoded at one go: a strip, or a row of tiles.
int RowsAtOnce(TIFF* tiff, int height_px) {
  uint32_t rows = 0;
  const auto tag = TIFFIsTiled(tiff) != 0 ? TIFFTAG_TILELENGTH : TIFFTAG_ROWSPERSTRIP;
  TIFFGetFieldDefaulted(tiff, tag, &rows);
  return static_cast<int>(std::clamp<uint32_t>(rows, 1, static_cast<uint32_t>(height_px)));
}

void StoreRow(const uint32_t* abgr, uint8_t* bgr, int width_px) {
  for (int i = 0; i < width_px; ++i) {
    bgr[3 * i] = static_cast<uint8_t>(TIFFGetB(abgr[i]));
    bgr[3 * i + 1] = static_cast<uint8_t>(TIFFGetG(abgr[i]));
    bgr[3 * i + 2] = static_cast<uint8_t>(TIFFGetR(abgr[i]));
  }
}

/// Band by band, so that no second picture lies in memory where the file has many strips.
bool StoreRows(TIFF* tiff, TIFFRGBAImage& reader, cv::Mat& bgr) {
  const int band = RowsAtOnce(tiff, bgr.rows);
  std::vector<uint32_t> abgr(static_cast<size_t>(band) * static_cast<size_t>(bgr.cols));
  reader.req_orientation = reader.orientation;  // as the rows lie in the file
  for (int first = 0; first < bgr.rows; first += band) {
    const int rows = std::min(band, bgr.rows - first);
    reader.row_offset = first;
    if (TIFFRGBAImageGet(
            &reader, abgr.data(), static_cast<uint32_t>(bgr.cols), static_cast<uint32_t>(rows)) ==
        0)
      return false;
    for (int row = 0; row < rows; ++row)
      StoreRow(
          abgr.data() + static_cast<ptrdiff_t>(row) * bgr.cols, bgr.ptr(first + row), bgr.cols);
  }
  return true;
}

absl::Status ProblemOf(const TiffSource& source, const char* otherwise) {
  const std::string words = source.problem[0] == '\0' ? otherwise : source.problem;
  return absl::InvalidArgumentError("the data are damaged (" + words + ")");
}

}  // namespace

absl::Status DecodeTiff(std::string_view encoded, cv::Mat& bgr) {
  TiffSource source{.bytes = encoded};
  const OpenedTiff tiff = Open(source);
  if (tiff == nullptr) return ProblemOf(source, "no directory");
  char why_not[1024] = {};
  if (TIFFRGBAImageOK(tiff.get(), why_not) == 0) {
    return absl::InvalidArgumentError("a TIFF of a form that is not read (" + std::string(why_not) +
                                      "); make it one of 8 or 16 bits a sample");
  }
  TIFFRGBAImage reader{};
  if (TIFFRGBAImageBegin(&reader, tiff.get(), 1, why_not) == 0) return ProblemOf(source, why_not);
  const bool fits =
      static_cast<int>(reader.width) == bgr.cols && static_cast<int>(reader.height) == bgr.rows;
  const bool stored = fits && StoreRows(tiff.get(), reader, bgr);
  TIFFRGBAImageEnd(&reader);
  if (!fits) return DataContradictHeader();
  return stored && source.problem[0] == '\0' ? absl::OkStatus()
                                             : ProblemOf(source, "it ends early");
}

}  // namespace orbweave
