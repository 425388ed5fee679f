// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/results/fetch_results.h"
#include "coordinator/coordinator.h"
#include "core/drawing/picture_image.h"
#include "core/features/hide_carrier.h"
#include "stages/pipeline_options.h"

namespace orbweave {

/// A job whose results are looked at one by one, opened from its output folder.
class InspectedJob {
 public:
  /// The last job of the folder that ended well, else the last one, as far as it came. Codes of
  /// OpenFinished; FailedPrecondition: nobody knows its images yet. `clock` outlives the object.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<InspectedJob>> Open(const std::string& output,
                                                                          const Clock& clock);

  [[nodiscard]] BlobAccess& blobs() { return *coordinator_; }
  [[nodiscard]] const JobStatus& status() const { return status_; }
  [[nodiscard]] const std::vector<TaskOutcome>& outcomes() const { return outcomes_; }
  [[nodiscard]] const PipelineOptions& options() const { return options_; }
  [[nodiscard]] const ImageManifest& manifest() const { return manifest_; }

  /// Its results; absent where the job has not ended well. Models go by `listener`.
  [[nodiscard]] absl::StatusOr<std::optional<JobResults>> Results(ModelListener& listener);

  /// FailedPrecondition: they have not been extracted.
  [[nodiscard]] const absl::StatusOr<std::vector<Digest>>& FeatureNames() const { return names_; }

  /// FailedPrecondition: they have not been extracted.
  [[nodiscard]] absl::StatusOr<Features> FetchFeaturesOf(ImageId image);
  /// What of an image's features was matched: without those of what goes along with the camera.
  [[nodiscard]] SceneFeatures SceneOf(ImageId image, const Features& features) const {
    return HideCarrier(features, CellsOfCarrier(carriers_, image));
  }

  /// The image's file, where the job has it and it still is what it was: else without pixels, and
  /// `remark` says why in a sentence.
  [[nodiscard]] PictureImage Picture(ImageId image, std::string& remark);

 private:
  InspectedJob() = default;

  std::unique_ptr<Coordinator> coordinator_{};
  JobStatus status_{};
  std::vector<TaskOutcome> outcomes_{};
  PipelineOptions options_{};
  ImageManifest manifest_{};
  absl::StatusOr<std::vector<Digest>> names_{std::vector<Digest>{}};
  std::vector<Carrier> carriers_{};
};

/// `name` as part of a file's name: without folders and ending, and with '_' for what a shell or a
/// file system may take amiss.
[[nodiscard]] std::string FileStemOf(const std::string& name);

}  // namespace orbweave
