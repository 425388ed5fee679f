// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/byte_stream.h"
#include "proto/codec/coordinator_codec.h"
#include "proto/codec/grants_codec.h"
#include "tests/fuzz/seeds.h"

namespace orbweave {

void AddMessageSeeds(Seeds& seeds) {
  const auto add = [&seeds](const std::string& target, const auto& value) {
    seeds[target].push_back(ToProto(value).SerializeAsString());
  };
  const Digest digest = DigestOf("blob");
  const JobSpec job{"sparse", {digest}, "align.x=1\n", "street"};
  const TaskCost cost{1.5, 2.5, uint64_t{1} << 40, 7, uint64_t{1} << 33};
  const LeaseProgress held{digest, 5, {1, 2, "images"}};
  add("job_spec", job);
  add("job_status",
      JobStatus{.id = digest,
                .state = JobState::kFailed,
                .error = "why",
                .spec = job,
                .stages = {{"align", 9, 8, 7, 1, 2, 3.5, 4.5, 0.25}}});
  add("task_outcome",
      TaskOutcome{.stage = "align",
                  .part = 1,
                  .id = digest,
                  .result = {{digest}, {digest, digest}, R"({"problem":""})", cost}});
  add("task_timing", TaskTiming{2, "align", 4, "w", 1, 0.5, 0.75, false});
  add("measured_task", MeasuredTask{3, "align", 4, cost});
  add("join_request", WorkerInfo{"node7/a", "0.1.0", 2, {held}});
  add("join_reply", JoinReply{7, 30.0, 5.0});
  add("lease", Lease{digest, uint64_t{1} << 33, {"stage", "1", {digest}, "o.p=1\n", 4}, 3});
  add("heartbeat_reply", HeartbeatReply{{digest}, true});
  add("blob_question", BlobQuestion{{{digest, uint64_t{1} << 33}}, GrantVerb::kPut});
  add("blob_question",
      BlobQuestion{{{digest, uint64_t{1} << 33, {"upload", 3, digest, 1 << 26}}},
                   GrantVerb::kPutPart});
  add("upload_end", UploadEnd{digest, "upload", {"\"tag\"", "other"}});
  add("blob_grants",
      std::vector<BlobGrant>{{BlobGrant::Where::kObject, {"https://store/key?a=b", {"x: y"}}},
                             {BlobGrant::Where::kNowhere},
                             {BlobGrant::Where::kParts, {}, "upload", 1 << 26}});
  seeds["message_channel"] = {ByteWriter()
                                  .Put(uint64_t{5})
                                  .Put(uint64_t{3})
                                  .Put(uint64_t{0})
                                  .PutText("helloabc")
                                  .Put(uint64_t{1})
                                  .Put(uint64_t{0})
                                  .Put(uint64_t{0})
                                  .PutText("x")
                                  .Take()};
}

}  // namespace orbweave
