// SPDX-License-Identifier: MIT
// What the user does at the window sample's panel, by its scripts (--at), under validation: the
// clock, the clouds, the quality and its budget, scene files, pictures, the window's size.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "host_program.hpp"

namespace {

using namespace host_program;

// Light is spread over 8 frames (Atmosphere), and the frame of the change is the first.
constexpr int SETTLED = 9;

// Written as the command line wants it: what happens before each frame.
class Script {
 public:
  // Pictures that the script takes have this size until it changes the window's.
  explicit Script(int width = WIDTH, int height = HEIGHT) : size_(size(width, height)) {}

  Script& at(int frame, const std::string& action) {
    text_ += " --at " + std::to_string(frame) + ":" + action;
    last_ = std::max(last_, frame);
    return *this;
  }
  Script& option(const std::string& text) {
    text_ += " " + text;
    return *this;
  }
  Script& pictureAt(int frame) {
    files_.push_back(temporary(std::to_string(files_.size()) + ".png"));
    return at(frame, "screenshot=" + files_.back());
  }
  // What was printed. The pictures are there then.
  std::vector<Report> run() {
    std::vector<Report> result = reports("--validate --quality low --size " + size_ + " --frames " +
                                         std::to_string(last_) + text_);
    for (const std::string& file : files_) {
      pictures_.push_back(readPicture(file));
    }
    return result;
  }
  const Picture& picture(size_t index) const { return pictures_.at(index); }

 private:
  std::string size_;
  std::string text_;
  int last_ = 1;
  std::vector<std::string> files_;
  std::vector<Picture> pictures_;
};

std::string sceneFile(const std::string& name) {
  return WELKIN_SCENES "/" + name;
}

TEST(WindowSamplePanel, TheHourMovesTheSunFromRightToLeftAndTurnsItRedAndOff) {
  SKIP_WITHOUT(WELKIN_WINDOW);
  Script script;
  script.at(1, "hour=9").pictureAt(SETTLED);
  script.at(SETTLED + 1, "hour=15").pictureAt(2 * SETTLED);
  script.at(2 * SETTLED + 1, "hour=17.8").pictureAt(3 * SETTLED);
  script.at(3 * SETTLED + 1, "hour=22").pictureAt(4 * SETTLED);
  script.run();
  const Picture& morning = script.picture(0);
  const Picture& afternoon = script.picture(1);
  const Picture& evening = script.picture(2);
  const Picture& night = script.picture(3);
  // The ball in front, upper half, seen towards the north from 40 degrees south.
  const Region left{143, 150, 158, 165};
  const Region right{162, 150, 177, 165};
  EXPECT_GT(mean(morning, right), mean(morning, left) + 40.0);
  EXPECT_GT(mean(afternoon, left), mean(afternoon, right) + 40.0);
  const Region all{0, 0, WIDTH, HEIGHT};
  EXPECT_LT(mean(evening, all), 0.7 * mean(afternoon, all));
  EXPECT_LT(mean(night, all), 5.0);
  // Above the horizon.
  const Region low{0, 85, 60, 92};
  EXPECT_GT(mean(morning, low, BLUE), mean(morning, low, RED));
  EXPECT_GT(mean(evening, low, RED), mean(evening, low, BLUE) + 20.0);
}

TEST(WindowSamplePanel, DropletsAndExtinctionReachTheClouds) {
  SKIP_WITHOUT(WELKIN_WINDOW);
  Script script;
  script.pictureAt(SETTLED).at(SETTLED, "report");
  script.at(SETTLED + 1, "droplets=5").pictureAt(2 * SETTLED).at(2 * SETTLED, "report");
  script.at(2 * SETTLED + 1, "droplets=20").pictureAt(3 * SETTLED).at(3 * SETTLED, "report");
  script.at(3 * SETTLED + 1, "extinction=0.001").pictureAt(4 * SETTLED);
  script.at(4 * SETTLED + 1, "extinction=0.2").pictureAt(5 * SETTLED);
  const std::vector<Report> report = script.run();
  ASSERT_EQ(report.size(), 3u);
  // Welkin's own figure of the medium in use; the distribution's form is the same for all sizes.
  const double before = number(report[0], "droplet_radius_um");
  EXPECT_GT(before, 10.0) << "half of 20 um is the median, larger ones weigh more";
  EXPECT_NEAR(number(report[1], "droplet_radius_um"), 0.25 * before, 1e-3 * before);
  EXPECT_NE(script.picture(1), script.picture(0));
  EXPECT_EQ(number(report[2], "droplet_radius_um"), before);
  EXPECT_EQ(script.picture(2), script.picture(0)) << "back again";
  // The left cloud, before blue sky: thin enough to see through, or white.
  const Region cloud{85, 45, 115, 60};
  const auto whiteness = [&](size_t index) {
    return mean(script.picture(index), cloud, RED) - mean(script.picture(index), cloud, BLUE);
  };
  EXPECT_LT(whiteness(3), whiteness(0) - 20.0);
  EXPECT_GT(whiteness(4), whiteness(0));
  EXPECT_NEAR(whiteness(4), 0.0, 5.0);
}

TEST(WindowSamplePanel, QualityAndBudgetReachTheGovernor) {
  SKIP_WITHOUT(WELKIN_WINDOW);
  // Small, so that there is no doubt which budgets fit. The governor needs less than 30 frames to
  // leave a rung and to judge the next, up or down.
  constexpr int PATIENCE = 40;
  Script script(96, 54);
  script.at(2, "report");
  script.at(3, "quality=medium").at(4, "report");
  script.at(5, "budget=1").at(5 + PATIENCE, "report");
  script.at(6 + PATIENCE, "budget=off").at(7 + PATIENCE, "report");
  const std::vector<Report> report = script.run();
  ASSERT_EQ(report.size(), 4u);
  const Report& low = report[0];
  const Report& medium = report[1];
  const Report& poor = report[2];
  const Report& off = report[3];
  EXPECT_EQ(low.at("control"), "level");
  EXPECT_EQ(medium.at("control"), "level");
  EXPECT_GT(number(medium, "rung"), number(low, "rung"));
  EXPECT_GT(number(medium, "slices"), number(low, "slices"));
  // No software driver draws this in 1 ms: the governor goes down to the last rung and says so.
  EXPECT_EQ(poor.at("control"), "time");
  EXPECT_EQ(poor.at("reason"), "UNREACHABLE");
  EXPECT_EQ(number(poor, "rung"), number(poor, "lowest"));
  EXPECT_EQ(number(poor, "slices"), number(low, "slices"));
  EXPECT_EQ(off.at("control"), "level");
  EXPECT_EQ(number(off, "rung"), number(medium, "rung"));

  // The option's budget is the same: time for everything goes to the best rung.
  Script rich(96, 54);
  rich.option("--budget 1000").at(1, "quality=medium").at(PATIENCE, "report");
  const std::vector<Report> best = rich.run();
  ASSERT_EQ(best.size(), 1u);
  EXPECT_EQ(best[0].at("control"), "time");
  EXPECT_EQ(best[0].at("reason"), "BEST");
  EXPECT_EQ(number(best[0], "rung"), number(medium, "rung"));
}

TEST(WindowSamplePanel, LoadsASceneFileAndStaysWhereThereIsNone) {
  SKIP_WITHOUT(WELKIN_WINDOW);
  const std::string file = sceneFile("clear-day.json");
  Script script;
  script.pictureAt(SETTLED);
  script.at(SETTLED + 1, "scene=missing.json").pictureAt(SETTLED + 2);
  script.at(SETTLED + 3, "scene=" + file).pictureAt(2 * SETTLED + 3);
  script.at(2 * SETTLED + 4, "droplets=10").pictureAt(2 * SETTLED + 5);
  script.option("2>/dev/null").run();
  EXPECT_EQ(script.picture(1), script.picture(0));
  EXPECT_NE(script.picture(2), script.picture(0));
  EXPECT_EQ(script.picture(3), script.picture(2)) << "the scene has no clouds of the sample";
  Script fresh;
  fresh.option("--scene " + file).pictureAt(SETTLED).run();
  EXPECT_EQ(script.picture(2), fresh.picture(0));
}

TEST(WindowSamplePanel, WritesPicturesOfTheFramesAskedFor) {
  SKIP_WITHOUT(WELKIN_WINDOW);
  const std::string last = temporary("last.png");
  Script script;
  script.option("--screenshot " + last);
  script.pictureAt(2).at(3, "hour=12").pictureAt(4).pictureAt(4).run();
  EXPECT_NE(script.picture(0), script.picture(1));
  EXPECT_EQ(script.picture(1), script.picture(2));
  EXPECT_EQ(script.picture(1), readPicture(last)) << "of the last frame";
  EXPECT_EQ(runWindow("--size 64x36 --frames 2 --at 1:screenshot=missing/a.png 2>/dev/null"), 2);
}

// Each mode has other targets that follow.
TEST(WindowSamplePanel, FollowsTheWindowsSizeInEveryCompositeMode) {
  SKIP_WITHOUT(WELKIN_WINDOW);
  constexpr int WIDE = 480;
  constexpr int LOW = 200;
  Script fresh(WIDE, LOW);
  fresh.pictureAt(SETTLED).run();
  for (const char* mode : {"compute", "blend", "separate"}) {
    Script script;
    script.option(std::string("--composite ") + mode).pictureAt(SETTLED);
    script.at(SETTLED + 1, "size=" + size(WIDE, LOW)).pictureAt(2 * SETTLED);
    script.at(2 * SETTLED + 1, "size=" + size(100, 300)).pictureAt(2 * SETTLED + 1);
    script.at(2 * SETTLED + 2, "size=" + size(WIDTH, HEIGHT)).pictureAt(3 * SETTLED + 1);
    script.run();
    EXPECT_LE(largestDifference(script.picture(1), fresh.picture(0)), ROUNDING) << mode;
    ASSERT_EQ(script.picture(2).width, 100) << mode << ": in the first frame already";
    ASSERT_EQ(script.picture(2).height, 300) << mode;
    EXPECT_GT(mean(script.picture(2), {0, 0, 100, 100}), 80.0) << mode;
    EXPECT_EQ(script.picture(3), script.picture(0)) << mode;
  }
  // The panel draws into the window's images, too, and keeps to its 380 pixels.
  Script panel;
  panel.option("--panel").at(2, "size=" + size(WIDE, LOW)).pictureAt(SETTLED + 1).run();
  const Region beside{390, 0, WIDE, LOW};
  ASSERT_EQ(panel.picture(0).width, WIDE);
  EXPECT_EQ(cut(panel.picture(0), beside), cut(fresh.picture(0), beside));
  EXPECT_NE(panel.picture(0), fresh.picture(0));
}

TEST(WindowSamplePanel, BadScriptsAreErrors) {
  SKIP_WITHOUT(WELKIN_WINDOW);
  for (const char* action :
       {"hour=9", "0:hour=9", "x:hour=9", "1:hour=25", "1:hour=", "1:hour=9h", "1:droplets=4",
        "1:extinction=1", "1:quality=best", "1:budget=0", "1:scene=", "1:screenshot", "1:size=12",
        "1:report=all", "1:dance", "3:report"}) {
    EXPECT_NE(runWindow(std::string("--size 64x36 --frames 2 --at ") + action + " 2>/dev/null"), 0)
        << action;
  }
}

}  // namespace
