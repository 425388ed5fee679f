// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/reconstruction_codec.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(partition_review) {
  orbweave::CheckRoundTrip(orbweave::BytesOf(data, size),
                           orbweave::DecodePartitionReview,
                           orbweave::EncodePartitionReview);
}
