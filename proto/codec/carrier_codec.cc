// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "proto/codec/carrier_codec.h"

#include "proto/codec/pack.h"
#include "proto/codec/plausible.h"

namespace orbweave {
namespace codec {

void ToProto(const std::vector<Carrier>& carriers, CarrierMessages* proto) {
  for (const Carrier& carrier : carriers) {
    v1::Carrier* out = proto->Add();
    out->set_images(Pack(carrier.images));
    out->set_cells(Pack(carrier.cells));
  }
}

absl::StatusOr<std::vector<Carrier>> FromProto(const CarrierMessages& proto) {
  std::vector<Carrier> carriers;
  for (const v1::Carrier& in : proto) {
    Carrier& carrier = carriers.emplace_back();
    ORBWEAVE_ASSIGN_OR_RETURN(carrier.images,
                              Unpack<ImageId>(in.images(), "images with a carrier"));
    ORBWEAVE_ASSIGN_OR_RETURN(carrier.cells, Unpack<uint32_t>(in.cells(), "cells of a carrier"));
    ORBWEAVE_RETURN_IF_ERROR(Expect(Ascends(carrier.images), "carrier", "images are not in order"));
    ORBWEAVE_RETURN_IF_ERROR(
        Expect(Ascends(carrier.cells) &&
                   (carrier.cells.empty() || carrier.cells.back() < kNumCarrierCells),
               "carrier",
               "no cells, or not in order"));
  }
  return carriers;
}

}  // namespace codec

absl::StatusOr<std::string> EncodeCarriers(const std::vector<Carrier>& carriers) {
  v1::Carriers proto;
  codec::ToProto(carriers, proto.mutable_carriers());
  return codec::Serialize(proto, "carriers", codec::Empty::kIsLegal);
}

absl::StatusOr<std::vector<Carrier>> DecodeCarriers(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::Carriers proto,
                            codec::Parse<v1::Carriers>(bytes, "carriers", codec::Empty::kIsLegal));
  return codec::FromProto(proto.carriers());
}

}  // namespace orbweave
