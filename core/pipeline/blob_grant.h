// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/digest.h"

namespace orbweave {

/// A blob of fewer bytes stays with the coordinator.
inline constexpr uint64_t kLeastObjectBytes = uint64_t{64} << 10;
/// What servers of objects take: by one request, and parts of one object.
inline constexpr uint64_t kMostPutBytes = uint64_t{5} << 30;
inline constexpr uint64_t kMostParts = 10'000;

/// How objects are stored.
struct ObjectLimits {
  uint64_t put_bytes = kMostPutBytes;        ///< at most by one request; larger ones in parts
  uint64_t part_bytes = uint64_t{64} << 20;  ///< of a part at least, but for the last

  /// Of the parts of an object of `size_bytes`, but for the last: a multiple of part_bytes, so that
  /// there are kMostParts at most.
  [[nodiscard]] uint64_t PartBytesOf(uint64_t size_bytes) const {
    const uint64_t most = part_bytes * kMostParts;
    return part_bytes * ((size_bytes + most - 1) / most);
  }
};

/// One part of an object that is stored in parts.
struct ObjectPart {
  std::string upload{};  ///< the server's name for the whole that is coming
  uint32_t number = 1;   ///< from 1
  Digest digest{};
  uint64_t size_bytes = 0;
};
/// Blobs of one question for grants.
inline constexpr size_t kMostGrants = 256;

/// The right to read or write one object for a while, for who has no keys. Who has it can use it:
/// its URL goes into no log.
struct ObjectGrant {
  std::string url{};
  std::vector<std::string> headers{};  ///< "name: value", to be sent as they are
};

enum class GrantVerb { kGet = 0, kPut = 1, kPutPart = 2 };

/// A blob that somebody wants to read or write.
struct WantedBlob {
  Digest digest{};
  uint64_t size_bytes = 0;  ///< to be written
  ObjectPart part{};        ///< with kPutPart: which of it
};

/// Where it is to be read or written.
struct BlobGrant {
  enum class Where {
    kCoordinator = 0,  ///< the coordinator gives or takes it
    kNowhere = 1,      ///< it is stored already: nothing is to be done
    kObject = 2,       ///< in an object store, by `object`
    kParts = 3,        ///< there in parts of `part_bytes`, each by a right of its own (kPutPart)
  };
  Where where = Where::kCoordinator;
  ObjectGrant object{};
  std::string upload{};     ///< of kParts, to be ended by FinishUpload
  uint64_t part_bytes = 0;  ///< of kParts; the last part is what is left
};

/// The end of an upload in parts.
struct UploadEnd {
  Digest digest{};
  std::string upload{};
  std::vector<std::string> etags{};  ///< what the server said to each part; none: it is called off
};

}  // namespace orbweave
