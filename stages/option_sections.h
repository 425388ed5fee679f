// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <string>
#include <tuple>
#include <vector>

#include "core/base/option_lines.h"
#include "stages/pipeline_options.h"

namespace orbweave {

/// The name of the section that an algorithm's options are. Options of an algorithm that is not one
/// of PipelineOptions have a specialisation. CHECK: there is such a section.
template <typename Options>
struct SectionName {
  static std::string Get() {
    std::string name;
    const PipelineOptions all;
    PipelineOptions::VisitSections(all, [&](std::string_view section, const auto& fields) {
      if constexpr (std::same_as<std::remove_cvref_t<decltype(fields)>, Options>) name = section;
    });
    ORBWEAVE_CHECK(!name.empty());
    return name;
  }
};

/// The sections that a stage declares: it can read no others, and a change of one of these runs it
/// again.
template <typename... Sections>
class OptionSections {
 public:
  [[nodiscard]] static std::vector<std::string> Names() {
    return {SectionName<Sections>::Get()...};
  }

  /// Does not compile for what the stage does not declare.
  template <typename Section>
  [[nodiscard]] const Section& Get() const {
    return std::get<Section>(values_);
  }

  /// From the text of a task. InvalidArgument: an unknown option, a bad value, or an option of a
  /// section that is not declared. `source` names the text in errors.
  [[nodiscard]] static absl::StatusOr<OptionSections> FromText(std::string_view text,
                                                               std::string_view source) {
    OptionSections sections;
    ORBWEAVE_RETURN_IF_ERROR(
        ForEachOptionLine(text, source, [&](std::string_view line) { return sections.Set(line); }));
    return sections;
  }

 private:
  absl::Status Set(std::string_view line) {
    ORBWEAVE_ASSIGN_OR_RETURN(const OptionAssignment given, ParseOptionAssignment(line));
    absl::Status status =
        absl::InvalidArgumentError("option " + given.name + " is not declared by the stage");
    const auto set_in = [&]<typename Section>(Section& fields) {
      if (SectionName<Section>::Get() == given.section())
        status = SetOption(fields, given.key(), given.value);
    };
    std::apply([&](auto&... fields) { (set_in(fields), ...); }, values_);
    return Annotate(status, given.name);
  }

  std::tuple<Sections...> values_{};
};

}  // namespace orbweave
