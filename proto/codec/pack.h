// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/digest.h"
#include "core/base/status.h"
#include "core/geometry/rigid3.h"
#include "core/geometry/sim3.h"
#include "core/scene/ids.h"
#include "orbweave/v1/artifacts.pb.h"

/// Packed arrays and small values shared by the artifact codecs.

namespace orbweave::codec {

static_assert(std::endian::native == std::endian::little, "packed arrays are little-endian");

template <typename T>
std::string Pack(std::span<const T> values) {
  static_assert(std::is_trivially_copyable_v<T>);
  return std::string(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

template <typename T>
std::string Pack(const std::vector<T>& values) {
  return Pack(std::span<const T>(values));
}

/// DataLoss unless the size is a multiple of the element's.
template <typename T>
absl::StatusOr<std::vector<T>> Unpack(const std::string& bytes, const char* what) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (bytes.size() % sizeof(T) != 0) {
    return absl::DataLossError(std::string(what) + ": packed array of a wrong size");
  }
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(static_cast<void*>(values.data()), bytes.data(), bytes.size());
  return values;
}

/// The same, and DataLoss unless there are `count`.
template <typename T>
absl::StatusOr<std::vector<T>> UnpackExactly(const std::string& bytes,
                                             size_t count,
                                             const char* what) {
  ORBWEAVE_ASSIGN_OR_RETURN(std::vector<T> values, Unpack<T>(bytes, what));
  if (values.size() != count) {
    return absl::DataLossError(std::string(what) + ": array does not match its neighbours");
  }
  return values;
}

std::string PackDigest(const Digest& digest);  ///< empty for the zero digest
absl::StatusOr<Digest> UnpackDigest(const std::string& bytes);

void ToProto(const Eigen::Vector3d& value, v1::Vector3* proto);
Eigen::Vector3d FromProto(const v1::Vector3& proto);

void ToProto(const Rigid3& value, v1::Rigid3* proto);
/// DataLoss unless of unit quaternion norm (1e-6), and not too far (kMostLength).
absl::StatusOr<Rigid3> FromProto(const v1::Rigid3& proto);

void ToProto(const Sim3& value, v1::Sim3* proto);
/// DataLoss unless it is one, of numbers that can be computed with.
absl::StatusOr<Sim3> FromProto(const v1::Sim3& proto);
/// The same of where something lies (IsPlacement).
absl::StatusOr<Sim3> PlacementFromProto(const v1::Sim3& proto);

/// Protobuf refuses to write or read more, and says so with no bytes at all.
inline constexpr size_t kMaxMessageBytes = std::numeric_limits<int>::max();

/// A message without any field has no bytes. For some artifacts that is a value: what a stage left
/// in a loop before the first round (a review, a partition, the progress of an adjustment), and
/// lists that may be empty. For all others no bytes are no artifact.
enum class Empty { kIsRefused, kIsLegal };

/// Parses `bytes` as a message. DataLoss names `what` when they are none, or nothing where nothing
/// is refused.
template <typename Message>
absl::StatusOr<Message> Parse(std::string_view bytes,
                              const char* what,
                              Empty empty = Empty::kIsRefused) {
  Message message;
  if (bytes.size() > kMaxMessageBytes ||
      !message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return absl::DataLossError(std::string(what) + ": not a valid artifact");
  }
  if (empty == Empty::kIsRefused && message.ByteSizeLong() == 0)
    return absl::DataLossError(std::string(what) + ": empty bytes are no artifact");
  return message;
}

/// The bytes of a message. OutOfRange when there are more than `max_bytes`; InvalidArgument when
/// there are none where nothing is refused.
template <typename Message>
absl::StatusOr<std::string> Serialize(const Message& message,
                                      const char* what,
                                      Empty empty = Empty::kIsRefused,
                                      size_t max_bytes = kMaxMessageBytes) {
  const size_t size_bytes = message.ByteSizeLong();
  if (size_bytes > max_bytes) {
    return absl::OutOfRangeError(absl::StrCat(what,
                                              ": ",
                                              size_bytes,
                                              " bytes, but an artifact has at most ",
                                              max_bytes,
                                              "; make clusters smaller (partition.cluster_size)"));
  }
  if (size_bytes == 0 && empty == Empty::kIsRefused)
    return absl::InvalidArgumentError(std::string(what) + ": empty, which is no artifact");
  std::string bytes(size_bytes, '\0');
  message.SerializeWithCachedSizesToArray(reinterpret_cast<uint8_t*>(bytes.data()));
  return bytes;
}

}  // namespace orbweave::codec
