// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

namespace orbweave {

/// Declares `--root NAME=FOLDER`, repeatable. Folders become absolute; s3://... stays as it is.
void AddRootArgument(CLI::App& command,
                     std::map<std::string, std::string>& roots,
                     const std::string& help);

}  // namespace orbweave
