// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <exiv2/exiv2.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/fuzz/seeds.h"

namespace orbweave {
namespace {

std::string Encoded(const std::string& extension) {
  cv::Mat image(16, 32, CV_8UC3);
  for (int i = 0; i < image.rows * image.cols * 3; ++i)
    image.data[i] = static_cast<uint8_t>(i * i / 7);
  std::vector<uint8_t> bytes;
  cv::imencode(extension, image, bytes);
  return {bytes.begin(), bytes.end()};
}

/// The same with where, when and which way it was taken.
std::string WithMetadata(const std::string& encoded) {
  const auto image = Exiv2::ImageFactory::open(reinterpret_cast<const Exiv2::byte*>(encoded.data()),
                                               static_cast<long>(encoded.size()));
  Exiv2::ExifData exif;
  exif["Exif.GPSInfo.GPSLatitude"] = "47/1 30/1 0/1";
  exif["Exif.GPSInfo.GPSLatitudeRef"] = "S";
  exif["Exif.GPSInfo.GPSLongitude"] = "8/1 30/1 1/2";
  exif["Exif.GPSInfo.GPSLongitudeRef"] = "E";
  exif["Exif.GPSInfo.GPSAltitude"] = "400/1";
  exif["Exif.GPSInfo.GPSHPositioningError"] = "3/2";
  exif["Exif.Photo.DateTimeOriginal"] = "2016:11:13 11:16:31";
  exif["Exif.Photo.SubSecTimeOriginal"] = "5";
  image->setExifData(exif);
  Exiv2::XmpData xmp;
  xmp["Xmp.GPano.PoseHeadingDegrees"] = "90.5";
  image->setXmpData(xmp);
  image->writeMetadata();
  const Exiv2::DataBuf written = image->io().read(static_cast<long>(image->io().size()));
  return {reinterpret_cast<const char*>(written.pData_), static_cast<size_t>(written.size_)};
}

}  // namespace

void AddImageSeeds(Seeds& seeds) {
  std::vector<std::string> images;
  for (const char* extension : {".jpg", ".png", ".tiff", ".bmp", ".webp", ".ppm"})
    images.push_back(Encoded(extension));
  images.push_back(WithMetadata(images[0]));
  for (const char* target : {"image_header", "image_metadata", "panorama", "mask"})
    seeds[target] = images;
}

}  // namespace orbweave
