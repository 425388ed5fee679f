// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "core/base/status.h"
#include "core/scene/image_manifest.h"

namespace orbweave {

/// The image that a person means by `text`: its name; or what only one name is when its folders,
/// its ending, or both are left out; or the number that only one name ends in (12 for 00012.jpg);
/// or what only one name ends in. InvalidArgument: several do, and which; or it takes no part in
/// the job, and why. NotFound: none does, with the nearest name.
[[nodiscard]] absl::StatusOr<ImageId> FindImage(const ImageManifest& manifest,
                                                std::string_view text);

}  // namespace orbweave
