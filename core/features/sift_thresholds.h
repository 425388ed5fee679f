// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace orbweave {

struct SiftThresholds {
  double contrast = 0.02;
  double edge = 10.0;
};

}  // namespace orbweave
