// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/status.h"
#include "core/scene/pair_candidates.h"

namespace orbweave {

[[nodiscard]] absl::StatusOr<std::string> EncodePairCandidates(const PairCandidates& candidates);
/// DataLoss: a list of pairs is not in order.
[[nodiscard]] absl::StatusOr<PairCandidates> DecodePairCandidates(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeMatchedPairs(const std::vector<MatchedPair>& pairs);
/// DataLoss: pairs are not in order, or what is said of them is nothing that a pair can be.
[[nodiscard]] absl::StatusOr<std::vector<MatchedPair>> DecodeMatchedPairs(std::string_view bytes);

[[nodiscard]] absl::StatusOr<std::string> EncodeWiderPairs(const WiderPairs& wider);
/// DataLoss: a list of pairs is not in order.
[[nodiscard]] absl::StatusOr<WiderPairs> DecodeWiderPairs(std::string_view bytes);

}  // namespace orbweave
