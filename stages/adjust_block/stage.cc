// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/adjust_block/stage.h"

#include <unistd.h>

#include <algorithm>
#include <optional>
#include <thread>
#include <utility>

#include "core/artifacts/check_adjustment.h"
#include "core/merging/checks/inspect_subproblem.h"
#include "stages/codecs.h"

namespace orbweave {
namespace {

/// Memory of a process for subproblems between two half-steps: where every core has a worker, a
/// quarter of the machine's for all of them.
size_t KeptBytes() {
  const auto pages = static_cast<size_t>(std::max(0L, sysconf(_SC_PHYS_PAGES)));
  const auto page_bytes = static_cast<size_t>(std::max(0L, sysconf(_SC_PAGESIZE)));
  return pages * page_bytes / 4 / std::max(1U, std::thread::hardware_concurrency());
}

/// The subproblem of a task, from its blobs.
absl::StatusOr<SubproblemSolver> MakeWorker(const SubproblemTask& request,
                                            StageTask<AdjustBlockStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(Subproblem subproblem, task.Fetch<Subproblem>(request.subproblem));
  std::optional<EvaluatedState> state;
  if (!request.state.IsZero()) {
    ORBWEAVE_ASSIGN_OR_RETURN(state, task.Fetch<EvaluatedState>(request.state));
    ORBWEAVE_RETURN_IF_ERROR(BlameBlob(CheckState(subproblem, *state), request.state));
  }
  return SubproblemSolver(
      std::move(subproblem),
      std::move(state),
      SubproblemOptionsOf(task.options<GlobalAdjustOptions>(), task.options<BundleOptions>()),
      task.context().num_threads);
}

/// Stores what the order changed, and names it in `done`.
absl::Status LeaveBulk(const LmRequest& request,
                       SubproblemSolver& worker,
                       SubproblemResult& done,
                       StageTask<AdjustBlockStage>& task) {
  using Work = LmRequest::Work;
  if (request.work == Work::kFilter) {
    ORBWEAVE_ASSIGN_OR_RETURN(done.subproblem, task.LeaveBulk(worker.subproblem()));
  }
  if (request.work == Work::kFilter && !request.evaluates_again) {
    ORBWEAVE_ASSIGN_OR_RETURN(
        done.inspection,
        task.LeaveBulk(InspectSubproblem(worker.subproblem(), task.context().num_threads)));
  }
  const bool begins = request.work == Work::kEvaluate || request.evaluates_again;
  if (begins || request.work == Work::kTrial) {
    ORBWEAVE_ASSIGN_OR_RETURN(done.state, task.LeaveBulk(worker.state()));
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status AdjustBlockStage::Run(StageTask<AdjustBlockStage>& task) {
  static auto* const kCache =
      new SubproblemCache(KeptBytes() / SubproblemCache::kBytesPerObservation);
  return RunWith(*kCache, task);
}

absl::Status AdjustBlockStage::RunWith(SubproblemCache& cache, StageTask<AdjustBlockStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const SubproblemTask request, task.Read(&AdjustBlockStage::request));
  std::optional<SubproblemCache::Ready> ready = cache.Take(request, task.options_text());
  if (!ready) {
    ORBWEAVE_ASSIGN_OR_RETURN(SubproblemSolver worker, MakeWorker(request, task));
    ready = SubproblemCache::Ready{std::move(worker), request.request};
  }
  SubproblemSolver& worker = ready->worker;
  ORBWEAVE_RETURN_IF_ERROR(
      CheckRequest(worker.subproblem(), request.request, !request.state.IsZero()));
  SubproblemResult done{.reply = worker.Execute(ready->request)};
  ORBWEAVE_RETURN_IF_ERROR(LeaveBulk(request.request, worker, done, task));
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::reply, done).status());
  cache.Keep(request, done, task.options_text(), std::move(worker));
  return absl::OkStatus();
}

}  // namespace orbweave
