// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/artifacts/adjustment_records.h"
#include "core/artifacts/recipes.h"
#include "core/io/images/cluster_table.h"
#include "core/io/images/image_sources.h"
#include "core/pipeline/job_plan.h"
#include "core/scene/features.h"
#include "core/scene/image_manifest.h"
#include "stages/port.h"

/// What jobs of each kind bring. The order of VisitPorts is that of JobSpec::inputs, which follows
/// from the value by JobInputs.

namespace orbweave {

/// A folder of images.
struct SparseJob {
  static constexpr std::string_view kKind = "sparse";
  One<ImageSources> sources;
  One<ClusterNames> clusters_by_hand;  ///< empty: none

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("sources", &SparseJob::sources);
    visit("clusters_by_hand", &SparseJob::clusters_by_hand);
  }
};

/// Keypoints and matches of a database.
struct SparseFromMatchesJob {
  static constexpr std::string_view kKind = "sparse_from_matches";
  One<ImageManifest> manifest;
  Interleaved<Features, PlaceSample> features;  ///< by image
  Parts<MatchRecipe> runs;                      ///< of pairs, with their matches
  One<ClusterNames> clusters_by_hand;           ///< empty: none

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("manifest", &SparseFromMatchesJob::manifest);
    visit("features", &SparseFromMatchesJob::features);
    visit("runs", &SparseFromMatchesJob::runs);
    visit("clusters_by_hand", &SparseFromMatchesJob::clusters_by_hand);
  }
};

/// A finished model, as ConcludeAdjustmentStage leaves it, and the pictures of its images.
struct DenseJob {
  static constexpr std::string_view kKind = "dense";
  One<ImageManifest> manifest;
  One<FinalisedModel> model;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("manifest", &DenseJob::manifest);
    visit("model", &DenseJob::model);
  }
};

/// The inputs of a job, by port.
template <typename Job>
class JobInputs {
 public:
  template <typename Port>
  JobInputs& Set(Port Job::*port, const Digest& digest) {
    digests_[IndexOf(port, true)] = digest;
    return *this;
  }
  /// In the order of ports. CHECK: all are set.
  [[nodiscard]] std::vector<Digest> InOrder() const {
    for (const Digest& digest : digests_) ORBWEAVE_CHECK(!digest.IsZero());
    return digests_;
  }

 private:
  std::vector<Digest> digests_ = std::vector<Digest>(PortsOf<Job>().size());
};

/// The plan of a kind of job. NotFound: there is no such kind.
[[nodiscard]] absl::StatusOr<JobPlan> FindJobPlan(std::string_view kind);

/// All kinds.
[[nodiscard]] std::vector<std::string> JobKinds();

}  // namespace orbweave
