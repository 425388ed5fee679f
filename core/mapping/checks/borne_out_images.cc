// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/borne_out_images.h"

#include <algorithm>

#include "core/mapping/checks/drop_off_scale_images.h"
#include "core/mapping/positioning/position_agreement.h"
#include "core/mapping/registration/step_witness.h"

namespace orbweave {

double BorneOutImages(const MappingState& state) {
  const std::vector<ImageSlot> off_scale = ImagesOffScale(state);
  const auto count = std::ranges::count_if(state.Registered(), [&](ImageSlot image) {
    return std::ranges::find(off_scale, image) == off_scale.end() &&
           !StepWitness(state, image).Contradicts(state.Centre(image));
  });
  return AgreementWithPositions(state).value_or(1.0) * static_cast<double>(count);
}

}  // namespace orbweave
