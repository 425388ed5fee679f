// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace orbweave {

/// Which file is the mask of an image, by their names, upper and lower case alike. The mask of
/// `a/b.jpg` is `a/b.jpg.png`, else `a/b.png`, else `a/b.jpg`; else, of all that lies in a folder,
/// `a.png`: what a drive carries along is drawn once.
class MaskNames {
 public:
  MaskNames() = default;  ///< no masks
  /// Files of the place of masks.
  explicit MaskNames(const std::vector<std::string>& files);
  /// One file for all images.
  [[nodiscard]] static MaskNames OneForAll(const std::string& file);

  /// The file that is the mask of an image; empty: it has none.
  [[nodiscard]] std::string TakeFor(const std::string& image_name);
  /// Those that no image has taken.
  [[nodiscard]] std::vector<std::string> Unused() const;

 private:
  [[nodiscard]] std::string Find(const std::string& image_name) const;

  std::map<std::string, std::string> files_{};  ///< by their name in lower case
  std::string for_all_{};
  std::set<std::string> used_{};
};

}  // namespace orbweave
