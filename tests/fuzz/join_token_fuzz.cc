// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/join_token.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(join_token) {
  const std::string_view token = orbweave::BytesOf(data, size);
  (void)orbweave::ReadJoinToken(token);
  // Nobody guesses a key.
  static const std::string key = orbweave::MakeTokenKey();
  ORBWEAVE_CHECK(!orbweave::VerifyJoinToken(key, token, 0).ok());
}
