// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/mending/list_slides.h"

#include <cmath>
#include <span>
#include <utility>

#include "core/mapping/lengths/ask_gnss_of_ways.h"
#include "core/mapping/lengths/asked_rays.h"
#include "core/mapping/lengths/gap_votes.h"
#include "core/mapping/lengths/line_pieces.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// What is taken has to please GNSS clearly: here more may be listed.
constexpr double kListedBySigmas = 2.0;

/// A way that is off, and how far what lies behind it may have to be shifted along it.
struct OffWay {
  ImageSlot image = 0;
  ImageSlot next = 0;
  std::vector<double> shifts{};
};

std::vector<OffWay> FindOffWays(const AskedRays& asked, const GnssWays& gnss) {
  std::vector<OffWay> off;
  for (const GapVotes& gap : CollectGapVotes(asked)) {
    const GnssWay* const way = gnss.WayToNext(gap.image, gap.next);
    if (way == nullptr || std::abs(way->Misfit(asked.state)) < kListedBySigmas) continue;
    off.push_back({gap.image, gap.next, ShiftsByGnss(asked, gap, *way)});
  }
  return off;
}

class SlideLister {
 public:
  SlideLister(const MappingState& state, const MappingOptions& options)
      : state_(state), pieces_(state, options) {}

  std::vector<CandidateMove> Run(std::span<const OffWay> ways) {
    for (size_t i = 0; i < ways.size(); ++i) {
      const OffWay* const last = i > 0 ? &ways[i - 1] : nullptr;
      const OffWay* const following = i + 1 < ways.size() ? &ways[i + 1] : nullptr;
      for (const double shift : ways[i].shifts) AddSlides(ways[i], shift, last, following);
    }
    return std::move(moves_);
  }

 private:
  void AddSlides(const OffWay& way, double shift, const OffWay* last, const OffWay* following) {
    const Vector3d by = shift * (state_.Centre(way.next) - state_.Centre(way.image)).normalized();
    Add(pieces_.From(way.next), by);
    if (following != nullptr && pieces_.AreOfOneLine(following->image, way.image))
      Add(pieces_.Between(way.next, following->image), by);
    if (last != nullptr && pieces_.AreOfOneLine(last->next, way.image))
      Add(pieces_.Between(last->next, way.image), -by);
    Add({way.next}, by);
    Add({way.image}, -by);
  }

  void Add(const std::vector<ImageSlot>& images, const Vector3d& by) {
    moves_.push_back(Shifted(state_, images, by));
  }

  const MappingState& state_;
  LinePieces pieces_;
  std::vector<CandidateMove> moves_{};
};

}  // namespace

std::vector<CandidateMove> ListSlides(const MappingState& state,
                                      const MappingOptions& options,
                                      const GnssWays& gnss) {
  return SlideLister(state, options).Run(FindOffWays({state, options}, gnss));
}

}  // namespace orbweave
