// SPDX-License-Identifier: MIT
// What the commands that draw a scene share: its file with options, output files, progress.
#pragma once

#include <string>
#include <vector>

#include "common/scene.hpp"

namespace cli {

/// The scene with `assignments` and then `size` (WxH in pixels, or empty). Throws InputError.
host::Scene readSizedScene(const std::string& file, std::vector<std::string> assignments,
                           const std::string& size);

/// Fails before the work, not after it, when the folder of an output file is missing; empty names
/// are no files. Throws InputError.
void checkFolders(const std::vector<std::string>& files);

/// Stops of a PNG, compensating preExposure, so that it does not change the picture.
double pngStops(const host::Scene& scene);

/// A line on the terminal that overwrites itself; silent elsewhere.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  void show(const std::string& text) const;
  /// Part done in percent, for long work.
  void show(double part);

 private:
  bool terminal_;
  int percent_ = -1;
};

}  // namespace cli
