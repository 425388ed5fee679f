// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

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

/// InvalidArgument unless the size is a multiple of the element's.
template <typename T>
absl::StatusOr<std::vector<T>> Unpack(const std::string& bytes, const char* what) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (bytes.size() % sizeof(T) != 0) {
    return absl::InvalidArgumentError(std::string(what) + ": packed array of a wrong size");
  }
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(static_cast<void*>(values.data()), bytes.data(), bytes.size());
  return values;
}

/// The same, and InvalidArgument unless there are `count`.
template <typename T>
absl::StatusOr<std::vector<T>> UnpackExactly(const std::string& bytes,
                                             size_t count,
                                             const char* what) {
  ORBWEAVE_ASSIGN_OR_RETURN(std::vector<T> values, Unpack<T>(bytes, what));
  if (values.size() != count) {
    return absl::InvalidArgumentError(std::string(what) + ": array does not match its neighbours");
  }
  return values;
}

std::string PackDigest(const Digest& digest);  ///< empty for the zero digest
absl::StatusOr<Digest> UnpackDigest(const std::string& bytes);

void ToProto(const Rigid3& value, v1::Rigid3* proto);
/// InvalidArgument unless finite and of unit quaternion norm (1e-6).
absl::StatusOr<Rigid3> FromProto(const v1::Rigid3& proto);

void ToProto(const Sim3& value, v1::Sim3* proto);
absl::StatusOr<Sim3> FromProto(const v1::Sim3& proto);

/// Parses `bytes` as a message, which has less than 2 GiB; DataLoss names `what`.
template <typename Message>
absl::StatusOr<Message> Parse(std::string_view bytes, const char* what) {
  Message message;
  if (!std::in_range<int>(bytes.size()) ||
      !message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return absl::DataLossError(std::string(what) + ": not a valid artifact");
  }
  return message;
}

}  // namespace orbweave::codec
