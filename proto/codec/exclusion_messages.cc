// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/exclusion_messages.h"

namespace orbweave::codec {

void ToProto(const std::vector<Exclusion>& exclusions, ExclusionMessages* proto) {
  for (const Exclusion& exclusion : exclusions) {
    v1::Exclusion* out = proto->Add();
    out->set_name(exclusion.name);
    out->set_reason(exclusion.reason);
  }
}

std::vector<Exclusion> FromProto(const ExclusionMessages& proto) {
  std::vector<Exclusion> exclusions;
  for (const v1::Exclusion& exclusion : proto)
    exclusions.push_back({exclusion.name(), exclusion.reason()});
  return exclusions;
}

}  // namespace orbweave::codec
