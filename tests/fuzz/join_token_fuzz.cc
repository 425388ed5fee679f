// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/join_token.h"
#include "tests/fuzz/round_trip.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view token = orbweave::BytesOf(data, size);
  (void)orbweave::ReadJoinToken(token);
  // Nobody guesses a key.
  static const std::string key = orbweave::MakeTokenKey();
  ORBWEAVE_CHECK(!orbweave::VerifyJoinToken(key, token, 0).ok());
  return 0;
}
