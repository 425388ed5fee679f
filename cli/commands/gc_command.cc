// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/commands/gc_command.h"

#include <cstdio>
#include <memory>
#include <string>

#include "cli/arguments/coordinator_argument.h"
#include "cli/process/exit_code.h"

namespace orbweave {
namespace {

constexpr double kHour_s = 3600.0;

struct GcOptions {
  CoordinatorArgument coordinator{};
  double unused_hours = GarbageOptions{}.unused_s / kHour_s;
  bool dry_run = false;
};

void PrintLine(const char* what, uint64_t blobs, uint64_t bytes) {
  std::printf("%-12s %10llu blobs %12.1f MB\n",
              what,
              static_cast<unsigned long long>(blobs),
              1e-6 * static_cast<double>(bytes));
}

absl::Status CollectGarbage(const GcOptions& options) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto coordinator, Connect(options.coordinator));
  ORBWEAVE_ASSIGN_OR_RETURN(const GarbageReport report,
                            coordinator->CollectGarbage({.unused_s = options.unused_hours * kHour_s,
                                                         .dry_run = options.dry_run}));
  PrintLine("needed", report.needed_blobs, report.needed_bytes);
  PrintLine("used lately", report.recent_blobs, report.recent_bytes);
  PrintLine(options.dry_run ? "garbage" : "removed", report.removed_blobs, report.removed_bytes);
  return absl::OkStatus();
}

}  // namespace

void AddGcCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command =
      app.add_subcommand("gc", "Remove what no job of a coordinator needs from its disk");
  const auto options = std::make_shared<GcOptions>();
  AddCoordinatorArgument(*command, options->coordinator);
  command
      ->add_option("--unused-for",
                   options->unused_hours,
                   "Hours nobody must have used a blob; more than any task or upload takes")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  command->add_flag("--dry-run", options->dry_run, "Remove nothing, say how much it would be");
  command->footer(
      "Examples:\n"
      "  orbweave gc --coordinator 127.0.0.1:7000 --dry-run\n"
      "  orbweave gc --coordinator 127.0.0.1:7000\n"
      "What any job on the list needs stays, whether it runs, has ended or failed: orbweave forget "
      "takes a job off the list. May run beside jobs.");
  command->callback([options, &selected] {
    selected.run = [options] { return ReportStatus(CollectGarbage(*options)); };
  });
}

}  // namespace orbweave
