// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/task.h"

namespace orbweave {
namespace {

std::string_view BytesOf(const Digest& digest) {
  return {reinterpret_cast<const char*>(digest.bytes.data()), digest.bytes.size()};
}

}  // namespace

Digest TaskSpec::Id() const {
  DigestBuilder builder;
  builder.AddField("orbweave task").AddField(stage).AddField(version).AddField(options_text);
  for (const Digest& input : inputs) builder.AddField(BytesOf(input));
  return builder.Finish();
}

}  // namespace orbweave
