// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Orbweave as a library: a folder of panoramas becomes camera positions in this process, without
// coordinator and workers. Usage: reconstruct_folder IMAGES BLOBS
#include <iostream>

#include "core/storage/blob_store.h"
#include "stages/codecs.h"
#include "stages/conclude_adjustment/stage.h"
#include "stages/job_reader.h"
#include "stages/partition_view_graph/stage.h"
#include "stages/plans.h"
#include "stages/prepare_job.h"
#include "stages/run_plan.h"

using namespace orbweave;

absl::Status Reconstruct(const std::string& images, const std::string& blob_folder) {
  ORBWEAVE_ASSIGN_OR_RETURN(BlobStore blobs, BlobStore::Open(blob_folder));
  ORBWEAVE_ASSIGN_OR_RETURN(const JobSpec job,
                            PrepareImageJob(blobs, {.image_folder = images}, "", {}, {}));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto outcomes, RunJob(job, blobs, {.num_threads = 2}));
  ORBWEAVE_ASSIGN_OR_RETURN(const JobPlan plan, FindJobPlan(job.kind));
  JobReader results(plan, job, outcomes, blobs);
  ORBWEAVE_ASSIGN_OR_RETURN(const auto manifest, results.Read(&PartitionViewGraphStage::manifest));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto model,
                            results.Read(&ConcludeAdjustmentStage::Outputs::model));
  for (const FinalisedWorld& world : model.worlds) {
    for (const auto& [id, image] : world.images) {
      const Eigen::Vector3d centre = world.model_from_world * image.cam_from_world.Centre();
      std::cout << manifest.At(id).name << " " << centre.transpose() << "\n";
    }
  }
  return absl::OkStatus();
}

int main(int argc, char** argv) {
  const absl::Status status =
      argc == 3 ? Reconstruct(argv[1], argv[2]) : absl::InvalidArgumentError("IMAGES BLOBS");
  if (!status.ok()) std::cerr << status << "\n";
  return status.ok() ? 0 : 1;
}
