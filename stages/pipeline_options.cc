// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/pipeline_options.h"

#include "core/base/option_lines.h"

namespace orbweave {
namespace {

absl::Status UnknownOption(std::string_view given) {
  constexpr size_t kLongestShown = 80;
  const std::string_view name = given.substr(0, kLongestShown);
  std::vector<std::string> known;
  for (const OptionInfo& info : DescribePipelineOptions({})) known.push_back(info.name);
  return absl::InvalidArgumentError("there is no option '" + std::string(name) +
                                    "'; did you mean '" + NearestName(name, known) + "'?");
}

}  // namespace

std::string PipelineOptionsToText(const PipelineOptions& options) {
  std::string text;
  PipelineOptions::VisitSections(options, [&](std::string_view section, const auto& fields) {
    text += OptionsToText(section, fields);
  });
  return text;
}

std::vector<OptionInfo> DescribePipelineOptions(const PipelineOptions& options) {
  std::vector<OptionInfo> infos;
  PipelineOptions::VisitSections(options, [&](std::string_view section, const auto& fields) {
    for (OptionInfo& info : DescribeOptions(section, fields)) infos.push_back(std::move(info));
  });
  return infos;
}

absl::Status SetPipelineOption(PipelineOptions& options, std::string_view assignment) {
  ORBWEAVE_ASSIGN_OR_RETURN(const OptionAssignment given, ParseOptionAssignment(assignment));
  absl::Status status = absl::NotFoundError(given.name);
  PipelineOptions::VisitSections(options, [&](std::string_view section, auto& fields) {
    if (section == given.section()) status = SetOption(fields, given.key(), given.value);
  });
  if (absl::IsNotFound(status)) return UnknownOption(given.name);
  return Annotate(status, given.name);
}

absl::StatusOr<PipelineOptions> PipelineOptionsFromText(std::string_view text,
                                                        std::string_view source,
                                                        PipelineOptions options) {
  ORBWEAVE_RETURN_IF_ERROR(ForEachOptionLine(
      text, source, [&](std::string_view line) { return SetPipelineOption(options, line); }));
  return options;
}

}  // namespace orbweave
