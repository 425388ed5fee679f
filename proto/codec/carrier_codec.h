// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/repeated_ptr_field.h>

#include <string>
#include <string_view>
#include <vector>

#include "core/base/status.h"
#include "core/scene/carrier.h"
#include "orbweave/v1/artifacts.pb.h"

namespace orbweave {

[[nodiscard]] absl::StatusOr<std::string> EncodeCarriers(const std::vector<Carrier>& carriers);
/// DataLoss: images or cells are not in order, or no such cells.
[[nodiscard]] absl::StatusOr<std::vector<Carrier>> DecodeCarriers(std::string_view bytes);

namespace codec {

using CarrierMessages = google::protobuf::RepeatedPtrField<v1::Carrier>;

void ToProto(const std::vector<Carrier>& carriers, CarrierMessages* proto);
/// The errors of DecodeCarriers.
[[nodiscard]] absl::StatusOr<std::vector<Carrier>> FromProto(const CarrierMessages& proto);

}  // namespace codec
}  // namespace orbweave
