// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/stage_context.h"
#include "core/base/status.h"
#include "core/pipeline/blob_access.h"
#include "core/pipeline/damaged_blob.h"
#include "core/pipeline/task.h"
#include "stages/port.h"
#include "stages/stage_facts.h"

namespace orbweave {

/// The value of the bytes of a blob. Errors of the codec; DataLoss names the blob (BlobToBlame).
template <typename T>
absl::StatusOr<T> DecodeBlob(const Digest& digest, const std::string& bytes) {
  absl::StatusOr<T> value = Codec<T>::Decode(bytes);
  if (!value.ok()) return BlameBlob(value.status(), digest);
  return value;
}

/// The value of a blob that is named in another one. Errors of `blobs` and of DecodeBlob.
template <typename T>
absl::StatusOr<T> FetchBlob(const Digest& digest, BlobAccess& blobs) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, blobs.Get(digest));
  return DecodeBlob<T>(digest, bytes);
}

template <typename T>
absl::StatusOr<Digest> PutBlob(const T& value, BlobAccess& blobs) {
  const absl::StatusOr<std::string> bytes = Codec<T>::Encode(value);
  ORBWEAVE_RETURN_IF_ERROR(bytes.status());
  return blobs.Put(*bytes);
}

/// One task of a stage, as the stage sees it: what comes in by its ports, what it leaves by them,
/// the options it declares, and the context.
template <typename Stage>
class StageTask {
 public:
  using Outputs = typename Stage::Outputs;

  StageTask(const TaskSpec& spec,
            BlobAccess& blobs,
            const StageContext& context,
            typename Stage::Options options)
      : spec_(spec), blobs_(blobs), context_(context), options_(std::move(options)) {
    Outputs::VisitPorts([&]<typename Port>(std::string_view name, Port Outputs::*) {
      if constexpr (!internal::kIsParts<Port>) named_.emplace_back(name, std::nullopt);
    });
  }

  [[nodiscard]] const StageContext& context() const { return context_; }
  [[nodiscard]] BlobAccess& blobs() { return blobs_; }
  [[nodiscard]] const std::string& options_text() const { return spec_.options_text; }

  /// Options of a section that the stage declares.
  template <typename Section>
  [[nodiscard]] const Section& options() const {
    return options_.template Get<Section>();
  }

  /// Errors of these: those of the blobs, and of the codec when bytes are not what they should be.
  template <typename T>
  [[nodiscard]] absl::StatusOr<T> Read(One<T> Stage::*port) {
    return FetchBlob<T>(DigestOf(port), blobs_);
  }
  /// The recipe of this part.
  template <typename T>
  [[nodiscard]] absl::StatusOr<T> Read(Parts<T> Stage::*port) {
    return FetchBlob<T>(DigestOf(port), blobs_);
  }
  template <typename T>
  [[nodiscard]] absl::StatusOr<T> Read(RoundBefore<One<T>> Stage::*port) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, blobs_.Get(DigestOf(port)));
    if (bytes.empty()) return T{};
    return DecodeBlob<T>(DigestOf(port), bytes);
  }
  template <typename T>
  [[nodiscard]] absl::StatusOr<std::vector<Digest>> Read(EachPart<T> Stage::*port) {
    return ReadList(DigestOf(port));
  }
  template <typename T>
  [[nodiscard]] absl::StatusOr<std::vector<Digest>> Read(RoundBefore<EachPart<T>> Stage::*port) {
    return ReadList(DigestOf(port));
  }
  template <typename A, typename B>
  [[nodiscard]] absl::StatusOr<InterleavedDigests> Read(Interleaved<A, B> Stage::*port) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> digests, ReadList(DigestOf(port)));
    return SplitInterleaved(digests);
  }
  /// Everything that comes in by a port of all parts, one blob at a time.
  template <typename T>
  [[nodiscard]] absl::StatusOr<std::vector<T>> ReadAll(EachPart<T> Stage::*port) {
    return FetchAll<T>(DigestOf(port));
  }
  template <typename T>
  [[nodiscard]] absl::StatusOr<std::vector<T>> ReadAll(RoundBefore<EachPart<T>> Stage::*port) {
    return FetchAll<T>(DigestOf(port));
  }

  /// The name of what comes in by a port: equal names are equal bytes.
  template <typename Port>
  [[nodiscard]] Digest DigestOf(Port Stage::*port) const {
    return spec_.inputs[IndexOf(port, true)];
  }

  /// What a blob that is named in an input holds.
  template <typename T>
  [[nodiscard]] absl::StatusOr<T> Fetch(const Digest& digest) {
    return FetchBlob<T>(digest, blobs_);
  }

  /// Stores what this task leaves by a port; its digest.
  template <typename T>
  absl::StatusOr<Digest> Leave(One<T> Outputs::*port, const T& value) {
    return LeaveAt(IndexOf(port, false), value);
  }
  template <typename T>
  absl::StatusOr<Digest> Leave(EachPart<T> Outputs::*port, const T& value) {
    return LeaveAt(IndexOf(port, false), value);
  }
  /// One more recipe, in the order of parts.
  template <typename T>
  absl::Status Leave(Parts<T> Outputs::*, const T& recipe) {
    ORBWEAVE_ASSIGN_OR_RETURN(result_.recipes.emplace_back(), PutBlob(recipe, blobs_));
    return absl::OkStatus();
  }
  template <typename T>
  absl::Status LeaveAll(Parts<T> Outputs::*port, const std::vector<T>& recipes) {
    for (const T& recipe : recipes) ORBWEAVE_RETURN_IF_ERROR(Leave(port, recipe));
    return absl::OkStatus();
  }
  /// Stores a blob that an output names by the digest that is returned.
  template <typename T>
  absl::StatusOr<Digest> LeaveBulk(const T& value) {
    ORBWEAVE_ASSIGN_OR_RETURN(bulk_.emplace_back(), PutBlob(value, blobs_));
    return bulk_.back();
  }
  /// Counts and reasons, a JSON object.
  void Report(std::string json) { result_.report_json = std::move(json); }

  /// What it left: outputs in the order of their ports, then bulk. Internal: nothing by one of
  /// them.
  [[nodiscard]] absl::StatusOr<TaskResult> Finish() && {
    for (const auto& [name, digest] : named_) {
      if (!digest)
        return absl::InternalError(absl::StrCat(spec_.stage, " left no ", std::string(name)));
      result_.outputs.push_back(*digest);
    }
    result_.outputs.insert(result_.outputs.end(), bulk_.begin(), bulk_.end());
    return std::move(result_);
  }

 private:
  absl::StatusOr<std::vector<Digest>> ReadList(const Digest& digest) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, blobs_.Get(digest));
    return DecodeCollection(bytes);
  }
  template <typename T>
  absl::StatusOr<std::vector<T>> FetchAll(const Digest& list) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> digests, ReadList(list));
    std::vector<T> values;
    for (const Digest& digest : digests) {
      ORBWEAVE_ASSIGN_OR_RETURN(values.emplace_back(), FetchBlob<T>(digest, blobs_));
    }
    return values;
  }
  template <typename T>
  absl::StatusOr<Digest> LeaveAt(uint32_t index, const T& value) {
    ORBWEAVE_ASSIGN_OR_RETURN(named_[index].second, PutBlob(value, blobs_));
    return *named_[index].second;
  }

  const TaskSpec& spec_;
  BlobAccess& blobs_;
  const StageContext& context_;
  typename Stage::Options options_;
  std::vector<std::pair<std::string_view, std::optional<Digest>>> named_{};
  std::vector<Digest> bulk_{};
  TaskResult result_{.report_json = "{}"};
};

/// Runs one task by `body(StageTask<Stage>&)`. InvalidArgument: the task is one of another stage or
/// version, has other inputs, or options that the stage does not declare.
template <typename Stage, typename Body>
absl::StatusOr<TaskResult> RunTaskOf(const TaskSpec& spec,
                                     BlobAccess& blobs,
                                     const StageContext& context,
                                     const Body& body) {
  const StageFacts& facts = Stage::kFacts;
  if (spec.stage != facts.name || spec.version != facts.version) {
    return absl::InvalidArgumentError(absl::StrCat("a task of stage ",
                                                   spec.stage,
                                                   " version ",
                                                   spec.version,
                                                   " for stage ",
                                                   std::string(facts.name),
                                                   " version ",
                                                   std::string(facts.version)));
  }
  const size_t num_inputs = PortsOf<Stage>().size();
  if (spec.inputs.size() != num_inputs) {
    return absl::InvalidArgumentError(
        absl::StrCat(spec.stage, " reads ", num_inputs, " inputs, not ", spec.inputs.size()));
  }
  ORBWEAVE_ASSIGN_OR_RETURN(auto options, Stage::Options::FromText(spec.options_text, spec.stage));
  StageTask<Stage> task(spec, blobs, context, std::move(options));
  ORBWEAVE_RETURN_IF_ERROR(body(task));
  return std::move(task).Finish();
}

}  // namespace orbweave
