// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/listen_address.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/round_trip.h"

FUZZ_TARGET(listen_address) {
  const std::string address(orbweave::BytesOf(data, size));
  const bool plain = orbweave::CheckListenAddress(address, orbweave::Wire::kPlain).ok();
  const bool encrypted = orbweave::CheckListenAddress(address, orbweave::Wire::kEncrypted).ok();
  // Sockets are plain only, loopback addresses both, all others encrypted only.
  if (plain && !encrypted) ORBWEAVE_CHECK(address.starts_with("unix:"));
}
