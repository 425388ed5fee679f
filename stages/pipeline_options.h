// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/options.h"
#include "core/bundle/bundle_options.h"
#include "core/dense/dense_options.h"
#include "core/dense/fuse_pixels.h"
#include "core/dense/select_sources.h"
#include "core/dense/tile_options.h"
#include "core/estimators/two_view_options.h"
#include "core/features/extract_features.h"
#include "core/features/match_options.h"
#include "core/features/retrieve_images.h"
#include "core/graph/build_view_graph.h"
#include "core/graph/pair_options.h"
#include "core/graph/partition_view_graph.h"
#include "core/mapping/model/mapping_options.h"
#include "core/merging/alignment/align_options.h"
#include "core/partitioned_ba/global_options.h"
#include "stages/ingest_images/ingest_options.h"

namespace orbweave {

/// Every option of the sparse and the dense line, one section per algorithm. The text form,
/// "section.key=value" lines, is what config files, `--set`, task names and the wire carry.
struct PipelineOptions {
  IngestOptions ingest{};
  ExtractOptions features{};
  RetrievalOptions retrieval{};
  PairOptions pairs{};
  MatchOptions matching{};
  TwoViewOptions two_view{};
  ViewGraphOptions view_graph{};
  PartitionOptions partition{};
  MappingOptions mapping{};
  AlignOptions align{};
  GlobalAdjustOptions global{};
  BundleOptions bundle{};
  DistributionOptions blocks{};
  SourceOptions sources{};
  DenseOptions dense{};
  FuseOptions fusion{};
  TileOptions tiles{};

  template <typename Self, typename Visitor>
  static void VisitSections(Self& self, Visitor&& visit) {
    visit("ingest", self.ingest);
    visit("features", self.features);
    visit("retrieval", self.retrieval);
    visit("pairs", self.pairs);
    visit("matching", self.matching);
    visit("two_view", self.two_view);
    visit("view_graph", self.view_graph);
    visit("partition", self.partition);
    visit("mapping", self.mapping);
    visit("align", self.align);
    visit("global", self.global);
    visit("bundle", self.bundle);
    visit("blocks", self.blocks);
    visit("sources", self.sources);
    visit("dense", self.dense);
    visit("fusion", self.fusion);
    visit("tiles", self.tiles);
  }
};

/// Canonical text of all sections.
[[nodiscard]] std::string PipelineOptionsToText(const PipelineOptions& options);

/// Every option with value, range and help, in section order.
[[nodiscard]] std::vector<OptionInfo> DescribePipelineOptions(const PipelineOptions& options);

/// Sets one option from "section.key=value". InvalidArgument names the option, what is wrong and,
/// for an unknown name, the nearest right one.
[[nodiscard]] absl::Status SetPipelineOption(PipelineOptions& options, std::string_view assignment);

/// Reads options from lines of "section.key=value"; blank lines and lines beginning with '#' are
/// skipped. `source` names the text in errors. What is missing stays as in `options`.
[[nodiscard]] absl::StatusOr<PipelineOptions> PipelineOptionsFromText(std::string_view text,
                                                                      std::string_view source,
                                                                      PipelineOptions options = {});

}  // namespace orbweave
