// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pictures/image_header.h"

#include <algorithm>
#include <cstdint>

#include "core/base/status.h"

namespace orbweave {
namespace {

enum class Endian { kLittle, kBig };

/// Unsigned numbers at byte offsets; 0 beyond the end, so that callers check once.
class Bytes {
 public:
  Bytes(std::string_view data, Endian endian) : data_(data), endian_(endian) {}

  [[nodiscard]] size_t size() const { return data_.size(); }
  [[nodiscard]] uint32_t U8(size_t at) const {
    return at < data_.size() ? static_cast<uint8_t>(data_[at]) : 0;
  }
  [[nodiscard]] uint32_t U16(size_t at) const {
    return endian_ == Endian::kBig ? U8(at) << 8 | U8(at + 1) : U8(at + 1) << 8 | U8(at);
  }
  [[nodiscard]] uint32_t U24(size_t at) const { return U8(at + 2) << 16 | U16(at); }
  [[nodiscard]] uint32_t U32(size_t at) const {
    return endian_ == Endian::kBig ? U16(at) << 16 | U16(at + 2) : U16(at + 2) << 16 | U16(at);
  }

 private:
  std::string_view data_;
  Endian endian_;
};

/// Dimensions beyond 2^30 are nonsense; the cap keeps later arithmetic in int.
int Dimension(uint32_t value) { return static_cast<int>(std::min(value, 1U << 30)); }

bool IsJpegFrameHeader(uint32_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

bool IsJpegMarkerWithoutLength(uint32_t marker) {
  return marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8);
}

/// Walks the marker segments, over the entropy-coded data, to the end of image. Thumbnails lie
/// within APPn segments and are stepped over.
ImageHeader ReadJpeg(std::string_view data) {
  const Bytes bytes(data, Endian::kBig);
  ImageHeader header{.complete = false};
  size_t at = 2;
  while (at + 1 < bytes.size()) {
    if (bytes.U8(at) != 0xFF || bytes.U8(at + 1) == 0x00 || bytes.U8(at + 1) == 0xFF) {
      ++at;  // entropy-coded data, a stuffed zero, or fill bytes
      continue;
    }
    const uint32_t marker = bytes.U8(at + 1);
    at += 2;
    if (marker == 0xD9) {
      header.complete = true;
      return header;
    }
    if (IsJpegMarkerWithoutLength(marker)) continue;
    if (IsJpegFrameHeader(marker) && header.width_px == 0) {
      header.height_px = Dimension(bytes.U16(at + 3));
      header.width_px = Dimension(bytes.U16(at + 5));
    }
    at += std::max<uint32_t>(2, bytes.U16(at));
  }
  return header;
}

ImageHeader ReadPng(std::string_view data) {
  const Bytes bytes(data, Endian::kBig);
  ImageHeader header{.width_px = Dimension(bytes.U32(16)),
                     .height_px = Dimension(bytes.U32(20)),
                     .complete = false};
  for (size_t at = 8; at + 12 <= bytes.size(); at += 12 + size_t{bytes.U32(at)}) {
    if (data.substr(at + 4, 4) == "IEND") header.complete = true;
  }
  return header;
}

ImageHeader ReadTiff(std::string_view data, Endian endian) {
  const Bytes bytes(data, endian);
  ImageHeader header;
  const size_t directory = bytes.U32(4);
  for (uint32_t i = 0; i < bytes.U16(directory); ++i) {
    const size_t entry = directory + 2 + size_t{12} * i;
    if (entry >= bytes.size()) break;
    const uint32_t tag = bytes.U16(entry);
    const bool is_short = bytes.U16(entry + 2) == 3;
    const uint32_t value = is_short ? bytes.U16(entry + 8) : bytes.U32(entry + 8);
    // Of a tag that is there twice the larger counts, whichever the decoder takes.
    if (tag == 256) header.width_px = std::max(header.width_px, Dimension(value));
    if (tag == 257) header.height_px = std::max(header.height_px, Dimension(value));
  }
  return header;
}

/// Bytes of an uncompressed BMP up to the end of its last row: rows are filled up to 4 bytes.
size_t BmpBytes(const Bytes& bytes, const ImageHeader& header, uint32_t bits_per_pixel) {
  const size_t row_bytes = (size_t(header.width_px) * std::min(bits_per_pixel, 64U) + 31) / 32 * 4;
  return bytes.U32(10) + row_bytes * static_cast<size_t>(header.height_px);
}

/// Both headers of a BMP: OS/2's of 12 bytes with sides of 16 bits, and all later ones.
ImageHeader ReadBmp(std::string_view data) {
  const Bytes bytes(data, Endian::kLittle);
  if (bytes.U32(14) == 12) {
    ImageHeader header{.width_px = Dimension(bytes.U16(18)), .height_px = Dimension(bytes.U16(20))};
    header.complete = BmpBytes(bytes, header, bytes.U16(24)) <= bytes.size();
    return header;
  }
  const auto height = static_cast<int32_t>(bytes.U32(22));  // negative: rows from the top
  ImageHeader header{.width_px = Dimension(bytes.U32(18)),
                     .height_px = Dimension(height < 0 ? 0U - bytes.U32(22) : bytes.U32(22))};
  const bool compressed = bytes.U32(30) == 1 || bytes.U32(30) == 2;  // by run lengths
  header.complete =
      (compressed ? bytes.U32(2) : BmpBytes(bytes, header, bytes.U16(28))) <= bytes.size();
  return header;
}

/// The number at `at` of a PNM header, behind blanks and comments ("# ..." up to the end of the
/// line); moves `at` behind it. 0 where there is none, capped like every dimension.
int TakePnmNumber(std::string_view data, size_t& at) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  while (at < data.size() && (data[at] == '#' || kBlanks.find(data[at]) != kBlanks.npos))
    at = data[at] == '#' ? std::min(data.find('\n', at), data.size()) : at + 1;
  uint32_t value = 0;
  for (; at < data.size() && data[at] >= '0' && data[at] <= '9'; ++at)
    value = value < 1U << 26 ? value * 10 + static_cast<uint32_t>(data[at] - '0') : 1U << 30;
  return Dimension(value);
}

ImageHeader ReadPnm(std::string_view data) {
  const PnmHeader pnm = ReadPnmHeader(data);
  return {
      .width_px = pnm.width_px,
      .height_px = pnm.height_px,
      .complete = data.size() >= pnm.pixels_at && data.size() - pnm.pixels_at >= pnm.NumBytes()};
}

ImageHeader ReadWebp(std::string_view data) {
  const Bytes bytes(data, Endian::kLittle);
  const std::string_view kind = data.substr(12, 4);
  ImageHeader header{.complete = bytes.size() >= 8 + size_t{bytes.U32(4)}};
  if (kind == "VP8X") {
    header.width_px = Dimension(bytes.U24(24) + 1);
    header.height_px = Dimension(bytes.U24(27) + 1);
  } else if (kind == "VP8L") {
    header.width_px = Dimension((bytes.U32(21) & 0x3FFF) + 1);
    header.height_px = Dimension((bytes.U32(21) >> 14 & 0x3FFF) + 1);
  } else if (kind == "VP8 ") {
    header.width_px = Dimension(bytes.U16(26) & 0x3FFF);
    header.height_px = Dimension(bytes.U16(28) & 0x3FFF);
  }
  return header;
}

absl::StatusOr<ImageHeader> ReadByKind(std::string_view data) {
  switch (IdentifyImage(data)) {
    case ImageKind::kJpeg:
      return ReadJpeg(data);
    case ImageKind::kPng:
      return ReadPng(data);
    case ImageKind::kTiff:
      return ReadTiff(data, data.front() == 'I' ? Endian::kLittle : Endian::kBig);
    case ImageKind::kBmp:
      return ReadBmp(data);
    case ImageKind::kWebp:
      return ReadWebp(data);
    case ImageKind::kPnm:
      return ReadPnm(data);
    case ImageKind::kUnknown:
      break;
  }
  if (data.empty()) return absl::InvalidArgumentError("the file is empty");
  return absl::InvalidArgumentError("neither JPEG, PNG, TIFF, BMP, WebP nor binary PPM or PGM");
}

}  // namespace

size_t PnmHeader::NumBytes() const {
  const size_t pixels = static_cast<size_t>(width_px) * static_cast<size_t>(height_px);
  return pixels * static_cast<size_t>(channels) * (largest > 255 ? 2U : 1U);
}

PnmHeader ReadPnmHeader(std::string_view encoded) {
  size_t at = 2;
  PnmHeader header;
  header.width_px = TakePnmNumber(encoded, at);
  header.height_px = TakePnmNumber(encoded, at);
  header.largest = TakePnmNumber(encoded, at);
  header.channels = encoded.starts_with("P6") ? 3 : 1;
  header.pixels_at = at + 1;
  return header;
}

ImageKind IdentifyImage(std::string_view encoded) {
  using namespace std::string_view_literals;
  if (encoded.starts_with("\xFF\xD8\xFF"sv)) return ImageKind::kJpeg;
  if (encoded.starts_with("\x89PNG\r\n\x1A\n"sv)) return ImageKind::kPng;
  if (encoded.starts_with("II*\0"sv) || encoded.starts_with("MM\0*"sv)) return ImageKind::kTiff;
  if (encoded.starts_with("BM"sv)) return ImageKind::kBmp;
  if (encoded.starts_with("RIFF"sv) && encoded.size() > 16 && encoded.substr(8, 4) == "WEBP"sv)
    return ImageKind::kWebp;
  if (encoded.starts_with("P5"sv) || encoded.starts_with("P6"sv)) return ImageKind::kPnm;
  return ImageKind::kUnknown;
}

absl::StatusOr<ImageHeader> ReadImageHeader(std::string_view encoded) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageHeader header, ReadByKind(encoded));
  if (header.width_px <= 0 || header.height_px <= 0) {
    return absl::InvalidArgumentError("the header names no width and height");
  }
  return header;
}

}  // namespace orbweave
