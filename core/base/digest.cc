// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/base/digest.h"

#include <openssl/evp.h>

#include <cstring>
#include <fstream>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace orbweave {
namespace {

constexpr char kHexDigits[] = "0123456789abcdef";

int HexValue(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

EVP_MD_CTX* Evp(void* context) { return static_cast<EVP_MD_CTX*>(context); }

}  // namespace

std::string Digest::ToHex() const {
  std::string hex;
  hex.reserve(64);
  for (const uint8_t byte : bytes) {
    hex.push_back(kHexDigits[byte >> 4]);
    hex.push_back(kHexDigits[byte & 15]);
  }
  return hex;
}

std::string Digest::ToShortHex() const { return ToHex().substr(0, 12); }

absl::StatusOr<Digest> Digest::FromHex(std::string_view hex) {
  Digest digest;
  if (hex.size() != 64) return absl::InvalidArgumentError("a digest has 64 hexadecimal digits");
  for (size_t i = 0; i < 32; ++i) {
    const int high = HexValue(hex[2 * i]);
    const int low = HexValue(hex[2 * i + 1]);
    if (high < 0 || low < 0)
      return absl::InvalidArgumentError("a digest has 64 hexadecimal digits");
    digest.bytes[i] = static_cast<uint8_t>(high * 16 + low);
  }
  return digest;
}

uint64_t Digest::ToSeed() const {
  uint64_t seed = 0;
  for (size_t i = 0; i < 8; ++i) seed = (seed << 8) | bytes[i];
  return seed;
}

DigestBuilder::DigestBuilder() : context_(EVP_MD_CTX_new()) {
  ORBWEAVE_CHECK(EVP_DigestInit_ex(Evp(context_), EVP_sha256(), nullptr) == 1);
}

DigestBuilder::~DigestBuilder() { EVP_MD_CTX_free(Evp(context_)); }

DigestBuilder& DigestBuilder::Add(std::string_view bytes) {
  ORBWEAVE_CHECK(EVP_DigestUpdate(Evp(context_), bytes.data(), bytes.size()) == 1);
  return *this;
}

DigestBuilder& DigestBuilder::AddField(std::string_view bytes) {
  std::array<char, 8> length{};
  for (size_t i = 0; i < 8; ++i) length[i] = static_cast<char>((bytes.size() >> (8 * i)) & 0xff);
  Add(std::string_view(length.data(), length.size()));
  return Add(bytes);
}

Digest DigestBuilder::Finish() {
  Digest digest;
  unsigned int size = 0;
  ORBWEAVE_CHECK(EVP_DigestFinal_ex(Evp(context_), digest.bytes.data(), &size) == 1 && size == 32);
  return digest;
}

Digest DigestOf(std::string_view bytes) { return DigestBuilder().Add(bytes).Finish(); }

absl::StatusOr<Digest> DigestOfFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return absl::NotFoundError(absl::StrCat("cannot open ", path));
  DigestBuilder builder;
  std::vector<char> buffer(1 << 20);
  while (file) {
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    builder.Add(std::string_view(buffer.data(), static_cast<size_t>(file.gcount())));
  }
  if (file.bad()) return absl::UnavailableError(absl::StrCat("cannot read ", path));
  return builder.Finish();
}

}  // namespace orbweave
