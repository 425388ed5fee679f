// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/commands/synth_command.h"

#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "cli/bench/write_corridor.h"
#include "cli/process/exit_code.h"
#include "cli/process/stop_signals.h"
#include "core/io/file.h"
#include "core/synthetic/realistic_street.h"
#include "core/synthetic/write_street.h"

namespace orbweave {
namespace {

struct CorridorArguments {
  CorridorOptions options{};
  std::string output{};
};

/// One command-line option per field of an options struct: --noise-px for noise_px.
template <typename Options>
void AddFields(CLI::App& command, Options& options) {
  internal::ForEachField(
      options, [&](std::string_view name, auto& member, std::string_view help, Range range) {
        std::string flag = "--" + std::string(name);
        std::replace(flag.begin(), flag.end(), '_', '-');
        const std::string key(name);
        Options* target = &options;
        command
            .add_option_function<std::string>(
                flag,
                [target, key](const std::string& text) {
                  const absl::Status status = SetOption(*target, key, text);
                  if (!status.ok()) throw CLI::ValidationError(std::string(status.message()));
                },
                std::string(help))
            ->type_name(internal::RangeOf(member, range))
            ->default_str(internal::ValueToText(member));
      });
}

absl::Status MakeCorridorFolder(const CorridorArguments& arguments) {
  ORBWEAVE_ASSIGN_OR_RETURN(const CorridorSize size,
                            WriteCorridor(arguments.options, arguments.output));
  std::printf("%zu panoramas and %zu pairs written to %s\n",
              size.panoramas,
              size.pairs,
              arguments.output.c_str());
  return absl::OkStatus();
}

void AddCorridor(CLI::App& synth, SelectedCommand& selected) {
  CLI::App* command =
      synth.add_subcommand("corridor", "Rays only, for scale: keypoints and matches, no pixels");
  const auto arguments = std::make_shared<CorridorArguments>();
  AddFields(*command, arguments->options);
  command
      ->add_option("--output", arguments->output, "Folder for corridor.db, gnss.csv and truth.csv")
      ->required();
  command->footer(
      "Examples:\n"
      "  orbweave synth corridor --panoramas 500 --output corridor\n"
      "  orbweave synth corridor --panoramas 2000 --shape grid --outlier-share 0.3 --output grid");
  command->callback([arguments, &selected] {
    selected.run = [arguments] { return ReportStatus(MakeCorridorFolder(*arguments)); };
  });
}

/// A street's option as it was given: its name and text.
using StreetSetting = std::pair<std::string, std::string>;

struct StreetArguments {
  bool realistic = false;
  std::vector<StreetSetting> settings{};
  std::string size = "2048x1024";
  std::string output{};
};

/// "2048x1024": twice as wide as high.
absl::StatusOr<int> WidthOf(const std::string& size) {
  int width = 0;
  int height = 0;
  char end = 0;
  if (std::sscanf(size.c_str(), "%dx%d%c", &width, &height, &end) != 2 || width != 2 * height) {
    return absl::InvalidArgumentError("--size " + size +
                                      ": a panorama is twice as wide as high, e.g. 2048x1024");
  }
  return width;
}

/// Sets the field of that name in the one of both that has it.
absl::Status SetStreetOption(StreetOptions& options, const StreetSetting& setting) {
  const auto& [name, text] = setting;
  bool is_hardship = false;
  internal::ForEachField(options.hardships,
                         [&](std::string_view field, auto&, std::string_view, Range) {
                           is_hardship = is_hardship || field == name;
                         });
  return is_hardship ? SetOption(options.hardships, name, text) : SetOption(options, name, text);
}

/// What was asked for one by one goes before what a scene brings along.
absl::StatusOr<StreetOptions> StreetOptionsFrom(const StreetArguments& arguments) {
  StreetOptions asked;
  for (const StreetSetting& setting : arguments.settings)
    ORBWEAVE_RETURN_IF_ERROR(SetStreetOption(asked, setting));
  StreetOptions options;
  if (arguments.realistic) options = RealisticStreet(options);
  if (asked.hardships.room) options = RoomOptions(options);
  for (const StreetSetting& setting : arguments.settings)
    ORBWEAVE_RETURN_IF_ERROR(SetStreetOption(options, setting));
  ORBWEAVE_ASSIGN_OR_RETURN(options.width_px, WidthOf(arguments.size));
  ORBWEAVE_RETURN_IF_ERROR(ValidateOptions("street", options));
  ORBWEAVE_RETURN_IF_ERROR(ValidateOptions("street", options.hardships));
  return options;
}

absl::Status WriteRenderedStreet(const StreetArguments& arguments) {
  const StopSignals signals;
  ORBWEAVE_ASSIGN_OR_RETURN(const StreetOptions options, StreetOptionsFrom(arguments));
  ORBWEAVE_RETURN_IF_ERROR(EnsureWritableFolder(arguments.output));
  const auto show = [](const Progress& progress) {
    std::fprintf(stderr,
                 "rendered %d of %d panoramas\n",
                 static_cast<int>(progress.done),
                 static_cast<int>(progress.total));
  };
  const StageContext context{
      .stop = signals.token(),
      .report = show,
      .num_threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))};
  ORBWEAVE_RETURN_IF_ERROR(WriteStreet(options, arguments.output, context));
  std::printf("%d panoramas written to %s\n", options.panoramas, arguments.output.c_str());
  return absl::OkStatus();
}

/// One command-line option per field: --spacing and --spacing-m for spacing_m; a switch and its
/// opposite, --standing and --no-standing, for a field that is true or false.
template <typename Options>
void AddStreetFields(CLI::App& command, StreetArguments& arguments, const char* group) {
  Options defaults;
  internal::ForEachField(
      defaults, [&](std::string_view name, auto& member, std::string_view help, Range range) {
        if (name == "width_px") return;  // --size
        std::string flag(name);
        std::replace(flag.begin(), flag.end(), '_', '-');
        const auto set = [&arguments, key = std::string(name)](const std::string& text) {
          arguments.settings.emplace_back(key, text);
          StreetOptions scratch;
          const absl::Status status = SetStreetOption(scratch, arguments.settings.back());
          if (!status.ok()) throw CLI::ValidationError(std::string(status.message()));
        };
        if constexpr (std::is_same_v<std::decay_t<decltype(member)>, bool>) {
          command
              .add_flag_function(
                  "--" + flag + ",!--no-" + flag,
                  [set](int64_t count) { set(count > 0 ? "true" : "false"); },
                  std::string(help))
              ->group(group);
        } else {
          command
              .add_option_function<std::string>(
                  "--" + flag + (name == "spacing_m" ? ",--spacing" : ""), set, std::string(help))
              ->type_name(internal::RangeOf(member, range))
              ->default_str(internal::ValueToText(member))
              ->group(group);
        }
      });
}

void AddStreet(CLI::App& synth, SelectedCommand& selected) {
  CLI::App* command =
      synth.add_subcommand("street", "Rendered panoramas of a street round a block");
  const auto arguments = std::make_shared<StreetArguments>();
  command->add_option("--size", arguments->size, "Width x height of a panorama")
      ->capture_default_str();
  command->add_flag("--realistic",
                    arguments->realistic,
                    "All that real streets have at once; the options below change single things");
  command
      ->add_option("--output",
                   arguments->output,
                   "Folder for images, masks, gnss.csv, truth.csv, surface.ply")
      ->required();
  AddStreetFields<StreetOptions>(*command, *arguments, "Street");
  AddStreetFields<StreetHardships>(*command, *arguments, "Hardships");
  command->footer(
      "Examples:\n"
      "  orbweave synth street --panoramas 48 --size 2048x1024 --output street\n"
      "  orbweave synth street --realistic --spacing 8 --panoramas 60 --output town\n"
      "  orbweave synth street --room --panoramas 36 --output room\n"
      "  orbweave synth street --standing --pedestrians 20 --panoramas 30 --output bus_stop\n"
      "  orbweave synth street --bus-ahead --daylight 0.1 --panoramas 60 --output behind_a_bus");
  command->callback([arguments, &selected] {
    selected.run = [arguments] { return ReportStatus(WriteRenderedStreet(*arguments)); };
  });
}

}  // namespace

void AddSynthCommand(CLI::App& app, SelectedCommand& selected) {
  CLI::App* command = app.add_subcommand("synth", "Make streets whose truth is known");
  command->require_subcommand(1);
  AddStreet(*command, selected);
  AddCorridor(*command, selected);
}

}  // namespace orbweave
