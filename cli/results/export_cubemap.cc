// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/export_cubemap.h"

#include <cstdio>
#include <memory>
#include <utility>

#include "cli/results/fetch_results.h"
#include "cli/results/finished_job.h"
#include "core/base/status.h"
#include "core/io/text_fields.h"

namespace orbweave {
namespace {

/// Exports the first model that passes by, and counts the others.
class CubeListener final : public ModelListener {
 public:
  CubeListener(BlobAccess& coordinator, std::string folder, const CubeExportOptions& options)
      : coordinator_(coordinator), folder_(std::move(folder)), options_(options) {}

  void BeginModel(const std::map<ImageId, RegisteredImage>& images,
                  const ImageManifest& manifest) override {
    if (num_models_++ > 0) return;
    export_ = std::make_unique<CubeExport>(folder_, images, manifest, options_);
    status_ = export_->Begin();
  }
  void TakePoint(const Track& track) override {
    if (export_ && status_.ok()) export_->AddPoint(track);
  }
  [[nodiscard]] absl::Status EndModel() override {
    ORBWEAVE_RETURN_IF_ERROR(status_);
    if (!export_) return absl::OkStatus();
    ORBWEAVE_ASSIGN_OR_RETURN(
        counts_,
        export_->Finish([&](const ImageRecord& record) { return FileOf(record.content); },
                        [&](const ImageRecord& record) { return FileOf(record.mask); }));
    export_.reset();
    return absl::OkStatus();
  }

  [[nodiscard]] size_t num_models() const { return num_models_; }
  [[nodiscard]] const CubeExportCounts& counts() const { return counts_; }

 private:
  /// Empty where the job never had the file, or it is no longer what it was.
  [[nodiscard]] absl::StatusOr<std::string> FileOf(const Digest& content) const {
    if (content.IsZero()) return std::string();
    absl::StatusOr<std::string> bytes = coordinator_.Get(content);
    if (absl::IsNotFound(bytes.status()) || absl::IsDataLoss(bytes.status())) return std::string();
    return bytes;
  }

  BlobAccess& coordinator_;
  std::string folder_;
  CubeExportOptions options_;
  absl::Status status_{};
  size_t num_models_ = 0;
  std::unique_ptr<CubeExport> export_{};  ///< of the first model, while it passes by
  CubeExportCounts counts_{};
};

}  // namespace

absl::Status SetCubeFormats(const std::string& names, CubeExportOptions& options) {
  options.colmap = options.nerfstudio = options.openmvs = false;
  for (const std::string& name : SplitFields(names, ',')) {
    if (name == "colmap") {
      options.colmap = true;
    } else if (name == "nerfstudio") {
      options.nerfstudio = true;
    } else if (name == "openmvs") {
      options.openmvs = true;
    } else {
      return absl::InvalidArgumentError("'" + name + "' is none of: colmap, nerfstudio, openmvs");
    }
  }
  return absl::OkStatus();
}

absl::Status ExportCubemap(ClientApi& coordinator,
                           const std::string& output,
                           const std::string& folder,
                           const CubeExportOptions& options) {
  ORBWEAVE_ASSIGN_OR_RETURN(const JobStatus job, LastFinishedJob(coordinator, output));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<TaskOutcome> outcomes,
                            coordinator.GetOutcomes(job.id));
  CubeListener listener(coordinator, folder, options);
  ORBWEAVE_RETURN_IF_ERROR(FetchResults(coordinator, job.spec, outcomes, &listener).status());
  if (listener.num_models() == 0) {
    return absl::FailedPreconditionError("the job in '" + output + "' has no model to export");
  }
  const CubeExportCounts& counts = listener.counts();
  std::printf("%zu panoramas written as %zu pinhole images to %s\n",
              counts.panoramas,
              6 * counts.panoramas,
              folder.c_str());
  if (counts.without_pixels > 0) {
    std::printf("%zu of them without pixels: the job has no files of theirs any more\n",
                counts.without_pixels);
  }
  if (listener.num_models() > 1) {
    std::printf("%zu smaller models were left out\n", listener.num_models() - 1);
  }
  return absl::OkStatus();
}

}  // namespace orbweave
