// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/points/write_las.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/io/byte_stream.h"

namespace orbweave {
namespace {

constexpr double kStepsPerMetre = 2000.0;
constexpr double kStep_m = 0.0005;
constexpr double kNormalSteps = 32767.0;
constexpr size_t kHeaderBytes = 375;

constexpr uint16_t kPointBytes = 36 + 4 + 3 * 2 + 1;

enum class ExtraType : uint8_t { kUint8 = 1, kInt16 = 4, kFloat = 9 };

std::string Padded(std::string_view text, size_t bytes) {
  std::string padded(text.substr(0, bytes));
  padded.resize(bytes, '\0');
  return padded;
}

/// A variable length record.
std::string Record(std::string_view user,
                   uint16_t id,
                   std::string_view description,
                   std::string_view payload) {
  ByteWriter out;
  out.Put<uint16_t>(0).PutText(Padded(user, 16)).Put(id);
  out.Put(static_cast<uint16_t>(payload.size())).PutText(Padded(description, 32)).PutText(payload);
  return out.Take();
}

/// What one extra attribute of the points is; scale 0: none.
std::string ExtraAttribute(std::string_view name,
                           ExtraType type,
                           double scale,
                           std::string_view description) {
  constexpr uint8_t kHasScale = 8;
  ByteWriter out;
  out.Put<uint16_t>(0).Put(static_cast<uint8_t>(type)).Put<uint8_t>(scale > 0.0 ? kHasScale : 0);
  out.PutText(Padded(name, 32)).PutText(Padded("", 4 + 3 * 24));
  out.Put(scale).PutText(Padded("", 16 + 24)).PutText(Padded(description, 32));
  return out.Take();
}

std::string Records(const std::string& wkt) {
  constexpr double kNormalScale = 1.0 / kNormalSteps;
  const std::string attributes =
      absl::StrCat(ExtraAttribute("sigma", ExtraType::kFloat, 0.0, "of the position, metres"),
                   ExtraAttribute("NormalX", ExtraType::kInt16, kNormalScale, "unit normal"),
                   ExtraAttribute("NormalY", ExtraType::kInt16, kNormalScale, "unit normal"),
                   ExtraAttribute("NormalZ", ExtraType::kInt16, kNormalScale, "unit normal"),
                   ExtraAttribute("views", ExtraType::kUint8, 0.0, "images that bear it out"));
  std::string records = Record("LASF_Spec", 4, "extra bytes", attributes);
  if (!wkt.empty()) {
    absl::StrAppend(&records,
                    Record("LASF_Projection", 2112, "WKT", absl::StrCat(wkt, Padded("", 1))));
  }
  return records;
}

void PutPoint(const SurfacePoint& point, const std::array<int32_t, 3>& steps, ByteWriter& out) {
  out.Put(steps[0]).Put(steps[1]).Put(steps[2]);
  out.Put<uint16_t>(0);    // intensity
  out.Put<uint8_t>(0x11);  // return 1 of 1
  out.Put<uint8_t>(0);     // flags, channel, scan direction, edge
  out.Put<uint8_t>(0);     // class: created, never classified
  out.Put<uint8_t>(0);     // user data
  out.Put<int16_t>(0);     // scan angle
  out.Put<uint16_t>(0);    // point source
  out.Put<double>(0.0);    // time
  for (const uint8_t channel : {point.color.r, point.color.g, point.color.b}) {
    out.Put(static_cast<uint16_t>(channel * 256));
  }
  out.Put(point.sigma_m);
  for (const float part : point.normal_in_world) {
    const double clamped = std::clamp(static_cast<double>(part), -1.0, 1.0);
    out.Put(static_cast<int16_t>(std::lround(clamped * kNormalSteps)));
  }
  out.Put(point.views);
}

}  // namespace

LasWriter::LasWriter(std::string path, LasDescription description)
    : path_(path),
      description_(std::move(description)),
      file_(std::move(path)),
      low_(Eigen::Array3d::Constant(std::numeric_limits<double>::infinity())),
      high_(-low_) {
  file_.Append(Head());
  file_.Append(Records(description_.wkt));
}

void LasWriter::Add(std::span<const SurfacePoint> points) {
  ByteWriter out;
  for (const SurfacePoint& point : points) {
    const Eigen::Array3d steps =
        ((point.position_in_world - description_.offset) * kStepsPerMetre).array().round();
    if (!(steps.abs() < 2147483647.0).all()) {  // not-a-number, too
      fits_ = false;
      continue;
    }
    const Eigen::Array3d stored = steps * kStep_m + description_.offset.array();
    low_ = low_.min(stored);
    high_ = high_.max(stored);
    PutPoint(point,
             {static_cast<int32_t>(steps.x()),
              static_cast<int32_t>(steps.y()),
              static_cast<int32_t>(steps.z())},
             out);
    ++num_points_;
  }
  file_.Append(out.Take());
}

std::string LasWriter::Head() const {
  constexpr uint16_t kTextIsWkt = 16;
  const size_t points_at = kHeaderBytes + Records(description_.wkt).size();
  ByteWriter out;
  out.PutText("LASF").Put<uint16_t>(0).Put(kTextIsWkt).PutText(Padded("", 16));
  out.Put<uint8_t>(1).Put<uint8_t>(4).PutText(Padded("EXTRACTION", 32));
  out.PutText(Padded("orbweave", 32));
  out.Put(description_.creation_day_of_year).Put(description_.creation_year);
  out.Put(static_cast<uint16_t>(kHeaderBytes)).Put(static_cast<uint32_t>(points_at));
  out.Put<uint32_t>(description_.wkt.empty() ? 1 : 2).Put<uint8_t>(7).Put(kPointBytes);
  out.PutText(Padded("", 4 + 5 * 4));  // counts of old readers: zero for formats from 6 on
  for (int axis = 0; axis < 3; ++axis) out.Put(kStep_m);
  for (int axis = 0; axis < 3; ++axis) out.Put(description_.offset[axis]);
  for (int axis = 0; axis < 3; ++axis) {
    out.Put(num_points_ == 0 ? 0.0 : high_[axis]).Put(num_points_ == 0 ? 0.0 : low_[axis]);
  }
  out.Put<uint64_t>(0).Put<uint64_t>(0).Put<uint32_t>(0);             // waveforms, extended records
  out.Put(num_points_).Put(num_points_).PutText(Padded("", 14 * 8));  // all are first returns
  return out.Take();
}

absl::Status LasWriter::Finish() {
  if (!fits_ || !description_.offset.allFinite()) {
    return absl::InvalidArgumentError(
        absl::StrCat("cannot write '",
                     path_,
                     "': a position is not finite, or farther than 1,000 km from the offset; "
                     "choose an offset near the points"));
  }
  if (description_.wkt.size() >= 65535) {
    return absl::InvalidArgumentError(
        absl::StrCat("cannot write '", path_, "': the text of its frame is longer than 65,534"));
  }
  return file_.CommitWithHead(Head());
}

}  // namespace orbweave
