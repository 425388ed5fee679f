// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "cli/arguments/option_arguments.h"
#include "cli/arguments/store_argument.h"
#include "core/io/images/scan_image_folder.h"

namespace orbweave {

/// The arguments that say which images, masks and positions a job is made of.
inline void AddImageArguments(CLI::App& command, ScanRequest& request) {
  command
      .add_option("IMAGES",
                  request.image_folder,
                  "Folder of equirectangular (2:1) images, or "
                  "s3://BUCKET[/PREFIX][?endpoint=https://HOST[:PORT]][&region=R]")
      ->required();
  command.add_option("--gnss",
                     request.gnss_table,
                     "Positions: CSV with name,latitude,longitude,altitude[,accuracy,"
                     "vertical_accuracy,fix,time,drive,heading,pitch,roll,heading_accuracy,"
                     "pitch_accuracy,roll_accuracy], or POS.txt; a file, or s3://BUCKET/KEY");
  command.add_option(
      "--masks",
      request.masks,
      "Folder of masks, each named like its image or like a folder of images, or one "
      "file for all images; or s3://BUCKET/PREFIX");
  AddStoreKeysArgument(command, request.store_keys);
  command
      .add_option("--mask-ignores",
                  request.mask_ignores_white,
                  "Which pixels of a mask are not used: white or black")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, bool>{{"white", true}, {"black", false}}))
      ->type_name("white|black")
      ->default_str("white");
}

/// What altitudes are counted from, as one more option of the job.
inline void AddHeightArgument(CLI::App& command, OptionArguments& options) {
  command
      .add_option_function<std::string>(
          "--height",
          [&options](const std::string& datum) {
            options.sets.push_back("ingest.height=" + datum);
          },
          "What altitudes are counted from (egm96, egm2008: above the sea; needs a geoid of "
          "GeographicLib)")
      ->check(CLI::IsMember({"ellipsoid", "egm96", "egm2008"}))
      ->type_name("ellipsoid|egm96|egm2008")
      ->default_str("ellipsoid");
}

/// Clusters by hand.
inline void AddClustersArgument(CLI::App& command, std::string& cluster_table) {
  command.add_option("--clusters",
                     cluster_table,
                     "Clusters by hand instead of automatic ones: CSV with name,cluster, a row for "
                     "every image");
}

}  // namespace orbweave
