// SPDX-License-Identifier: MIT
#include "cli/scene_options.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "common/error.hpp"

namespace cli {

host::Scene readSizedScene(const std::string& file, std::vector<std::string> assignments,
                           const std::string& size) {
  if (!size.empty()) {
    const size_t cross = size.find('x');
    if (cross == std::string::npos) {
      throw host::InputError("command line", "--size", "expected WxH, for example 1280x720");
    }
    assignments.push_back("view.size=[" + size.substr(0, cross) + "," + size.substr(cross + 1) +
                          "]");
  }
  return host::parseScene(host::readSceneJson(file, assignments), file);
}

void checkFolders(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    const std::filesystem::path folder = std::filesystem::path(file).parent_path();
    std::error_code error;
    if (!folder.empty() && !std::filesystem::is_directory(folder, error)) {
      throw host::InputError(file, "", "expected an existing folder");
    }
  }
}

double pngStops(const host::Scene& scene) {
  return scene.png.exposureStops - std::log2(scene.camera.preExposure);
}

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  if (terminal_) {
    std::fprintf(stderr, "\r\033[K");
  }
}

void ProgressLine::show(const std::string& text) const {
  if (terminal_) {
    std::fprintf(stderr, "\r\033[K%s ...", text.c_str());
  }
}

void ProgressLine::show(double part) {
  const int percent = static_cast<int>(100.0 * part);
  if (percent != percent_) {
    percent_ = percent;
    show(std::to_string(percent) + " %");
  }
}

}  // namespace cli
