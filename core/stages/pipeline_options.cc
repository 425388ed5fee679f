// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/stages/pipeline_options.h"

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"

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
  const size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) {
    return absl::InvalidArgumentError("'" + std::string(assignment) +
                                      "' is not of the form section.key=value");
  }
  const std::string name(absl::StripAsciiWhitespace(std::string(assignment.substr(0, equals))));
  const std::string value(absl::StripAsciiWhitespace(std::string(assignment.substr(equals + 1))));
  const size_t dot = name.find('.');
  if (dot == std::string::npos) return UnknownOption(name);
  absl::Status status = absl::NotFoundError(name);
  PipelineOptions::VisitSections(options, [&](std::string_view section, auto& fields) {
    if (section == std::string_view(name).substr(0, dot))
      status = SetOption(fields, name.substr(dot + 1), value);
  });
  if (absl::IsNotFound(status)) return UnknownOption(name);
  return Annotate(status, name);
}

absl::StatusOr<PipelineOptions> PipelineOptionsFromText(std::string_view text,
                                                        std::string_view source,
                                                        PipelineOptions options) {
  int line_number = 0;
  for (const absl::string_view raw :
       absl::StrSplit(absl::string_view(text.data(), text.size()), '\n')) {
    ++line_number;
    const absl::string_view line = absl::StripAsciiWhitespace(raw);
    if (line.empty() || line.front() == '#') continue;
    ORBWEAVE_RETURN_IF_ERROR(
        Annotate(SetPipelineOption(options, std::string_view(line.data(), line.size())),
                 absl::StrCat(std::string(source), " line ", line_number)));
  }
  return options;
}

}  // namespace orbweave
