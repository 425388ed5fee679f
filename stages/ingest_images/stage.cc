// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/ingest_images/stage.h"

#include <nlohmann/json.hpp>

#include "stages/codecs.h"
#include "stages/ingest_images/ingest_images.h"

namespace orbweave {

absl::Status IngestImagesStage::Run(StageTask<IngestImagesStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageSources sources, task.Read(&IngestImagesStage::sources));
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageManifest manifest,
                            IngestImages(sources, task.options<IngestOptions>(), task.context()));
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::manifest, manifest).status());
  task.Report(
      nlohmann::json{{"images", manifest.images.size()}, {"excluded", manifest.excluded.size()}}
          .dump());
  return absl::OkStatus();
}

}  // namespace orbweave
