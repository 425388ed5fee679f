// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "proto/codec/garbage_codec.h"

namespace orbweave {

v1::GarbageRequest ToProto(const GarbageOptions& options) {
  v1::GarbageRequest proto;
  proto.set_unused_s(options.unused_s);
  proto.set_dry_run(options.dry_run);
  return proto;
}

GarbageOptions FromProto(const v1::GarbageRequest& proto) {
  return {.unused_s = proto.unused_s(), .dry_run = proto.dry_run()};
}

v1::GarbageReport ToProto(const GarbageReport& report) {
  v1::GarbageReport proto;
  proto.set_needed_blobs(report.needed_blobs);
  proto.set_needed_bytes(report.needed_bytes);
  proto.set_recent_blobs(report.recent_blobs);
  proto.set_recent_bytes(report.recent_bytes);
  proto.set_removed_blobs(report.removed_blobs);
  proto.set_removed_bytes(report.removed_bytes);
  proto.set_forgotten_results(report.forgotten_results);
  return proto;
}

GarbageReport FromProto(const v1::GarbageReport& proto) {
  return {.needed_blobs = proto.needed_blobs(),
          .needed_bytes = proto.needed_bytes(),
          .recent_blobs = proto.recent_blobs(),
          .recent_bytes = proto.recent_bytes(),
          .removed_blobs = proto.removed_blobs(),
          .removed_bytes = proto.removed_bytes(),
          .forgotten_results = proto.forgotten_results()};
}

}  // namespace orbweave
