// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include "cli/results/fetch_results.h"
#include "core/io/colmap/colmap_model_writer.h"
#include "core/io/points/write_ply.h"

namespace orbweave {

/// Writes the models of a job while they pass by: sparse/0, sparse/1, ... for COLMAP, and the
/// points of the first as points.ply. Loose images, which nothing but a position places, are not in
/// them.
class ModelWriter final : public ModelListener {
 public:
  /// `feature_names` as of FetchFeatureNames; `coordinator` outlives the object.
  ModelWriter(BlobAccess& coordinator,
              std::vector<Digest> feature_names,
              std::filesystem::path folder);

  void BeginModel(const std::map<ImageId, RegisteredImage>& images,
                  const ImageManifest& manifest) override;
  void TakePoint(const Track& track) override;
  [[nodiscard]] absl::Status EndModel() override;

  /// Removes what an earlier run with more models left; a job without a model has no points.
  [[nodiscard]] absl::Status Finish();

 private:
  [[nodiscard]] absl::Status AddImages();

  BlobAccess& coordinator_;
  std::vector<Digest> feature_names_;
  std::filesystem::path folder_;
  absl::Status status_;  ///< of the folders
  size_t num_models_ = 0;
  std::map<ImageId, RegisteredImage> images_;  ///< of the model that passes by, none loose
  std::unique_ptr<ColmapModelWriter> colmap_;  ///< of the model that passes by
  std::unique_ptr<PlyWriter> points_;          ///< while the first does
};

}  // namespace orbweave
