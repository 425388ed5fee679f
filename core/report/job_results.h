// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/artifacts/stage_results.h"
#include "core/io/page/measure_reconstruction.h"
#include "core/mapping/cluster_reconstruction.h"
#include "core/merging/alignment/alignment.h"
#include "core/merging/alignment/review_seams.h"
#include "core/merging/checks/certify_seams.h"
#include "core/merging/checks/find_hinges.h"
#include "core/partitioned_ba/global_options.h"
#include "core/scene/carrier.h"
#include "core/scene/image_manifest.h"
#include "core/scene/pair_candidates.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// A cluster's reconstruction without its points.
struct ClusterSummary {
  struct Submodel {
    uint32_t images = 0;
    uint64_t points = 0;
  };
  uint32_t cluster = 0;
  std::vector<Submodel> submodels{};
  std::vector<NotRegistered> not_registered{};
  std::vector<ImagePair> contradicted_pairs{};
  std::vector<ImagePair> explained_pairs{};
  std::vector<CrossingPair> parted_pairs{};
  std::vector<PairLength> pair_lengths{};
  std::vector<GapLength> gap_lengths{};
  double residual_rms_px = 0.0;
};

/// A model without its points.
struct AdjustedModel {
  std::map<ImageId, RegisteredImage> images{};
  GlobalAdjustReport report{};
  ReconstructionMeasures measures{};
  std::vector<HingedPiece> hinged_pieces{};
};

/// The results of a finished job, decoded: what grows with images, but not what grows with points.
struct JobResults {
  ImageManifest manifest{};
  std::vector<std::string>
      image_problems{};  ///< per image: why it has no features, mostly empty; or empty list
  std::vector<Carrier> carriers{};          ///< whose features were not matched
  std::optional<WiderPairs> wider_pairs{};  ///< absent: matches were given
  DividedViewGraph view_graph{};
  std::vector<ClusterSummary> clusters{};
  Alignment alignment{};
  PartitionReview review{};
  std::vector<AdjustedModel> models{};          ///< most images first
  std::vector<SeamCertificate> certificates{};  ///< of all models
  std::vector<Exclusion> left_out{};            ///< images of models of which none is left, and why
};

}  // namespace orbweave
