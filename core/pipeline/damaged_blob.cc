// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/damaged_blob.h"

#include <algorithm>
#include <string>

#include "absl/strings/cord.h"

namespace orbweave {
namespace {

constexpr char kPayload[] = "orbweave/damaged-blob";

}  // namespace

absl::Status BlameBlob(absl::Status error, const Digest& blob) {
  if (!absl::IsDataLoss(error) || error.GetPayload(kPayload)) return error;
  error.SetPayload(kPayload, absl::Cord(std::string(blob.bytes.begin(), blob.bytes.end())));
  return error;
}

std::optional<Digest> BlobToBlame(const absl::Status& error) {
  const auto payload = error.GetPayload(kPayload);
  Digest blob;
  if (!payload || payload->size() != blob.bytes.size()) return std::nullopt;
  const std::string bytes(*payload);
  std::copy(bytes.begin(), bytes.end(), blob.bytes.begin());
  return blob;
}

}  // namespace orbweave
