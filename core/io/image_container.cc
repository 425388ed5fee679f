// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/image_container.h"

#include <cstdint>
#include <string>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n"sv;

uint8_t Byte(std::string_view bytes, size_t i) { return static_cast<uint8_t>(bytes[i]); }

/// Little-endian 32 bits at `i`; there are at least four bytes.
uint64_t Little32(std::string_view bytes, size_t i) {
  return static_cast<uint64_t>(Byte(bytes, i)) | static_cast<uint64_t>(Byte(bytes, i + 1)) << 8 |
         static_cast<uint64_t>(Byte(bytes, i + 2)) << 16 |
         static_cast<uint64_t>(Byte(bytes, i + 3)) << 24;
}

uint64_t Big32(std::string_view bytes, size_t i) {
  return static_cast<uint64_t>(Byte(bytes, i)) << 24 |
         static_cast<uint64_t>(Byte(bytes, i + 1)) << 16 |
         static_cast<uint64_t>(Byte(bytes, i + 2)) << 8 | static_cast<uint64_t>(Byte(bytes, i + 3));
}

absl::Status Truncated(std::string_view bytes) {
  return absl::InvalidArgumentError(absl::StrCat(
      "truncated: the data end after ", bytes.size(), " bytes, before the image does"));
}

/// Walks the marker segments up to the first scan; within a scan FF D9 can only be the end of the
/// image.
bool JpegIsComplete(std::string_view bytes) {
  size_t at = 2;
  while (at + 4 <= bytes.size()) {
    if (Byte(bytes, at) != 0xff) return false;
    const uint8_t marker = Byte(bytes, at + 1);
    if (marker == 0xff) {  // fill byte
      ++at;
      continue;
    }
    const size_t length = static_cast<size_t>(Byte(bytes, at + 2)) << 8 | Byte(bytes, at + 3);
    at += 2 + length;
    if (marker == 0xda)
      return at < bytes.size() && bytes.find("\xff\xd9"sv, at) != std::string_view::npos;
  }
  return false;
}

bool PngIsComplete(std::string_view bytes) {
  size_t at = kPngSignature.size();
  while (at + 12 <= bytes.size()) {
    const uint64_t length = Big32(bytes, at);
    if (bytes.substr(at + 4, 4) == "IEND"sv) return true;
    at += 12 + length;
  }
  return false;
}

}  // namespace

ImageKind IdentifyImage(std::string_view encoded) {
  if (encoded.starts_with("\xff\xd8\xff"sv)) return ImageKind::kJpeg;
  if (encoded.starts_with(kPngSignature)) return ImageKind::kPng;
  if (encoded.starts_with("II*\0"sv) || encoded.starts_with("MM\0*"sv)) return ImageKind::kTiff;
  if (encoded.starts_with("BM"sv) && encoded.size() >= 26) return ImageKind::kBmp;
  if (encoded.size() >= 12 && encoded.starts_with("RIFF"sv) && encoded.substr(8, 4) == "WEBP"sv)
    return ImageKind::kWebp;
  if (encoded.starts_with("P5"sv) || encoded.starts_with("P6"sv)) return ImageKind::kPnm;
  return ImageKind::kUnknown;
}

absl::Status CheckComplete(std::string_view encoded) {
  bool complete = true;
  switch (IdentifyImage(encoded)) {
    case ImageKind::kJpeg:
      complete = JpegIsComplete(encoded);
      break;
    case ImageKind::kPng:
      complete = PngIsComplete(encoded);
      break;
    case ImageKind::kBmp:
      complete = Little32(encoded, 2) <= encoded.size();
      break;
    case ImageKind::kWebp:
      complete = Little32(encoded, 4) + 8 <= encoded.size();
      break;
    case ImageKind::kTiff:
    case ImageKind::kPnm:
    case ImageKind::kUnknown:
      break;
  }
  return complete ? absl::OkStatus() : Truncated(encoded);
}

}  // namespace orbweave
