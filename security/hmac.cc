// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/hmac.h"

#include <openssl/evp.h>
#include <openssl/hmac.h>

#include "core/base/status.h"

namespace orbweave {

std::string HmacSha256(std::string_view key, std::string_view text) {
  std::string mac(EVP_MAX_MD_SIZE, '\0');
  unsigned int size = 0;
  ORBWEAVE_CHECK(HMAC(EVP_sha256(),
                      key.data(),
                      static_cast<int>(key.size()),
                      reinterpret_cast<const unsigned char*>(text.data()),
                      text.size(),
                      reinterpret_cast<unsigned char*>(mac.data()),
                      &size) != nullptr);
  mac.resize(size);
  return mac;
}

}  // namespace orbweave
