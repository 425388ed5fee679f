// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/images/image_metadata.h"

#include <cctype>
#include <cmath>
#include <exiv2/exiv2.hpp>
#include <memory>
#include <mutex>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/io/plausible.h"
#include "core/io/printable_text.h"
#include "core/io/text_fields.h"
#include "core/pictures/image_header.h"

namespace orbweave {
namespace {

constexpr int kMaxSidePx = 1 << 20;

/// Rational number `i` of an EXIF value, signed or unsigned as its type says; nullopt when absent,
/// of another type or 0/0, which stands for "unknown"; infinite when it is any other number over
/// zero.
std::optional<double> Rational(const Exiv2::ExifData& exif, const char* key, size_t i = 0) {
  const auto datum = exif.findKey(Exiv2::ExifKey(key));
  if (datum == exif.end()) return std::nullopt;
  const auto quotient = [i](const auto* rationals) -> std::optional<double> {
    if (rationals == nullptr || i >= rationals->value_.size()) return std::nullopt;
    const auto [numerator, denominator] = rationals->value_[i];
    if (numerator == 0 && denominator == 0) return std::nullopt;
    return static_cast<double>(numerator) / static_cast<double>(denominator);
  };
  const Exiv2::Value& value = datum->value();
  const auto number = quotient(dynamic_cast<const Exiv2::URationalValue*>(&value));
  return number ? number : quotient(dynamic_cast<const Exiv2::RationalValue*>(&value));
}

std::string Text(const Exiv2::ExifData& exif, const char* key) {
  const auto datum = exif.findKey(Exiv2::ExifKey(key));
  return datum == exif.end() ? std::string() : datum->toString();
}

/// NaN where something else than a number is written there.
std::optional<double> XmpNumber(const Exiv2::XmpData& xmp, const char* key) {
  const auto datum = xmp.findKey(Exiv2::XmpKey(key));
  if (datum == xmp.end() || TrimmedText(datum->toString()).empty()) return std::nullopt;
  return NumberFromText(datum->toString()).value_or(NAN);
}

/// Degrees, minutes and seconds of a latitude or longitude, and the letter of its hemisphere.
struct WrittenAngle {
  const char* name = "";
  double parts[3] = {};
  std::string reference{};
  double sign = 1.0;  ///< of the letter

  [[nodiscard]] double Degrees() const {
    return sign * (parts[0] + parts[1] / 60.0 + parts[2] / 3600.0);
  }
};

std::optional<WrittenAngle> ReadAngle(const Exiv2::ExifData& exif,
                                      const char* name,
                                      const char* key,
                                      char negative) {
  WrittenAngle angle{.name = name};
  const std::optional<double> degrees = Rational(exif, key, 0);
  if (!degrees) return std::nullopt;
  angle.parts[0] = *degrees;
  for (size_t i = 1; i < 3; ++i) angle.parts[i] = Rational(exif, key, i).value_or(0.0);
  angle.reference = TrimmedText(Text(exif, absl::StrCat(key, "Ref").c_str()));
  for (char& c : angle.reference) c = static_cast<char>(std::toupper(static_cast<uint8_t>(c)));
  if (angle.reference == std::string(1, negative)) angle.sign = -1.0;
  return angle;
}

/// What is wrong with it apart from its size; empty when nothing is. 60 seconds come of rounding.
std::string ProblemOf(const WrittenAngle& angle, std::string_view letters) {
  if (angle.reference.size() != 1 || letters.find(angle.reference[0]) == letters.npos) {
    return absl::StrCat("the reference of its ",
                        angle.name,
                        " is '",
                        Utf8Text(angle.reference.substr(0, 8)),
                        "', neither ",
                        std::string(1, letters[0]),
                        " nor ",
                        std::string(1, letters[1]));
  }
  for (const double part : angle.parts) {
    if (!std::isfinite(part)) return absl::StrCat("its ", angle.name, " has a number over zero");
    if (part < 0.0) return absl::StrCat("its ", angle.name, " has a part below zero");
  }
  for (const double part : {angle.parts[1], angle.parts[2]}) {
    if (part > 60.0) return absl::StrCat("its ", angle.name, " has ", part, " minutes or seconds");
  }
  return "";
}

void ReadAltitude(const Exiv2::ExifData& exif, ImageMetadata& metadata) {
  const std::optional<double> altitude = Rational(exif, "Exif.GPSInfo.GPSAltitude");
  if (!altitude) return;
  if (!IsPlausibleHeight(*altitude)) {
    metadata.left_out["EXIF altitude"] = absl::StrCat(*altitude, " m");
    return;
  }
  // 0 and 1: above and below the sea; 2 and 3 (EXIF 3.0): above and below the ellipsoid.
  const std::string reference = Text(exif, "Exif.GPSInfo.GPSAltitudeRef");
  const bool below = reference.starts_with('1') || reference.starts_with('3');
  metadata.position->altitude_m = below ? -*altitude : *altitude;
  metadata.altitude_known = true;
  metadata.altitude_of_ellipsoid = reference.starts_with('2') || reference.starts_with('3');
}

void ReadPosition(const Exiv2::ExifData& exif, ImageMetadata& metadata) {
  const auto latitude = ReadAngle(exif, "latitude", "Exif.GPSInfo.GPSLatitude", 'S');
  const auto longitude = ReadAngle(exif, "longitude", "Exif.GPSInfo.GPSLongitude", 'W');
  if (!latitude || !longitude) return;
  const double latitude_deg = latitude->Degrees();
  const double longitude_deg = longitude->Degrees();
  if (latitude_deg == 0.0 && longitude_deg == 0.0) return;
  std::string& problem = metadata.position_problem;
  const bool is_finite = std::isfinite(latitude_deg) && std::isfinite(longitude_deg);
  if (is_finite && (std::abs(latitude_deg) > 90.0 || std::abs(longitude_deg) > 180.0)) {
    problem = absl::StrCat(
        "latitude ", latitude_deg, ", longitude ", longitude_deg, " is nowhere on Earth");
  }
  if (problem.empty()) problem = ProblemOf(*latitude, "NS");
  if (problem.empty()) problem = ProblemOf(*longitude, "EW");
  if (!problem.empty()) return;
  const auto error_m = Rational(exif, "Exif.GPSInfo.GPSHPositioningError");
  if (error_m && std::isfinite(*error_m) && *error_m > kLargestSigma_m) {
    problem = absl::StrCat("it is good to ", *error_m / 1000.0, " km");
    return;
  }
  metadata.position = GeodeticPosition{latitude_deg, longitude_deg, 0.0};
  ReadAltitude(exif, metadata);
  if (error_m && IsPlausibleSigma(*error_m)) metadata.position_error_m = error_m;
}

void ReadOrientation(const Exiv2::ExifData& exif,
                     const Exiv2::XmpData& xmp,
                     ImageMetadata& metadata) {
  metadata.heading_deg = XmpNumber(xmp, "Xmp.GPano.PoseHeadingDegrees");
  metadata.pitch_deg = XmpNumber(xmp, "Xmp.GPano.PosePitchDegrees");
  metadata.roll_deg = XmpNumber(xmp, "Xmp.GPano.PoseRollDegrees");
  const auto direction_deg = Rational(exif, "Exif.GPSInfo.GPSImgDirection");
  if (!metadata.heading_deg && direction_deg) {
    // A magnetic direction is off by the declination, up to tens of degrees: not taken.
    if (Text(exif, "Exif.GPSInfo.GPSImgDirectionRef").starts_with('M')) {
      metadata.left_out["magnetic heading"] = absl::StrCat(*direction_deg);
    } else {
      metadata.heading_deg = direction_deg;
    }
  }
  const auto keep = [&](const char* name, std::optional<double>& angle_deg, auto is_plausible) {
    if (!angle_deg || is_plausible(*angle_deg)) return;
    metadata.left_out[name] = absl::StrCat(*angle_deg);
    angle_deg.reset();
  };
  keep("heading", metadata.heading_deg, IsPlausibleHeading);
  keep("pitch", metadata.pitch_deg, IsPlausiblePitch);
  keep("roll", metadata.roll_deg, IsPlausibleRoll);
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
