// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stages/stage.h"

/// A stage that the product does not have, with its own type, codec and options. Nothing outside
/// this folder was touched for it but a line of a plan and one of a registry, those of toy_test.cc.

namespace orbweave {

struct ToyOptions {
  int32_t factor = 10;

  template <typename Self, typename Visitor>
  static void VisitFields(Self& self, Visitor&& visit) {
    visit("factor", self.factor, "what numbers are multiplied by", Range{1, 1000});
  }
};

template <>
struct SectionName<ToyOptions> {
  static std::string Get() { return "toy"; }
};

struct ToyNumber {
  int64_t value = 0;
};

template <>
struct Codec<ToyNumber> {
  static constexpr std::string_view kName = "toy_number";
  static std::string Encode(const ToyNumber& number) { return std::to_string(number.value); }
  /// InvalidArgument: no number.
  static absl::StatusOr<ToyNumber> Decode(std::string_view bytes);
};

/// A number -> as many recipes, 1, 2, 3, ... And what all came to in the round before.
struct ToyCountStage {
  static constexpr StageFacts kFacts{.name = "toy_count", .version = "1", .weight = 1.0};
  using Options = OptionSections<>;

  One<ToyNumber> number;
  RoundBefore<One<ToyNumber>> sum_before;
  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("number", &ToyCountStage::number);
    visit("sum_before", &ToyCountStage::sum_before);
  }

  struct Outputs {
    using Stage = ToyCountStage;
    Parts<ToyNumber> numbers{};
    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("numbers", &Outputs::numbers);
    }
  };

  static absl::Status Run(StageTask<ToyCountStage>& task);
};

/// A number -> the same times toy.factor.
struct ToyScaleStage {
  static constexpr StageFacts kFacts{.name = "toy_scale", .version = "1", .weight = 2.0};
  using Options = OptionSections<ToyOptions>;

  Parts<ToyNumber> number;
  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("number", &ToyScaleStage::number);
  }

  struct Outputs {
    using Stage = ToyScaleStage;
    EachPart<ToyNumber> number{};
    EachPart<ToyNumber> scaled{};
    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("number", &Outputs::number);
      visit("scaled", &Outputs::scaled);
    }
  };

  static absl::Status Run(StageTask<ToyScaleStage>& task);
};

/// Scaled numbers -> their sum; goes on with another round as long as that is below 1000.
struct ToySumStage {
  static constexpr StageFacts kFacts{.name = "toy_sum", .version = "1", .weight = 1.0};
  using Options = OptionSections<>;

  EachPart<ToyNumber> scaled;
  RoundBefore<One<ToyNumber>> before;
  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("scaled", &ToySumStage::scaled);
    visit("before", &ToySumStage::before);
  }

  struct Outputs {
    using Stage = ToySumStage;
    One<ToyNumber> sum{};
    Parts<ToyNumber> another_round{};
    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("sum", &Outputs::sum);
      visit("another_round", &Outputs::another_round);
    }
  };

  static absl::Status Run(StageTask<ToySumStage>& task);
};

}  // namespace orbweave
