// SPDX-License-Identifier: MIT
// The program itself: exit codes and the one line on stderr. Needs no GPU.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "common/csv.hpp"
#include "common/image.hpp"
#include "common/json.hpp"
#include "common/text.hpp"
#include "temp_folder.hpp"

namespace {

struct Outcome {
  int code = -1;
  std::string error;
};

// Runs `welkin ARGUMENTS` in the folder; {} in the arguments stands for it.
Outcome welkin(const host_test::TempFolder& folder, const std::string& arguments) {
  const std::string log = folder.file("stderr.txt");
  const std::string command = "cd '" + folder.file("") + "' && '" + WELKIN_PROGRAM + "' " +
                              arguments + " >stdout.txt 2>'" + log + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, host::readTextFile(log, 1 << 20, "log")};
}

void expectBadInput(const host_test::TempFolder& folder, const std::string& arguments,
                    const std::string& part) {
  const Outcome outcome = welkin(folder, arguments);
  EXPECT_EQ(outcome.code, 2) << arguments << '\n' << outcome.error;
  EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
  EXPECT_NE(outcome.error.find(part), std::string::npos) << outcome.error;
}

TEST(WelkinProgram, ExplainsItself) {
  const host_test::TempFolder folder;
  for (const char* command : {"", "render ", "compare ", "sky ", "phase "}) {
    EXPECT_EQ(welkin(folder, std::string(command) + "--help").code, 0);
  }
}

TEST(WelkinProgram, AnswersBadInputWithTwoAndOneLine) {
  const host_test::TempFolder folder;
  static_cast<void>(folder.write("bad.json", "{\"fog\": {\"extinction\": \"thick\"}}"));
  static_cast<void>(folder.write("cut.json", "{\"fog\": "));
  static_cast<void>(folder.write("ok.json", "{}"));
  static_cast<void>(folder.write("text.exr", "no picture"));
  static_cast<void>(folder.write("nan.csv", "angle_deg\nnan\n"));
  static_cast<void>(folder.write("far.csv", "angle_deg\n181\n"));
  static_cast<void>(folder.write("ray.csv", "0,0,0,0,0,0,1\n"));
  static_cast<void>(folder.write("good.csv", "10\n"));
  expectBadInput(folder, "", "command line");
  expectBadInput(folder, "dance", "command line");
  expectBadInput(folder, "render", "command line");
  expectBadInput(folder, "render none.json -o a.exr", "none.json: no such file");
  expectBadInput(folder, "render bad.json -o a.exr", "bad.json: fog.extinction: expected a number");
  expectBadInput(folder, "render cut.json -o a.exr", "cut.json: expected JSON");
  expectBadInput(folder, "render ok.json -o a.exr --size 0x5", "view.size.0: expected");
  expectBadInput(folder, "render ok.json -o a.exr --size 5", "--size: expected WxH");
  expectBadInput(folder, "render ok.json -o a.exr --quality best", "quality.level: expected one");
  expectBadInput(folder, "render ok.json -o a.exr --frames 0", "--frames");
  expectBadInput(folder, "render ok.json -o none/a.exr", "none/a.exr: expected an existing");
  expectBadInput(folder, "render ok.json -o a.exr --set fog.x=1", "fog.x: unknown key");
  expectBadInput(folder, "compare none.exr text.exr", "none.exr: no such file");
  expectBadInput(folder, "compare text.exr text.exr", "text.exr: expected an OpenEXR file");
  expectBadInput(folder, "phase --in nan.csv --out o.csv", "line 2, column angle_deg");
  expectBadInput(folder, "phase --in far.csv --out o.csv", "expected degrees in [0, 180]");
  expectBadInput(folder, "phase --in good.csv --out o.csv --type mie", "--type: expected one of");
  expectBadInput(folder, "phase --in good.csv --out o.csv --medium m", "--medium");
  expectBadInput(folder, "sky --in ray.csv --out o.csv", "column dx: expected a direction");
  expectBadInput(folder, "sky --in good.csv --out o.csv", "expected the columns x,y,z");
}

TEST(WelkinProgram, AnswersValuesThatTheLibraryRejectsWithTwo) {
  const host_test::TempFolder folder;
  static_cast<void>(folder.write("good.csv", "10\n"));
  static_cast<void>(folder.write("ray.csv", "0,0,0,0,1,0,inf\n"));
  expectBadInput(folder, "phase --in good.csv --out o.csv --diameter-um 500", "dropletDiameter_um");
  expectBadInput(folder, "sky --in ray.csv --out o.csv --set sky.scaleHeight=1", "sky.scaleHeight");
}

TEST(WelkinProgram, ComparesPictures) {
  const host_test::TempFolder folder;
  host::writeExr(folder.file("a.exr"), {4, 4, std::vector<float>(64, 1.25f)});
  host::writeExr(folder.file("b.exr"), {4, 4, std::vector<float>(64, 1.0f)});
  host::writeExr(folder.file("c.exr"), {4, 5, std::vector<float>(80, 1.0f)});
  EXPECT_EQ(welkin(folder, "compare a.exr b.exr --json m.json").code, 0);
  const host::Json metrics = host::readJsonFile(folder.file("m.json"));
  EXPECT_EQ(metrics.at("bias"), 0.25);
  EXPECT_EQ(metrics.at("relMSE"), 0.0625);
  EXPECT_EQ(metrics.at("nonFinite"), 0);
  expectBadInput(folder, "compare a.exr c.exr", "expected 4 x 5 pixels");
}

TEST(WelkinProgram, QueriesPhaseFunctions) {
  const host_test::TempFolder folder;
  static_cast<void>(folder.write("deg.csv", "0\n90\n180\n"));
  static_cast<void>(folder.write("rad.csv", "angle_rad\n1.5707963267948966\n"));
  ASSERT_EQ(welkin(folder, "phase --in deg.csv --out o.csv --type rayleigh").code, 0);
  const host::CsvTable degrees = host::readCsv(folder.file("o.csv"), {});
  ASSERT_EQ(degrees.rowCount(), 3u);
  // [R04] Eq. 1: 3 (1 + cos^2) / (16 pi), a handful of operations in double.
  const double forward = 6.0 / (16.0 * 3.14159265358979323846);
  EXPECT_NEAR(degrees.at(0, 1), forward, 16.0 * 0x1p-52 * forward);
  EXPECT_NEAR(degrees.at(1, 1), 0.5 * forward, 16.0 * 0x1p-52 * forward);
  EXPECT_NEAR(degrees.at(2, 1), forward, 16.0 * 0x1p-52 * forward);
  ASSERT_EQ(welkin(folder, "phase --in rad.csv --out o.csv --set phase=hg --asymmetry 0").code, 0);
  const host::CsvTable radians = host::readCsv(folder.file("o.csv"), {});
  EXPECT_NEAR(radians.at(0, 1), 1.0 / (4.0 * 3.14159265358979323846), 16.0 * 0x1p-52);
}

TEST(WelkinProgram, QueriesTheSky) {
  const host_test::TempFolder folder;
  static_cast<void>(folder.write("a.csv",
                                 "x,y,z,elevation_deg,azimuth_deg,length\n"
                                 "0,10,0,90,0,inf\n0,10,0,0,90,1000\n"));
  static_cast<void>(folder.write("v.csv", "0,10,0,0,2,0,inf\n0,10,0,3,0,0,1000\n"));
  ASSERT_EQ(welkin(folder, "sky --in a.csv --out a.out.csv --set lights.0.elevation_deg=40").code,
            0);
  ASSERT_EQ(welkin(folder, "sky --in v.csv --out v.out.csv --set lights.0.elevation_deg=40").code,
            0);
  const host::CsvTable angles = host::readCsv(folder.file("a.out.csv"), {});
  const host::CsvTable vectors = host::readCsv(folder.file("v.out.csv"), {});
  for (size_t row = 0; row < 2; ++row) {
    for (const char* column : {"radiance_r", "radiance_b", "transmittance_g"}) {
      const double a = angles.at(row, angles.find(column));
      EXPECT_GT(a, 0.0);
      EXPECT_LT(a, 1.0);
      // The same ray but for the rounding of sine and cosine, 1e-16 of a steep but smooth model.
      EXPECT_NEAR(vectors.at(row, vectors.find(column)), a, 1e4 * 0x1p-52 * a);
    }
  }
}

}  // namespace
