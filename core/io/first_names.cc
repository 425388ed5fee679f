// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/first_names.h"

#include <algorithm>

#include "absl/strings/str_cat.h"

namespace orbweave {

std::string FirstNames(const std::vector<std::string>& names, size_t shown) {
  std::string text;
  for (size_t i = 0; i < std::min(names.size(), shown); ++i)
    absl::StrAppend(&text, i == 0 ? "" : ", ", names[i]);
  return names.size() > shown ? text + ", ..." : text;
}

}  // namespace orbweave
