// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "proto/codec/pack.h"

/// Arrays of small matrices, column by column.

namespace orbweave::codec {

template <typename Matrix>
using MatrixBytes = std::array<double, Matrix::SizeAtCompileTime>;

template <typename Matrix>
std::string PackMatrices(const std::vector<Matrix>& matrices) {
  std::vector<MatrixBytes<Matrix>> arrays(matrices.size());
  for (size_t i = 0; i < matrices.size(); ++i)
    std::copy_n(matrices[i].data(), arrays[i].size(), arrays[i].begin());
  return Pack(arrays);
}

template <typename Matrix>
absl::StatusOr<std::vector<Matrix>> UnpackMatrices(const std::string& bytes,
                                                   size_t count,
                                                   const char* what) {
  ORBWEAVE_ASSIGN_OR_RETURN(const auto arrays,
                            UnpackExactly<MatrixBytes<Matrix>>(bytes, count, what));
  std::vector<Matrix> matrices(count);
  for (size_t i = 0; i < count; ++i)
    std::copy(arrays[i].begin(), arrays[i].end(), matrices[i].data());
  return matrices;
}

}  // namespace orbweave::codec
