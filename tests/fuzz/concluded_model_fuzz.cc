// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/adjustment_codec.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(concluded_model) {
  orbweave::CheckRoundTrip(orbweave::BytesOf(data, size),
                           orbweave::DecodeFinalisedModel,
                           orbweave::EncodeFinalisedModel);
}
