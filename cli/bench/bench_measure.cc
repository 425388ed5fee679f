// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/bench/bench_measure.h"

#include <filesystem>
#include <memory>

#include "absl/strings/str_cat.h"
#include "bench/scaling/measurement_json.h"
#include "cli/arguments/fleet_argument.h"
#include "cli/bench/measure_job.h"
#include "cli/process/exit_code.h"
#include "core/io/file.h"

namespace orbweave {
namespace {

struct MeasureRequest {
  CorridorRun run{};
  OptionArguments options{};
};

std::string MeasurementPath(const std::string& output) { return output + "/measurement.json"; }

absl::Status Measure(const MeasureRequest& arguments) {
  CorridorRun run = arguments.run;
  ORBWEAVE_ASSIGN_OR_RETURN(run.options, ReadOptions(arguments.options));
  ORBWEAVE_ASSIGN_OR_RETURN(const JobMeasurement measurement, MeasureCorridorJob(run));
  return WriteFileAtomically(MeasurementPath(run.folder), MeasurementJson(measurement));
}

}  // namespace

void AddBenchMeasure(CLI::App& bench, SelectedCommand& selected) {
  CLI::App* command =
      bench.add_subcommand("measure", "Coordinate and measure one job: for bench scaling --engine");
  command->group("");
  const auto arguments = std::make_shared<MeasureRequest>();
  CorridorRun& run = arguments->run;
  command->add_option("--corridor", run.corridor, "Folder of orbweave synth corridor")->required();
  command->add_option("--output", run.folder, "Folder of its state and result")->required();
  command->add_option("--await-workers", run.workers, "Workers without which it does not begin")
      ->check(CLI::Range(1, 1000))
      ->required();
  command->add_option("--slots", run.slots, "Slots of each worker")->check(CLI::Range(1, 1024));
  AddFleetArguments(*command, run.fleet);
  AddOptionArguments(*command, arguments->options);
  command->callback([arguments, &selected] {
    selected.run = [arguments] { return ReportStatus(Measure(*arguments)); };
  });
}

std::vector<std::string> MeasureArguments(const NodesRun& run,
                                          uint32_t slots,
                                          const OptionArguments& options) {
  std::error_code error;
  std::vector<std::string> words = {"--corridor",
                                    std::filesystem::absolute(run.corridor, error).string(),
                                    "--await-workers",
                                    absl::StrCat(run.nodes),
                                    "--slots",
                                    absl::StrCat(slots)};
  if (!options.config.empty()) {
    words.insert(words.end(),
                 {"--config", std::filesystem::absolute(options.config, error).string()});
  }
  for (const std::string& set : options.sets) words.insert(words.end(), {"--set", set});
  return words;
}

absl::StatusOr<JobMeasurement> ReadMeasurement(const std::string& output) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string json, ReadFile(MeasurementPath(output)));
  return ParseMeasurement(json);
}

}  // namespace orbweave
