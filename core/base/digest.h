// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace orbweave {

/// SHA-256 of some bytes: the name of a blob, a task or a seed. Two things with the same digest
/// are the same thing.
struct Digest {
  std::array<uint8_t, 32> bytes{};

  friend auto operator<=>(const Digest&, const Digest&) = default;

  [[nodiscard]] bool IsZero() const { return *this == Digest{}; }
  /// 64 lower-case hexadecimal digits.
  [[nodiscard]] std::string ToHex() const;
  /// The first 12 of them, for people.
  [[nodiscard]] std::string ToShortHex() const;
  /// InvalidArgument unless `hex` is 64 hexadecimal digits.
  [[nodiscard]] static absl::StatusOr<Digest> FromHex(std::string_view hex);
  /// The first 8 bytes as a number: a seed derived from content.
  [[nodiscard]] uint64_t ToSeed() const;
};

[[nodiscard]] Digest DigestOf(std::string_view bytes);

/// Feeds bytes piece by piece; `AddField` also feeds the length, so that ("ab","c") and
/// ("a","bc") differ.
class DigestBuilder {
 public:
  DigestBuilder();
  ~DigestBuilder();
  DigestBuilder(const DigestBuilder&) = delete;
  DigestBuilder& operator=(const DigestBuilder&) = delete;

  DigestBuilder& Add(std::string_view bytes);
  DigestBuilder& AddField(std::string_view bytes);
  [[nodiscard]] Digest Finish();

 private:
  void* context_;  // EVP_MD_CTX
};

/// Digest of a file's content. NotFound / Unavailable name the file.
[[nodiscard]] absl::StatusOr<Digest> DigestOfFile(const std::string& path);

}  // namespace orbweave

template <>
struct std::hash<orbweave::Digest> {
  size_t operator()(const orbweave::Digest& d) const noexcept {
    return static_cast<size_t>(d.ToSeed());
  }
};
