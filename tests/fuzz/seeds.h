// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

namespace orbweave {

/// Well-formed inputs by the name of the fuzz target: what its corpus begins with.
using Seeds = std::map<std::string, std::vector<std::string>>;

/// What stages leave behind.
void AddArtifactSeeds(Seeds& seeds);
/// What the subproblems of the global adjustment leave behind.
void AddAdjustmentSeeds(Seeds& seeds);
/// What the dense stages leave behind.
void AddDenseSeeds(Seeds& seeds);
/// Messages of the wire and between processes.
void AddMessageSeeds(Seeds& seeds);
/// Tables, options and addresses that people write.
void AddTextSeeds(Seeds& seeds);
/// Images of every kind that is read, tiny ones.
void AddImageSeeds(Seeds& seeds);
/// Certificates, keys and tokens.
void AddSecuritySeeds(Seeds& seeds);
/// Models and databases, written to `folder` on the way.
void AddFileSeeds(const std::string& folder, Seeds& seeds);

}  // namespace orbweave
