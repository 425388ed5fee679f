// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/commands/launch_command.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "cli/commands/run_command.h"
#include "cli/process/exit_code.h"
#include "cli/slurm/slurm_launch.h"

namespace orbweave {
namespace {

struct LaunchArguments {
  SlurmLaunch launch{};
  std::string nodes = "1";
  bool print = false;
  bool wait = false;
};

/// What a launch decides itself.
absl::Status RefuseFleetArguments(const std::vector<std::string>& arguments) {
  for (const char* taken : {"--workers", "--listen", "--tls", "--announce"}) {
    const auto is_it = [taken](const std::string& argument) {
      return absl::StartsWith(argument, taken);
    };
    if (std::ranges::any_of(arguments, is_it)) {
      return absl::InvalidArgumentError(
          absl::StrCat(taken, " is up to the launch: give --nodes and --cpus"));
    }
  }
  return absl::OkStatus();
}

/// Whether `orbweave run` takes them: better known now than hours later.
absl::Status CheckRunArguments(const SlurmLaunch& launch) {
  constexpr double kShortest_min = 3.0;  // Slurm warns a minute or two before the end
  double minutes = 0.0;
  if (absl::SimpleAtod(launch.time, &minutes) && minutes < kShortest_min)
    return absl::InvalidArgumentError("--time is less than 3 minutes: nothing would get done");
  ORBWEAVE_RETURN_IF_ERROR(RefuseFleetArguments(launch.run_arguments));
  CLI::App app;
  SelectedCommand ignored;
  AddRunCommand(app, ignored);
  std::vector<std::string> words = {"run", "--output", launch.output};
  words.insert(words.end(), launch.run_arguments.begin(), launch.run_arguments.end());
  std::ranges::reverse(words);  // as CLI11 takes them
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    return absl::InvalidArgumentError(error.what());
  }
  return absl::OkStatus();
}

/// "N" or "MIN:MAX".
absl::Status ReadNodes(const std::string& nodes, SlurmLaunch& launch) {
  constexpr uint32_t kMost = 10'000;
  const std::vector<std::string> bounds = absl::StrSplit(nodes, ':');
  const bool are_numbers = absl::SimpleAtoi(bounds.front(), &launch.min_nodes) &&
                           absl::SimpleAtoi(bounds.back(), &launch.max_nodes);
  if (!are_numbers || bounds.size() > 2 || launch.min_nodes < 1 ||
      launch.max_nodes < launch.min_nodes || launch.max_nodes > kMost) {
    return absl::InvalidArgumentError(absl::StrCat(
        "--nodes ", nodes, ": give a number from 1 to ", kMost, ", or two as in 2:16"));
  }
  return absl::OkStatus();
}

int Launch(LaunchArguments arguments) {
  SlurmLaunch& launch = arguments.launch;
  absl::Status status = ReadNodes(arguments.nodes, launch);
  if (status.ok()) status = MakeAbsolute(launch);
  if (status.ok()) status = CheckRunArguments(launch);
  if (status.ok() && arguments.print) {
    std::printf("# %s/coordinator.sbatch\n%s\n# %s/workers.sbatch\n%s",
                launch.Folder().c_str(),
                CoordinatorScript(launch).c_str(),
                launch.Folder().c_str(),
                WorkersScript(launch).c_str());
    return kExitOk;
  }
  if (status.ok()) status = WriteLaunch(launch);
  if (!status.ok()) return ReportStatus(status);
  std::printf("scripts, keys and logs are in %s\n", launch.Folder().c_str());
  return SubmitLaunch(launch, arguments.wait ? SubmitAnd::kWait : SubmitAnd::kLeave);
}

CLI::App* AddSlurm(CLI::App& launch, const std::shared_ptr<LaunchArguments>& arguments) {
  CLI::App* slurm = launch.add_subcommand(
      "slurm", "Have Slurm run it: a coordinator and workers that it may stop and requeue");
  slurm->allow_extras();
  slurm
      ->add_option("--output",
                   arguments->launch.output,
                   "Folder of the results, on storage that all nodes see")
      ->required();
  slurm->add_option(
      "--nodes",
      arguments->nodes,
      "Workers, one allocation each; or MIN:MAX: as many as there is work for (default: 1)");
  slurm->add_option("--cpus", arguments->launch.cpus, "CPUs of a worker: its tasks at a time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  slurm->add_option("--time",
                    arguments->launch.time,
                    "Time of an allocation, as sbatch takes it; the job goes on in the next one");
  slurm
      ->add_option("--sbatch",
                   arguments->launch.sbatch,
                   "A further option of sbatch, as in --sbatch=--account=city (repeatable)")
      ->allow_extra_args(false);
  slurm
      ->add_option("--sbatch-workers",
                   arguments->launch.workers_sbatch,
                   "The same for the workers alone, as in --sbatch-workers=--mem=64G (repeatable)")
      ->allow_extra_args(false);
  slurm
      ->add_option("--sbatch-coordinator",
                   arguments->launch.coordinator_sbatch,
                   "The same for the coordinator alone (repeatable)")
      ->allow_extra_args(false);
  CLI::Option* const scratch = slurm->add_option(
      "--scratch",
      arguments->launch.scratch,
      "Folder on a disk of each worker's node for copies of blobs that were read, as in "
      "--scratch '$TMPDIR' (the node's own)");
  slurm
      ->add_option("--scratch-size",
                   arguments->launch.scratch_size,
                   "Bytes of that disk for each worker, as in 50GiB (default: 16GiB)")
      ->needs(scratch);
  slurm->add_option("--journal-folder",
                    arguments->launch.journal_folder,
                    "Folder on a disk of the coordinator's node for its journal (default: $TMPDIR, "
                    "or /tmp)");
  slurm->add_flag("--print", arguments->print, "Only show the scripts");
  slurm->add_flag("--wait", arguments->wait, "Wait for the end; the exit code is the job's");
  return slurm;
}

}  // namespace

void AddLaunchCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand("launch", "Have an engine run a job on its machines");
  command->require_subcommand(1);
  const auto arguments = std::make_shared<LaunchArguments>();
  CLI::App* slurm = AddSlurm(*command, arguments);
  slurm->footer(
      "Examples:\n"
      "  orbweave launch slurm street/images --output model --nodes 16 --cpus 8 --time 4:00:00\n"
      "  orbweave launch slurm street/images --gnss street/gnss.csv --dense --output model --nodes "
      "4 "
      "--sbatch=--account=city --wait\n"
      "  orbweave launch slurm street/images --output model --nodes 2:16 --cpus 8\n"
      "  orbweave launch slurm street/images --output model --print\n"
      "All other options are those of orbweave run. The same command goes on where a job was.");
  slurm->callback([arguments, slurm, &selected] {
    arguments->launch.run_arguments = slurm->remaining();
    selected.run = [arguments] { return Launch(*arguments); };
  });
}

}  // namespace orbweave
