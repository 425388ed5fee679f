// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/synthetic/street_options.h"

namespace orbweave {

/// The options with every hardship of a town's street at once, each as strong as mapping cars meet
/// it. Number, size and spacing of the panoramas and the seed stay.
[[nodiscard]] StreetOptions RealisticStreet(StreetOptions options);

/// The options of a room that a camera is carried through, 0.7 m between panoramas, with the
/// positions a telephone gives indoors.
[[nodiscard]] StreetOptions RoomOptions(StreetOptions options);

}  // namespace orbweave
