// SPDX-License-Identifier: MIT
// The hosts with a window in a virtual display: no validation message, a picture in the file, and
// the same picture from every composite mode.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

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

namespace {

constexpr int WIDTH = 320;
constexpr int HEIGHT = 180;

int runProgram(const std::string& program, const std::string& arguments) {
  const int status = std::system((program + " " + arguments).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}
int run(const std::string& arguments) {
  return runProgram(WELKIN_WINDOW, arguments);
}

// RGB bytes of a file, which is removed.
std::vector<unsigned char> readPicture(const std::string& file, int expectedWidth,
                                       int expectedHeight) {
  int width = 0;
  int height = 0;
  int channels = 0;
  unsigned char* data = stbi_load(file.c_str(), &width, &height, &channels, 3);
  std::vector<unsigned char> pixels;
  if (data != nullptr) {
    pixels.assign(data,
                  data + size_t{3} * static_cast<size_t>(width) * static_cast<size_t>(height));
    stbi_image_free(data);
  }
  EXPECT_EQ(width, expectedWidth);
  EXPECT_EQ(height, expectedHeight);
  std::remove(file.c_str());
  return pixels;
}

// RGB bytes of a screenshot after a few frames, under validation.
std::vector<unsigned char> screenshot(const std::string& mode, const std::string& more = "") {
  const std::string file =
      testing::TempDir() + "welkin_window_" + mode + "_" + std::to_string(getpid()) + ".png";
  std::remove(file.c_str());
  const std::string size = std::to_string(WIDTH) + "x" + std::to_string(HEIGHT);
  EXPECT_EQ(run("--validate --quality low --frames 4 --composite " + mode + " --size " + size +
                " --screenshot " + file + " " + more),
            0)
      << mode;
  return readPicture(file, WIDTH, HEIGHT);
}

TEST(WindowSample, EveryCompositeModeShowsTheSamePictureWithoutAMessage) {
  if (std::string(WELKIN_WINDOW).empty()) {
    GTEST_SKIP() << "no window sample or no xvfb-run in this build";
  }
  const std::vector<unsigned char> compute = screenshot("compute");
  ASSERT_FALSE(compute.empty());
  double top = 0;
  double bottom = 0;
  const size_t half = compute.size() / 2;
  for (size_t i = 0; i < half; ++i) {
    top += compute[i];
    bottom += compute[half + i];
  }
  // Daylight: sky above, a darker meadow below, neither black nor white.
  EXPECT_GT(top / static_cast<double>(half), 80.0);
  EXPECT_LT(top / static_cast<double>(half), 240.0);
  EXPECT_GT(bottom / static_cast<double>(half), 30.0);
  EXPECT_LT(bottom, top);
  for (const char* mode : {"blend", "separate"}) {
    const std::vector<unsigned char> picture = screenshot(mode);
    ASSERT_EQ(picture.size(), compute.size()) << mode;
    int worst = 0;
    for (size_t i = 0; i < compute.size(); ++i) {
      worst = std::max(worst, std::abs(int{picture[i]} - int{compute[i]}));
    }
    // Half-float rounding (2^-10) moves an 8-bit value by less than one step, plus its rounding.
    EXPECT_LE(worst, 2) << mode;
  }
}

TEST(WindowSample, ThePanelLiesOverThePictureAndChangesNothingBesides) {
  if (std::string(WELKIN_WINDOW).empty()) {
    GTEST_SKIP() << "no window sample or no xvfb-run in this build";
  }
  // The panel is 380 pixels wide.
  const auto wide = [](const std::string& more) {
    const std::string file = testing::TempDir() + "welkin_window_wide.png";
    EXPECT_EQ(
        run("--validate --quality low --frames 4 --size 640x360 --screenshot " + file + " " + more),
        0);
    return readPicture(file, 640, 360);
  };
  const std::vector<unsigned char> without = wide("");
  const std::vector<unsigned char> with = wide("--panel");
  ASSERT_EQ(without.size(), size_t{3} * 640 * 360);
  ASSERT_EQ(with.size(), without.size());
  size_t left = 0;
  size_t right = 0;
  for (size_t i = 0; i < with.size(); ++i) {
    const size_t x = i / 3 % 640;
    left += x < 380 && with[i] != without[i] ? 1u : 0u;
    right += x >= 390 && with[i] != without[i] ? 1u : 0u;
  }
  EXPECT_GT(left, size_t{3} * 300 * 200) << "most of the panel's area";
  EXPECT_EQ(right, 0u);
}

TEST(WindowSample, ShowsASceneFileAndKeepsABudget) {
  if (std::string(WELKIN_WINDOW).empty()) {
    GTEST_SKIP() << "no window sample or no xvfb-run in this build";
  }
  const std::string scene = std::string("--scene ") + WELKIN_SCENES + "/clear-day.json";
  const std::vector<unsigned char> own = screenshot("compute");
  const std::vector<unsigned char> loaded = screenshot("compute", scene + " --budget 20");
  ASSERT_EQ(loaded.size(), own.size());
  EXPECT_NE(loaded, own);
}

// A mesh with detail in the engine's frames: white in the middle of a blue sky.
TEST(WindowSample, ShowsACloudBoundedByAMesh) {
  if (std::string(WELKIN_WINDOW).empty()) {
    GTEST_SKIP() << "no window sample or no xvfb-run in this build";
  }
  const std::vector<unsigned char> pixels =
      screenshot("compute", std::string("--scene ") + WELKIN_SCENES + "/surface-cumulus.json");
  ASSERT_FALSE(pixels.empty());
  const auto red = [&](int x, int y) { return pixels[3 * static_cast<size_t>(y * WIDTH + x)]; };
  EXPECT_GT(red(WIDTH / 2, HEIGHT / 2), 180);
  EXPECT_LT(red(WIDTH / 8, HEIGHT / 8), 120);
}

double mean(const std::vector<unsigned char>& pixels, int fromRow, int toRow, int channel) {
  double sum = 0;
  int count = 0;
  for (int y = fromRow; y < toRow; ++y) {
    for (int x = 0; x < WIDTH; ++x, ++count) {
      sum += pixels[3 * static_cast<size_t>(y * WIDTH + x) + static_cast<size_t>(channel)];
    }
  }
  return sum / count;
}

// z up, left-handed, 24-bit depth, two views, three frames in flight, a shared queue.
TEST(QtSample, ShowsSkyAboveMeadowWithoutAMessage) {
  if (std::string(WELKIN_QT).empty()) {
    GTEST_SKIP() << "no Qt sample or no xvfb-run in this build";
  }
  const std::string file = testing::TempDir() + "welkin_qt.png";
  const std::string size = std::to_string(WIDTH) + "x" + std::to_string(HEIGHT);
  ASSERT_EQ(runProgram(WELKIN_QT, "--validate --quality low --frames 5 --size " + size +
                                      " --screenshot " + file),
            0);
  const std::vector<unsigned char> pixels = readPicture(file, WIDTH, HEIGHT);
  ASSERT_FALSE(pixels.empty());
  constexpr int RED = 0;
  constexpr int GREEN = 1;
  constexpr int BLUE = 2;
  // A blue sky at the top; grass, green before blue, at the bottom; neither black nor white.
  EXPECT_GT(mean(pixels, 0, 20, BLUE), mean(pixels, 0, 20, RED) + 20.0);
  EXPECT_LT(mean(pixels, 0, 20, BLUE), 250.0);
  EXPECT_GT(mean(pixels, HEIGHT - 20, HEIGHT, GREEN), mean(pixels, HEIGHT - 20, HEIGHT, BLUE) + 20);
}

TEST(QtSample, BadOptionsAreErrors) {
  if (std::string(WELKIN_QT).empty()) {
    GTEST_SKIP() << "no Qt sample or no xvfb-run in this build";
  }
  EXPECT_NE(runProgram(WELKIN_QT, "--quality best >/dev/null 2>&1"), 0);
  EXPECT_NE(runProgram(WELKIN_QT, "--screenshot a.png >/dev/null 2>&1"), 0);
}

TEST(WindowSample, BadOptionsAreErrors) {
  if (std::string(WELKIN_WINDOW).empty()) {
    GTEST_SKIP() << "no window sample or no xvfb-run in this build";
  }
  EXPECT_NE(run("--composite sideways 2>/dev/null"), 0);
  EXPECT_NE(run("--size 12 2>/dev/null"), 0);
  EXPECT_NE(run("--scene missing.json 2>/dev/null"), 0);
  EXPECT_NE(run("--screenshot a.png 2>/dev/null"), 0) << "a screenshot needs --frames";
}

}  // namespace
