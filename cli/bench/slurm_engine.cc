// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/bench/slurm_engine.h"

#include "absl/strings/str_cat.h"
#include "cli/bench/bench_measure.h"
#include "cli/process/exit_code.h"
#include "cli/slurm/slurm_launch.h"

namespace orbweave {
namespace {

class SlurmEngine final : public BenchEngine {
 public:
  SlurmEngine(const EngineArgument& argument, OptionArguments options)
      : argument_(argument), options_(std::move(options)) {}

  absl::StatusOr<JobMeasurement> Run(const NodesRun& run) override {
    SlurmLaunch launch{.command = {"bench", "measure"},
                       .output = run.folder,
                       .run_arguments = MeasureArguments(run, argument_.cpus, options_),
                       .min_nodes = run.nodes,
                       .max_nodes = run.nodes,
                       .cpus = argument_.cpus,
                       .time = argument_.time,
                       .sbatch = argument_.sbatch};
    ORBWEAVE_RETURN_IF_ERROR(MakeAbsolute(launch));
    ORBWEAVE_RETURN_IF_ERROR(WriteLaunch(launch));
    const int code = SubmitLaunch(launch, SubmitAnd::kWait);
    if (code != kExitOk) {
      return absl::InternalError(absl::StrCat(
          "the job ended with exit code ", code, ": see the logs in ", launch.Folder()));
    }
    return ReadMeasurement(launch.output);
  }

 private:
  EngineArgument argument_;
  OptionArguments options_;
};

}  // namespace

std::unique_ptr<BenchEngine> MakeSlurmEngine(const EngineArgument& argument,
                                             const OptionArguments& options) {
  return std::make_unique<SlurmEngine>(argument, options);
}

}  // namespace orbweave
