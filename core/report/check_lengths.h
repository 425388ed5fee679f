// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/report/job_results.h"
#include "core/scene/cross_check.h"

namespace orbweave {

/// "step_lengths": whether the rays that several pairs share bear out how long the steps between
/// panoramas are (MeasurePairLengths, MeasureGapLengths), for which no GNSS is needed. Where houses
/// repeat, a piece of the street that stands a house too far along has nearly all its matches with
/// it; what the others' rays say of lengths speaks against it (FindLengthFaults). Rays that take
/// one house for the next may also be more than those that are right: no fault are a way that a
/// crowd of rays or GNSS bears out (GapLength::is_borne_out), unless its sides stand askew, and an
/// image all of whose ways are such. Pairs and ways within one model are asked; one of two clusters
/// by the one that speaks for it less. Doubtful with a fault, bad where two images or more are at
/// fault and one in fifty: a tear may be the pairs' that lead across it. In a model that no GNSS
/// holds, doubtful too where one wall of the street says another length (GapLength::wall), or less
/// than half as many rays agree with one step as is usual, unless a crowd of 36 bears it out, which
/// tells a length to a hundredth. Value: the smallest share of rays that agrees, where there is a
/// fault.
[[nodiscard]] CrossCheck CheckLengths(const JobResults& results);

}  // namespace orbweave
