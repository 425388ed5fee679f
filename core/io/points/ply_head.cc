// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/points/ply_head.h"

#include "absl/strings/str_cat.h"

namespace orbweave {

std::string PlyHead(uint64_t num_points, std::string_view properties) {
  constexpr size_t kDigits = 20;
  const std::string count = absl::StrCat(num_points);
  return absl::StrCat("ply\nformat binary_little_endian 1.0\ncomment orbweave",
                      std::string(kDigits - count.size(), '.'),
                      "\nelement vertex ",
                      count,
                      "\nproperty double x\nproperty double y\nproperty double z\n",
                      std::string(properties),
                      "end_header\n");
}

}  // namespace orbweave
