// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/digest.h"

namespace orbweave {

/// A blob of fewer bytes stays with the coordinator, one of more than the most too (an object is
/// stored by one request).
inline constexpr uint64_t kLeastObjectBytes = uint64_t{64} << 10;
inline constexpr uint64_t kMostObjectBytes = uint64_t{5} << 30;
/// Blobs of one question for grants.
inline constexpr size_t kMostGrants = 256;

/// The right to read or write one object for a while, for who has no keys. Who has it can use it:
/// its URL goes into no log.
struct ObjectGrant {
  std::string url{};
  std::vector<std::string> headers{};  ///< "name: value", to be sent as they are
};

enum class GrantVerb { kGet = 0, kPut = 1 };

/// A blob that somebody wants to read or write.
struct WantedBlob {
  Digest digest{};
  uint64_t size_bytes = 0;  ///< to be written
};

/// Where it is to be read or written.
struct BlobGrant {
  enum class Where {
    kCoordinator = 0,  ///< the coordinator gives or takes it
    kNowhere = 1,      ///< it is stored already: nothing is to be done
    kObject = 2,       ///< in an object store, by `object`
  };
  Where where = Where::kCoordinator;
  ObjectGrant object{};
};

}  // namespace orbweave
