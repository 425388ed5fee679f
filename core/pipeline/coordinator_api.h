// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/pipeline/admin_api.h"
#include "core/pipeline/blob_depot.h"
#include "core/pipeline/job_api.h"
#include "core/pipeline/worker_api.h"

namespace orbweave {

/// A coordinator as commands see it. Who uses less of it takes the part that it uses.
class ClientApi : public JobApi, public AdminApi, public BlobDepot {};

/// The one seam of distribution: in-process it is the coordinator object, elsewhere a gRPC stub.
class CoordinatorApi : public WorkerApi, public ClientApi {};

}  // namespace orbweave
