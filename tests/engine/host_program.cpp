// SPDX-License-Identifier: MIT
#include "host_program.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb/stb_image.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace host_program {

double mean(const Picture& picture, const Region& region, int channel) {
  double sum = 0;
  for (int y = region.y0; y < region.y1; ++y) {
    for (int x = region.x0; x < region.x1; ++x) {
      sum += picture.at(x, y, channel);
    }
  }
  return sum / ((region.x1 - region.x0) * (region.y1 - region.y0));
}

double mean(const Picture& picture, const Region& region) {
  return (mean(picture, region, RED) + mean(picture, region, GREEN) + mean(picture, region, BLUE)) /
         3.0;
}

Picture cut(const Picture& picture, const Region& region) {
  Picture part{region.x1 - region.x0, region.y1 - region.y0, {}};
  for (int y = region.y0; y < region.y1; ++y) {
    const auto row = picture.rgb.begin() + 3 * static_cast<ptrdiff_t>(y) * picture.width;
    part.rgb.insert(part.rgb.end(), row + 3 * region.x0, row + 3 * region.x1);
  }
  return part;
}

int largestDifference(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height) {
    return 256;
  }
  int largest = 0;
  for (size_t i = 0; i < a.rgb.size(); ++i) {
    largest = std::max(largest, std::abs(int{a.rgb[i]} - int{b.rgb[i]}));
  }
  return largest;
}

int runProgram(const std::string& program, const std::string& arguments) {
  const int status = std::system((program + " " + arguments).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int runWindow(const std::string& arguments) {
  return runProgram(WELKIN_WINDOW, arguments);
}

std::string size(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

std::string temporary(const std::string& name) {
  const std::string file =
      testing::TempDir() + "welkin_host_" + std::to_string(getpid()) + "_" + name;
  std::remove(file.c_str());
  return file;
}

Picture readPicture(const std::string& file) {
  Picture picture;
  int channels = 0;
  unsigned char* data = stbi_load(file.c_str(), &picture.width, &picture.height, &channels, 3);
  if (data == nullptr) {
    ADD_FAILURE() << file << ": " << stbi_failure_reason();
    return picture;
  }
  picture.rgb.assign(data, data + size_t{3} * static_cast<size_t>(picture.width) *
                                      static_cast<size_t>(picture.height));
  stbi_image_free(data);
  std::remove(file.c_str());
  return picture;
}

std::vector<Report> reports(const std::string& arguments) {
  std::FILE* output = popen((std::string(WELKIN_WINDOW) + " " + arguments).c_str(), "r");
  if (output == nullptr) {
    ADD_FAILURE() << arguments;
    return {};
  }
  std::vector<Report> result;
  std::array<char, 1024> line{};
  while (std::fgets(line.data(), line.size(), output) != nullptr) {
    std::istringstream words(line.data());
    Report report;
    for (std::string word; words >> word;) {
      const size_t equals = word.find('=');
      report[word.substr(0, equals)] = equals == std::string::npos ? "" : word.substr(equals + 1);
    }
    result.push_back(report);
  }
  const int status = pclose(output);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << arguments;
  return result;
}

double number(const Report& report, const std::string& name) {
  const auto found = report.find(name);
  if (found == report.end()) {
    ADD_FAILURE() << "no " << name << " in the report";
    return -1.0;
  }
  return std::atof(found->second.c_str());
}

}  // namespace host_program
