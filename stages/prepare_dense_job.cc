// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/prepare_dense_job.h"

#include <filesystem>
#include <iterator>
#include <utility>

#include "core/base/status.h"
#include "core/io/printable_text.h"
#include "stages/check_options_together.h"
#include "stages/codecs.h"
#include "stages/ingest_images/ingest_images.h"
#include "stages/model_from_colmap.h"
#include "stages/offer_files.h"
#include "stages/plans.h"
#include "stages/stage_task.h"

namespace orbweave {

absl::StatusOr<JobSpec> PrepareDenseJob(BlobDepot& depot,
                                        const ColmapModel& model,
                                        const ScanRequest& request,
                                        const PipelineOptions& options,
                                        const StageContext& context) {
  ORBWEAVE_RETURN_IF_ERROR(CheckDenseOptions(options.sources));
  const ImagePlaces places = FoldersOf(request);
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageSources sources, ScanImagePlaces(places, request, context));
  ORBWEAVE_ASSIGN_OR_RETURN(ImageManifest manifest, IngestImages(sources, options.ingest, context));
  ORBWEAVE_ASSIGN_OR_RETURN(ImportedModel imported, ModelFromColmap(model, manifest));
  std::ranges::move(imported.without_image, std::back_inserter(manifest.excluded));
  ORBWEAVE_RETURN_IF_ERROR(OfferFiles(depot, sources, places, context));
  FinalisedModel finalised{.worlds = {std::move(imported.world)}, .subproblems = {{}}};
  for (const Subproblem& subproblem : imported.subproblems) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, PutBlob(subproblem, depot));
    finalised.subproblems[0].push_back(digest);
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest manifest_blob, PutBlob(manifest, depot));
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest model_blob, PutBlob(finalised, depot));
  JobInputs<DenseJob> inputs;
  inputs.Set(&DenseJob::manifest, manifest_blob).Set(&DenseJob::model, model_blob);
  return JobSpec{
      .kind = std::string(DenseJob::kKind),
      .inputs = inputs.InOrder(),
      .options_text = PipelineOptionsToText(options),
      .label = Utf8Text(std::filesystem::path(request.image_folder).filename().string())};
}

}  // namespace orbweave
