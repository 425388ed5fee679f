// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/bench/bench_scaling.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "absl/strings/str_cat.h"
#include "bench/scaling/build_scaling_report.h"
#include "bench/scaling/format_scaling.h"
#include "bench/scaling/scaling_html.h"
#include "bench/scaling/scaling_json.h"
#include "cli/arguments/option_arguments.h"
#include "cli/bench/measure_job.h"
#include "cli/bench/run_study.h"
#include "cli/bench/write_corridor.h"
#include "cli/process/exit_code.h"
#include "core/io/file.h"

namespace orbweave {
namespace {

struct BenchArguments {
  std::vector<uint32_t> panoramas = {250, 500, 1000, 2000};
  std::vector<uint32_t> workers = {1, 2};
  std::string job{};
  std::string output{};
  EngineArgument engine{};
  ScalingQuestion question{};
  OptionArguments options{};
};

/// With the adjustment as in large jobs, unless the command line says otherwise.
OptionArguments Given(const BenchArguments& arguments) {
  OptionArguments given = arguments.options;
  given.sets.insert(given.sets.begin(), "blocks.distribute_from=0");
  return given;
}

/// Every size on the fewest workers, the largest on all numbers of them.
absl::StatusOr<std::vector<JobMeasurement>> MeasureCorridors(const BenchArguments& arguments,
                                                             const std::string& scratch) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, ReadOptions(Given(arguments)));
  const uint32_t largest =
      *std::max_element(arguments.panoramas.begin(), arguments.panoramas.end());
  const uint32_t fewest = *std::min_element(arguments.workers.begin(), arguments.workers.end());
  std::vector<JobMeasurement> jobs;
  for (const uint32_t panoramas : arguments.panoramas) {
    const std::string corridor = absl::StrCat(scratch, "/corridor-", panoramas);
    ORBWEAVE_RETURN_IF_ERROR(
        WriteCorridor({.panoramas = static_cast<int>(panoramas)}, corridor).status());
    for (const uint32_t workers : arguments.workers) {
      if (panoramas != largest && workers != fewest) continue;
      std::fprintf(stderr, "%u panoramas, %u workers\n", panoramas, workers);
      const std::string folder = absl::StrCat(scratch, "/job-", panoramas, "-", workers);
      ORBWEAVE_ASSIGN_OR_RETURN(jobs.emplace_back(),
                                MeasureCorridorJob({.corridor = corridor,
                                                    .options = options,
                                                    .folder = folder,
                                                    .fleet = {.workers = workers},
                                                    .workers = workers}));
      std::filesystem::remove_all(folder);
    }
  }
  return jobs;
}

absl::Status Write(const ScalingReport& report, const std::string& folder) {
  ORBWEAVE_RETURN_IF_ERROR(WriteFileAtomically(folder + "/scaling.json", ScalingJson(report)));
  ORBWEAVE_RETURN_IF_ERROR(WriteFileAtomically(folder + "/scaling.html", ScalingHtml(report)));
  std::printf("%s\n%s/scaling.html\n", FormatScaling(report).c_str(), folder.c_str());
  return absl::OkStatus();
}

double LoadAverage() {
  double load = 0.0;
  return ::getloadavg(&load, 1) == 1 ? load : 0.0;
}

/// The report on a study by an engine.
absl::StatusOr<ScalingReport> Study(const BenchArguments& arguments, const std::string& scratch) {
  const EngineArgument& engine = arguments.engine;
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<StudyRun> runs,
                            RunStudy(engine, Given(arguments), scratch));
  std::vector<JobMeasurement> jobs;
  for (const StudyRun& run : runs) jobs.push_back(run.job);
  ScalingReport report = BuildScalingReport(jobs, arguments.question);
  const bool has_own_machines = engine.engine == "slurm";
  report.study = BuildEngineStudy(
      runs,
      {.engine = engine.engine,
       .machine_processors = has_own_machines ? 0 : std::thread::hardware_concurrency()});
  return report;
}

absl::StatusOr<ScalingReport> Measure(const BenchArguments& arguments, const std::string& scratch) {
  if (!arguments.engine.engine.empty()) return Study(arguments, scratch);
  std::vector<JobMeasurement> jobs;
  if (!arguments.job.empty()) {
    ORBWEAVE_ASSIGN_OR_RETURN(jobs.emplace_back(), MeasureFinishedJob(arguments.job));
  } else {
    ORBWEAVE_ASSIGN_OR_RETURN(jobs, MeasureCorridors(arguments, scratch));
  }
  return BuildScalingReport(jobs, arguments.question);
}

absl::Status BenchScaling(const BenchArguments& arguments) {
  const std::string output = arguments.output.empty() ? arguments.job : arguments.output;
  const double load_average = LoadAverage();
  ORBWEAVE_RETURN_IF_ERROR(EnsureWritableFolder(output));
  const std::string scratch = output + "/.scratch";
  std::filesystem::remove_all(scratch);
  ORBWEAVE_ASSIGN_OR_RETURN(ScalingReport report, Measure(arguments, scratch));
  std::filesystem::remove_all(scratch);
  report.processors = std::thread::hardware_concurrency();
  report.load_average = load_average;
  return Write(report, output);
}

}  // namespace

void AddBenchScaling(CLI::App& bench, SelectedCommand& selected) {
  CLI::App* command =
      bench.add_subcommand("scaling", "What more workers and larger jobs do to the time");
  const auto arguments = std::make_shared<BenchArguments>();
  CLI::Option* panoramas =
      command
          ->add_option("--panoramas", arguments->panoramas, "Sizes of the corridors that are run")
          ->delimiter(',')
          ->check(CLI::Range(2, 1000000))
          ->capture_default_str();
  CLI::Option* workers =
      command
          ->add_option("--workers",
                       arguments->workers,
                       "Numbers of worker processes: all for the largest corridor, the smallest "
                       "for the others")
          ->delimiter(',')
          ->check(CLI::Range(1, 1024))
          ->capture_default_str();
  CLI::Option* job =
      command
          ->add_option("--job", arguments->job, "Output folder of a finished job, instead of runs")
          ->excludes(panoramas)
          ->excludes(workers);
  CLI::Option* engine = AddEngineArguments(*command, arguments->engine);
  engine->excludes(panoramas)->excludes(workers)->excludes(job);
  CLI::Option* output = command->add_option(
      "--output", arguments->output, "Folder for scaling.json and scaling.html; or that of --job");
  command
      ->add_option("--predict",
                   arguments->question.predict,
                   "Sizes to extrapolate to; needs two measured sizes")
      ->delimiter(',')
      ->excludes(job)
      ->check(CLI::Range(2, 10000000));
  command
      ->add_option("--worker-gbit",
                   arguments->question.worker_gbit_per_s,
                   "Gbit/s between a worker and the coordinator, for the simulation")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      ->add_option("--coordinator-gbit",
                   arguments->question.coordinator_gbit_per_s,
                   "Gbit/s of the coordinator to all workers together")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  AddOptionArguments(*command, arguments->options);
  command->footer(
      "Examples:\n"
      "  orbweave bench scaling --panoramas 250,500,1000 --workers 1,2 --output scaling\n"
      "  orbweave bench scaling --job model\n"
      "  orbweave bench scaling --engine netns --nodes 1,2,4 --node-processors 0.4 --link-mbit 200 "
      "--strong 500 --weak 125 --repeat 3 --output scaling\n"
      "  orbweave bench scaling --engine slurm --nodes 1,2,4,8 --cpus 8 --strong 4000 --weak 500 "
      "--sbatch=--account=city --output scaling\n"
      "The global adjustment is distributed as in large jobs (blocks.distribute_from=0).");
  command->callback([arguments, job, output, &selected] {
    if (job->count() + output->count() == 0) throw CLI::RequiredError("--output (or --job)");
    selected.run = [arguments] { return ReportStatus(BenchScaling(*arguments)); };
  });
}

}  // namespace orbweave
