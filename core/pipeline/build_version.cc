// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/build_version.h"

namespace orbweave {

std::string_view BuildVersion() { return ORBWEAVE_VERSION; }

}  // namespace orbweave
