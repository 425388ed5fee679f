// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/synthetic/random_for_street.h"

namespace orbweave {

Random RandomForStreet(const StreetOptions& options, const std::string& purpose, size_t i) {
  return Random("street/" + std::to_string(options.seed) + "/" + purpose + "/" + std::to_string(i));
}

}  // namespace orbweave
