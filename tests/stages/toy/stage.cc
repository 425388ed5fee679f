// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/stages/toy/stage.h"

#include "absl/strings/numbers.h"

namespace orbweave {

absl::StatusOr<ToyNumber> Codec<ToyNumber>::Decode(std::string_view bytes) {
  ToyNumber number;
  if (absl::SimpleAtoi(std::string(bytes), &number.value)) return number;
  return absl::InvalidArgumentError("'" + std::string(bytes) + "' is no number");
}

absl::Status ToyCountStage::Run(StageTask<ToyCountStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ToyNumber number, task.Read(&ToyCountStage::number));
  ORBWEAVE_ASSIGN_OR_RETURN(const ToyNumber before, task.Read(&ToyCountStage::sum_before));
  for (int64_t k = 1; k <= number.value; ++k)
    ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::numbers, ToyNumber{before.value + k}));
  return absl::OkStatus();
}

absl::Status ToyScaleStage::Run(StageTask<ToyScaleStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ToyNumber number, task.Read(&ToyScaleStage::number));
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::number, number).status());
  const ToyNumber scaled{number.value * task.options<ToyOptions>().factor};
  return task.Leave(&Outputs::scaled, scaled).status();
}

absl::Status ToySumStage::Run(StageTask<ToySumStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<ToyNumber> scaled,
                            task.ReadAll(&ToySumStage::scaled));
  ORBWEAVE_ASSIGN_OR_RETURN(ToyNumber sum, task.Read(&ToySumStage::before));
  for (const ToyNumber& number : scaled) sum.value += number.value;
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::sum, sum).status());
  if (sum.value >= 1000) return absl::OkStatus();
  return task.Leave(&Outputs::another_round, sum);
}

}  // namespace orbweave
