// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace orbweave {

/// Whether matches that come first are likelier to be right than those after them.
enum class MatchOrder { kUnknown, kBestFirst };

}  // namespace orbweave
