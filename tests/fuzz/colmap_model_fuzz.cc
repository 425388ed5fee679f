// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/colmap/colmap_model.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/temporary_folder.h"

FUZZ_TARGET(colmap_model) {
  // cameras.bin, images.bin and points3D.bin one after the other, each behind its size.
  static const orbweave::TemporaryFolder folder;
  std::string_view rest = orbweave::BytesOf(data, size);
  for (const char* name : {"cameras.bin", "images.bin", "points3D.bin"}) {
    const std::string_view head = rest.substr(0, 2);
    const size_t length = head.size() < 2 ? 0
                                          : static_cast<uint8_t>(head[0]) * size_t{256} +
                                                static_cast<uint8_t>(head[1]);
    rest.remove_prefix(head.size());
    folder.Write(name, rest.substr(0, length));
    rest.remove_prefix(std::min(length, rest.size()));
  }
  const auto model = orbweave::ReadColmapModel(folder.path());
  if (!model.ok()) return;
  for (const orbweave::ColmapCamera& camera : model->cameras)
    ORBWEAVE_CHECK(camera.camera.width_px > 0 && camera.camera.height_px > 0);
}
