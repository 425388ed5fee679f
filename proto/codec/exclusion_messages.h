// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/scene/image_manifest.h"
#include "orbweave/v1/artifacts.pb.h"

/// What was left out and why, which manifests and models hold.

namespace orbweave::codec {

using ExclusionMessages = google::protobuf::RepeatedPtrField<v1::Exclusion>;

void ToProto(const std::vector<Exclusion>& exclusions, ExclusionMessages* proto);
[[nodiscard]] std::vector<Exclusion> FromProto(const ExclusionMessages& proto);

}  // namespace orbweave::codec
