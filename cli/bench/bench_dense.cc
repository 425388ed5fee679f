// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/bench/bench_dense.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "cli/arguments/option_arguments.h"
#include "cli/bench/measure_dense.h"
#include "cli/process/exit_code.h"
#include "cli/process/stop_signals.h"
#include "cli/results/surface_text.h"
#include "core/io/file.h"
#include "core/io/gnss/reference_poses.h"
#include "core/io/json_text.h"
#include "core/io/page/html_text.h"
#include "core/synthetic/realistic_street.h"
#include "core/synthetic/write_street.h"

namespace orbweave {
namespace {

struct DenseBenchArguments {
  StreetOptions street{.panoramas = 12};
  bool realistic = false;
  std::string given_street{};
  std::vector<uint32_t> workers = {1, 2};
  std::string output{};
  OptionArguments options{};
};

absl::Status Render(const DenseBenchArguments& arguments, const std::string& folder) {
  const StopSignals signals;
  const StageContext context{
      .stop = signals.token(),
      .num_threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))};
  std::fprintf(stderr, "rendering %d panoramas\n", arguments.street.panoramas);
  ORBWEAVE_RETURN_IF_ERROR(EnsureWritableFolder(folder));
  return WriteStreet(
      arguments.realistic ? RealisticStreet(arguments.street) : arguments.street, folder, context);
}

/// Of a run against the first one, which is taken to use its workers fully.
double EfficiencyOf(const DenseMeasurement& run, const DenseMeasurement& first) {
  return first.wall_s * first.workers / (run.wall_s * run.workers);
}

std::string RunsText(const std::vector<DenseMeasurement>& runs) {
  std::string text =
      "| workers | wall s | efficiency | points | cloud.las |\n|---|---|---|---|---|\n";
  for (const DenseMeasurement& run : runs) {
    absl::StrAppendFormat(&text,
                          "| %u | %.1f | %.2f | %s | %s |\n",
                          run.workers,
                          run.wall_s,
                          EfficiencyOf(run, runs.front()),
                          CountText(run.points),
                          run.cloud.ToShortHex());
  }
  return text;
}

std::string StagesText(const DenseMeasurement& run) {
  std::string text = absl::StrFormat(
      "Stages with %u workers, %d panoramas, %.1f megapixels in all:\n\n"
      "| stage | tasks | CPU s per panorama | CPU s per megapixel | peak MB of a process |\n"
      "|---|---|---|---|---|\n",
      run.workers,
      run.panoramas,
      run.megapixels);
  for (const StageTotals& stage : run.stages) {
    absl::StrAppendFormat(&text,
                          "| %s | %u | %.2f | %.2f | %.0f |\n",
                          stage.stage,
                          stage.tasks,
                          stage.cpu_s / static_cast<double>(run.panoramas),
                          stage.cpu_s / run.megapixels,
                          static_cast<double>(stage.peak_memory_bytes) / 1e6);
  }
  return text;
}

std::string BenchJson(const std::vector<DenseMeasurement>& runs) {
  Json list = Json::array();
  for (const DenseMeasurement& run : runs) {
    Json stages = Json::array();
    for (const StageTotals& stage : run.stages) {
      stages.push_back({{"stage", stage.stage},
                        {"tasks", stage.tasks},
                        {"cpu_s", stage.cpu_s},
                        {"peak_memory_bytes", stage.peak_memory_bytes}});
    }
    list.push_back({{"workers", run.workers},
                    {"wall_s", run.wall_s},
                    {"efficiency", EfficiencyOf(run, runs.front())},
                    {"panoramas", run.panoramas},
                    {"megapixels", run.megapixels},
                    {"points", run.points},
                    {"cloud", run.cloud.ToHex()},
                    {"stages", stages}});
  }
  return JsonText({{"runs", list}});
}

absl::StatusOr<std::string> TruthText(const std::string& street, const std::string& cloud) {
  const std::string surface = street + "/surface.ply";
  if (!std::filesystem::exists(surface)) return std::string("no surface.ply: not held to truth\n");
  const std::string path = street + "/truth.csv";
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string text, ReadFile(path));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto poses, ParseReferencePoses(text, path));
  std::vector<Eigen::Vector3d> centres;
  for (const auto& [name, cam_from_world] : poses) centres.push_back(cam_from_world.Centre());
  return SurfaceText(cloud, surface, Sim3{}, std::move(centres));
}

absl::Status CheckSameBytes(const std::vector<DenseMeasurement>& runs) {
  const bool same = std::ranges::all_of(
      runs, [&](const DenseMeasurement& run) { return run.cloud == runs.front().cloud; });
  if (same) return absl::OkStatus();
  return absl::InternalError("clouds of different numbers of workers are not the same bytes");
}

absl::Status BenchDense(const DenseBenchArguments& arguments) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, ReadOptions(arguments.options));
  ORBWEAVE_RETURN_IF_ERROR(ValidateOptions("street", arguments.street));
  const std::string scratch = arguments.output + "/.scratch";
  const std::string cloud = scratch + "/cloud";
  std::string street = arguments.given_street;
  if (std::filesystem::weakly_canonical(street).string().starts_with(
          std::filesystem::weakly_canonical(scratch).string())) {
    return absl::InvalidArgumentError(street + " lies where this command works and tidies up; " +
                                      "move it, or name another --output");
  }
  std::filesystem::remove_all(scratch);
  ORBWEAVE_RETURN_IF_ERROR(EnsureWritableFolder(scratch));
  if (street.empty()) {
    street = scratch + "/street";
    ORBWEAVE_RETURN_IF_ERROR(Render(arguments, street));
  }
  std::vector<DenseMeasurement> runs;
  for (const uint32_t workers : arguments.workers) {
    std::filesystem::remove_all(cloud);
    ORBWEAVE_ASSIGN_OR_RETURN(runs.emplace_back(),
                              MeasureDenseJob(street, options, workers, cloud));
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string truth, TruthText(street, cloud));
  std::filesystem::remove_all(scratch);
  ORBWEAVE_RETURN_IF_ERROR(WriteFileAtomically(arguments.output + "/dense.json", BenchJson(runs)));
  std::printf("%s\n%s\n%s%s/dense.json\n",
              RunsText(runs).c_str(),
              StagesText(runs.front()).c_str(),
              truth.c_str(),
              arguments.output.c_str());
  return CheckSameBytes(runs);
}

void AddStreetArguments(CLI::App& command, DenseBenchArguments& arguments) {
  CLI::Option* given = command.add_option(
      "--street",
      arguments.given_street,
      "Folder with images, truth.csv and, where there are, masks and surface.ply (of `orbweave "
      "synth street`, or your own), instead of one that is rendered");
  StreetOptions& street = arguments.street;
  command.add_option("--panoramas", street.panoramas, "Panoramas to render")
      ->check(CLI::Range(2, 100000))
      ->excludes(given)
      ->capture_default_str();
  command.add_option("--width", street.width_px, "Their width; the height is half of it")
      ->check(CLI::Range(128, 16384))
      ->excludes(given)
      ->capture_default_str();
  command.add_option("--spacing", street.spacing_m, "Metres from one to the next")
      ->check(CLI::PositiveNumber)
      ->excludes(given)
      ->capture_default_str();
  command.add_option("--seed", street.seed, "Of the street")
      ->excludes(given)
      ->capture_default_str();
  command.add_flag("--realistic", arguments.realistic, "All that real streets have at once")
      ->excludes(given);
}

}  // namespace

void AddBenchDense(CLI::App& bench, SelectedCommand& selected) {
  CLI::App* command = bench.add_subcommand(
      "dense", "Time, memory and truth of the dense cloud of a street with known poses");
  const auto arguments = std::make_shared<DenseBenchArguments>();
  AddStreetArguments(*command, *arguments);
  command
      ->add_option("--workers",
                   arguments->workers,
                   "Numbers of worker processes, each with a run of its own from nothing")
      ->delimiter(',')
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--output", arguments->output, "Folder for dense.json")->required();
  AddOptionArguments(*command, arguments->options);
  command->footer(
      "Examples:\n"
      "  orbweave bench dense --output bench\n"
      "  orbweave bench dense --realistic --panoramas 24 --workers 1,2,4 --output bench\n"
      "  orbweave bench dense --street street --workers 8 --output bench\n"
      "Runs whose clouds are not the same bytes end in an error.");
  command->callback([arguments, &selected] {
    selected.run = [arguments] { return ReportStatus(BenchDense(*arguments)); };
  });
}

}  // namespace orbweave
