// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/image_metadata.h"

#include <cmath>
#include <exiv2/exiv2.hpp>
#include <memory>
#include <mutex>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/io/text_fields.h"
#include "core/scene/image_header.h"

namespace orbweave {
namespace {

constexpr int kMaxSidePx = 1 << 20;

/// Rational number `i` of an EXIF value; nullopt when absent, 0/0 or not finite.
std::optional<double> Rational(const Exiv2::ExifData& exif, const char* key, long i = 0) {
  const auto datum = exif.findKey(Exiv2::ExifKey(key));
  if (datum == exif.end() || datum->count() <= i) return std::nullopt;
  const Exiv2::Rational value = datum->toRational(i);
  if (value.second == 0) return std::nullopt;
  return static_cast<double>(value.first) / static_cast<double>(value.second);
}

std::string Text(const Exiv2::ExifData& exif, const char* key) {
  const auto datum = exif.findKey(Exiv2::ExifKey(key));
  return datum == exif.end() ? std::string() : datum->toString();
}

std::optional<double> XmpNumber(const Exiv2::XmpData& xmp, const char* key) {
  const auto datum = xmp.findKey(Exiv2::XmpKey(key));
  if (datum == xmp.end()) return std::nullopt;
  const std::optional<double> value = NumberFromText(datum->toString());
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// Degrees, minutes and seconds with a reference letter ("S" and "W" are negative).
std::optional<double> Degrees(const Exiv2::ExifData& exif,
                              const char* key,
                              const char* reference_key) {
  const std::optional<double> degrees = Rational(exif, key, 0);
  if (!degrees) return std::nullopt;
  const double minutes = Rational(exif, key, 1).value_or(0.0);
  const double seconds = Rational(exif, key, 2).value_or(0.0);
  const double value = *degrees + minutes / 60.0 + seconds / 3600.0;
  const std::string reference = Text(exif, reference_key);
  const bool negative = reference.starts_with('S') || reference.starts_with('W');
  return negative ? -value : value;
}

void ReadPosition(const Exiv2::ExifData& exif, ImageMetadata& metadata) {
  const auto latitude = Degrees(exif, "Exif.GPSInfo.GPSLatitude", "Exif.GPSInfo.GPSLatitudeRef");
  const auto longitude = Degrees(exif, "Exif.GPSInfo.GPSLongitude", "Exif.GPSInfo.GPSLongitudeRef");
  if (!latitude || !longitude || (*latitude == 0.0 && *longitude == 0.0)) return;
  if (std::abs(*latitude) > 90.0 || std::abs(*longitude) > 180.0) {
    metadata.position_problem =
        absl::StrCat("latitude ", *latitude, ", longitude ", *longitude, " is nowhere on Earth");
    return;
  }
  metadata.position = GeodeticPosition{*latitude, *longitude, 0.0};
  if (const auto altitude = Rational(exif, "Exif.GPSInfo.GPSAltitude")) {
    const bool below = Text(exif, "Exif.GPSInfo.GPSAltitudeRef").starts_with('1');
    metadata.position->altitude_m = below ? -*altitude : *altitude;
    metadata.altitude_known = true;
  }
  const auto error_m = Rational(exif, "Exif.GPSInfo.GPSHPositioningError");
  if (error_m && *error_m > 0.0) metadata.position_error_m = error_m;
}

void ReadOrientation(const Exiv2::ExifData& exif,
                     const Exiv2::XmpData& xmp,
                     ImageMetadata& metadata) {
  metadata.heading_deg = XmpNumber(xmp, "Xmp.GPano.PoseHeadingDegrees");
  metadata.pitch_deg = XmpNumber(xmp, "Xmp.GPano.PosePitchDegrees");
  metadata.roll_deg = XmpNumber(xmp, "Xmp.GPano.PoseRollDegrees");
  // A magnetic direction is off by the declination, up to tens of degrees: not taken.
  if (!metadata.heading_deg && !Text(exif, "Exif.GPSInfo.GPSImgDirectionRef").starts_with('M')) {
    metadata.heading_deg = Rational(exif, "Exif.GPSInfo.GPSImgDirection");
  }
}

void ReadTime(const Exiv2::ExifData& exif, ImageMetadata& metadata) {
  std::string text = Text(exif, "Exif.Photo.DateTimeOriginal");
  if (const std::string fraction = Text(exif, "Exif.Photo.SubSecTimeOriginal"); !fraction.empty()) {
    absl::StrAppend(&text, ".", std::string(TrimmedText(fraction)));
  }
  absl::StrAppend(&text, Text(exif, "Exif.Photo.OffsetTimeOriginal"));
  // A plain number is no EXIF time.
  if (!NumberFromText(text)) metadata.capture_time_s = TimeFromText(text);
}

/// EXIF and XMP; the size is not asked for, so that one parser alone says what it is.
absl::Status ReadWithExiv2(std::string_view encoded, ImageMetadata& metadata) {
  // Exiv2's XMP parser and its log level are shared by the process: one reader at a time.
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute);
  try {
    const auto image = Exiv2::ImageFactory::open(
        reinterpret_cast<const Exiv2::byte*>(encoded.data()), static_cast<long>(encoded.size()));
    image->readMetadata();
    ReadPosition(image->exifData(), metadata);
    ReadOrientation(image->exifData(), image->xmpData(), metadata);
    ReadTime(image->exifData(), metadata);
  } catch (const std::exception& error) {
    return absl::InvalidArgumentError(absl::StrCat("cannot read the header: ", error.what()));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<ImageMetadata> ReadImageMetadata(std::string_view encoded) {
  const ImageKind kind = IdentifyImage(encoded);
  if (encoded.empty()) return absl::InvalidArgumentError("the file is empty");
  if (kind == ImageKind::kUnknown)
    return absl::InvalidArgumentError("not an image of a known kind");
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageHeader header, ReadImageHeader(encoded));
  if (header.width_px > kMaxSidePx || header.height_px > kMaxSidePx)
    return absl::InvalidArgumentError("the header gives no dimensions");
  if (!header.complete) {
    return absl::InvalidArgumentError(absl::StrCat(
        "truncated: the data end after ", encoded.size(), " bytes, before the image does"));
  }
  ImageMetadata metadata{.width_px = header.width_px, .height_px = header.height_px};
  if (kind != ImageKind::kPnm) ORBWEAVE_RETURN_IF_ERROR(ReadWithExiv2(encoded, metadata));
  return metadata;
}

}  // namespace orbweave
