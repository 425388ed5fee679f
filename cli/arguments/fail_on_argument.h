// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "core/base/status.h"
#include "core/scene/cross_check.h"

namespace orbweave {

/// The mildest level that is an error; absent: none is.
using FailOn = std::optional<CheckLevel>;

/// Declares --fail-on.
CLI::Option* AddFailOnArgument(CLI::App& command, FailOn& fail_on);

/// VerdictError when the verdict is `fail_on` or worse.
[[nodiscard]] absl::Status CheckVerdict(const Verdict& verdict, const FailOn& fail_on);

}  // namespace orbweave
