// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exiv2/exiv2.hpp>
#include <string>
#include <utility>
#include <vector>

namespace orbweave {

/// `encoded` with EXIF and XMP keys set to the values given as text.
inline std::string Tagged(const std::string& encoded,
                          const std::vector<std::pair<std::string, std::string>>& exif,
                          const std::vector<std::pair<std::string, std::string>>& xmp = {}) {
  const auto image = Exiv2::ImageFactory::open(reinterpret_cast<const Exiv2::byte*>(encoded.data()),
                                               static_cast<long>(encoded.size()));
  image->readMetadata();
  for (const auto& [key, value] : exif) {
    if (!value.starts_with('-')) {
      image->exifData()[key] = value;
      continue;
    }
    Exiv2::RationalValue negative;  // which the type that belongs to the key may not be
    negative.read(value);
    image->exifData()[key].setValue(&negative);
  }
  for (const auto& [key, value] : xmp) image->xmpData()[key] = value;
  image->writeMetadata();
  Exiv2::BasicIo& io = image->io();
  io.open();
  std::string bytes(io.size(), '\0');
  io.read(reinterpret_cast<Exiv2::byte*>(bytes.data()), static_cast<long>(bytes.size()));
  return bytes;
}

}  // namespace orbweave
