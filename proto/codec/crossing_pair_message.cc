// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/crossing_pair_message.h"

#include "proto/codec/pack.h"

namespace orbweave::codec {
namespace {

constexpr double kLongestDirection = 1.0 + 1e-6;  // zero where there is none

}  // namespace

void ToProto(const std::vector<CrossingPair>& pairs, CrossingPairMessages* proto) {
  for (const CrossingPair& pair : pairs) {
    v1::CrossingPair* out = proto->Add();
    out->set_a(pair.pair.a.value);
    out->set_b(pair.pair.b.value);
    ToProto(pair.b_from_a, out->mutable_b_from_a());
  }
}

absl::StatusOr<std::vector<CrossingPair>> FromProto(const CrossingPairMessages& proto) {
  std::vector<CrossingPair> pairs;
  for (const v1::CrossingPair& in : proto) {
    CrossingPair pair{.pair = {ImageId(in.a()), ImageId(in.b())}};
    ORBWEAVE_ASSIGN_OR_RETURN(pair.b_from_a, FromProto(in.b_from_a()));
    if (!(pair.pair.a < pair.pair.b) || !(pair.b_from_a.translation.norm() <= kLongestDirection))
      return absl::DataLossError("a crossing pair is out of order, or leads nowhere");
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace orbweave::codec
