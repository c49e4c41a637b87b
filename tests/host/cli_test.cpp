// SPDX-License-Identifier: MIT
// The program itself: exit codes and the one line on stderr. Needs no GPU.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
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
  expectBadInput(folder, "phase --in good.csv --out o.csv --medium m", "--medium");
  expectBadInput(folder, "sky --in ray.csv --out o.csv", "column dx: expected a direction");
  expectBadInput(folder, "sky --in good.csv --out o.csv", "expected the columns x,y,z");
}

TEST(WelkinProgram, AnswersValuesThatTheLibraryRejectsWithTwo) {
  const host_test::TempFolder folder;
  static_cast<void>(folder.write("good.csv", "10\n"));
  static_cast<void>(folder.write("ray.csv", "0,0,0,0,1,0,inf\n"));
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

// The output of a `phase` call that must succeed.
host::CsvTable phase(const host_test::TempFolder& folder, const std::string& arguments) {
  const Outcome outcome = welkin(folder, "phase --out o.csv " + arguments);
  EXPECT_EQ(outcome.code, 0) << arguments << '\n' << outcome.error;
  return host::readCsv(folder.file("o.csv"), {});
}

TEST(WelkinProgram, QueriesPhaseFunctions) {
  const host_test::TempFolder folder;
  static_cast<void>(folder.write("deg.csv", "0\n90\n180\n"));
  static_cast<void>(folder.write("rad.csv", "angle_rad\n1.5707963267948966\n"));
  const host::CsvTable degrees = phase(folder, "--in deg.csv --particle air");
  EXPECT_EQ(degrees.columns, (std::vector<std::string>{"angle_deg", "red", "green", "blue"}));
  ASSERT_EQ(degrees.rowCount(), 3u);
  // [R04] Eq. 1: 3 (1 + cos^2) / (16 pi), a handful of operations in double.
  const double forward = 6.0 / (16.0 * 3.14159265358979323846);
  EXPECT_NEAR(degrees.at(0, 1), forward, 16.0 * 0x1p-52 * forward);
  EXPECT_NEAR(degrees.at(1, 1), 0.5 * forward, 16.0 * 0x1p-52 * forward);
  EXPECT_NEAR(degrees.at(2, 1), forward, 16.0 * 0x1p-52 * forward);
  const host::CsvTable radians =
      phase(folder, "--in rad.csv --set particle=henyey-greenstein --asymmetry 0.5");
  EXPECT_EQ(radians.columns[0], "angle_rad");
  // (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^1.5) at 90 degrees.
  const double side = 0.75 / (4.0 * 3.14159265358979323846 * 1.25 * std::sqrt(1.25));
  EXPECT_NEAR(radians.at(0, 3), side, 16.0 * 0x1p-52 * side);
}

TEST(WelkinProgram, TakesRangesOfAngles) {
  const host_test::TempFolder folder;
  const host::CsvTable range = phase(folder, "--angles 0:180:0.1 --particle air");
  ASSERT_EQ(range.rowCount(), 1801u);
  EXPECT_EQ(range.at(1800, 0), 180.0);
  EXPECT_EQ(phase(folder, "--angles 10:20:4 --particle air").rowCount(), 3u);
  EXPECT_EQ(phase(folder, "--angles 7:7:1 --particle air").rowCount(), 1u);
  for (const char* bad : {"0:180", "0:180:x", "0:180:1:1", ":", "0:180:0", "0:180:-1", "5:4:1",
                          "-1:4:1", "0:181:1", "0:180:1e-9", "nan:1:1"}) {
    expectBadInput(folder, std::string("phase --out o.csv --angles=") + bad, "--angles: expected");
  }
}

TEST(WelkinProgram, TakesEveryPropertyOfAMedium) {
  const host_test::TempFolder folder;
  static_cast<void>(folder.write("p.csv", "0,4,2,1\n180,4,2,1\n"));
  static_cast<void>(
      folder.write("s.json", R"({"media": {"m": {"particle": "cloud", "diameter_um": 30}}})"));
  const std::string at = "--angles 0:180:45 ";
  const auto differs = [&](const std::string& a, const std::string& b) {
    return phase(folder, at + a).values != phase(folder, at + b).values;
  };
  EXPECT_TRUE(differs("--particle cloud", "--particle rain"));
  EXPECT_TRUE(differs("--model analytic", "--model table"));
  EXPECT_FALSE(differs("--model default", "--model table"));
  EXPECT_TRUE(differs("--diameter 8", "--diameter 16"));
  EXPECT_FALSE(differs("--diameter 30", "--scene s.json --medium m"));
  EXPECT_FALSE(differs("--diameter 16", "--scene s.json --medium m --diameter 16"));
  EXPECT_FALSE(differs("--diameter 16", "--set diameter_um=16"));
  EXPECT_TRUE(differs("--particle haze --spread 0.25", "--particle haze --spread 0.4"));
  EXPECT_TRUE(differs("--particle snow --roughness 0.3", "--particle snow --roughness 0.6"));
  EXPECT_TRUE(differs("--particle henyey-greenstein --asymmetry 0.1",
                      "--particle henyey-greenstein --asymmetry -0.1"));
  const host::CsvTable grey = phase(folder, at + "--particle haze --wavelength 0.5");
  EXPECT_EQ(grey.at(2, 1), grey.at(2, 3));
  // Constant in each channel: 1 / (4 pi) whatever the unit, up to the table's float storage.
  const host::CsvTable user = phase(folder, at + "--particle user --file p.csv");
  const double isotropic = 1.0 / (4.0 * 3.14159265358979323846);
  for (int column = 1; column < 4; ++column) {
    EXPECT_NEAR(user.at(1, column), isotropic, 1e-5 * isotropic);
  }
}

TEST(WelkinProgram, AnswersOrdersOfScattering) {
  const host_test::TempFolder folder;
  const std::string medium = "--angles 0:180:30 --particle henyey-greenstein --asymmetry ";
  // N scatterings of Henyey-Greenstein g are one of g^N: an exact identity of the moments.
  const host::CsvTable twice = phase(folder, medium + "0.6 --order 2");
  const host::CsvTable single = phase(folder, medium + "0.36");
  const host::CsvTable first = phase(folder, medium + "0.6 --order 1");
  const host::CsvTable plain = phase(folder, medium + "0.6");
  // A Poisson count over no depth is 1.
  const host::CsvTable thin = phase(folder, medium + "0.6 --optical-depth 0");
  const host::CsvTable thick = phase(folder, medium + "0.6 --optical-depth 100");
  // Angular tables of float, linear between their nodes: 1 %.
  constexpr double TABLE = 0.01;
  for (size_t row = 0; row < plain.rowCount(); ++row) {
    EXPECT_NEAR(twice.at(row, 2), single.at(row, 2), TABLE * single.at(row, 2)) << row;
    EXPECT_NEAR(first.at(row, 2), plain.at(row, 2), TABLE * plain.at(row, 2)) << row;
    EXPECT_NEAR(thin.at(row, 2), plain.at(row, 2), TABLE * plain.at(row, 2)) << row;
    EXPECT_NEAR(thick.at(row, 2) * 4.0 * 3.14159265358979323846, 1.0, TABLE) << row;
  }
}

TEST(WelkinProgram, DrawsScatteringAngles) {
  const host_test::TempFolder folder;
  static_cast<void>(folder.write("r.csv", "random\n0\n0.25\n0.5\n0.75\n0.999\n"));
  const host::CsvTable drawn = phase(folder, "--samples r.csv --diameter 12 --channel blue");
  EXPECT_EQ(drawn.columns, (std::vector<std::string>{"angle_deg", "density"}));
  ASSERT_EQ(drawn.rowCount(), 5u);
  EXPECT_NE(phase(folder, "--samples r.csv --diameter 12 --channel red").values, drawn.values);
  EXPECT_EQ(phase(folder, "--samples r.csv --diameter 12").values,
            phase(folder, "--samples r.csv --diameter 12 --channel green").values);
  std::string angles = "angle_deg\n";
  for (size_t row = 0; row < drawn.rowCount(); ++row) {
    EXPECT_TRUE(drawn.at(row, 0) >= 0.0 && drawn.at(row, 0) <= 180.0);
    angles += host::formatNumber(drawn.at(row, 0)) + "\n";
  }
  static_cast<void>(folder.write("a.csv", angles));
  const host::CsvTable value = phase(folder, "--in a.csv --diameter 12");
  for (size_t row = 0; row < drawn.rowCount(); ++row) {
    // The density is the phase function; degrees and back cost the last digits of a steep curve.
    EXPECT_NEAR(drawn.at(row, 1), value.at(row, 3), 1e-9 * value.at(row, 3)) << row;
  }
}

TEST(WelkinProgram, PrintsOptics) {
  const host_test::TempFolder folder;
  ASSERT_EQ(welkin(folder, "phase --optics --particle rain --diameter 1000").code, 0);
  const host::Json optics = host::readJsonFile(folder.file("stdout.txt"));
  for (const char* key : {"extinctionEfficiency", "extinctionCrossSection_m2", "asymmetry",
                          "forwardFraction", "deltaFraction"}) {
    ASSERT_EQ(optics.at(key).size(), 3u) << key;
  }
  // Large drops: extinction paradox, and the cross-section of the mean circle, exp(2 s^2) times
  // the median one ([J23] 1.1: s = 0.25).
  EXPECT_NEAR(optics.at("extinctionEfficiency")[1].get<double>(), 2.0, 0.05);
  const double circle = 3.14159265358979323846 * 0.25e-6 * std::exp(2.0 * 0.0625);
  EXPECT_NEAR(optics.at("extinctionCrossSection_m2")[1].get<double>(), 2.0 * circle, 0.05 * circle);
  // r3 / r2 of the log-normal: median radius times exp(2.5 s^2).
  EXPECT_NEAR(optics.at("effectiveRadius_um").get<double>(), 500.0 * std::exp(2.5 * 0.0625), 5.0);
  EXPECT_GT(optics.at("deltaFraction")[0].get<double>(), 0.3);
  EXPECT_EQ(welkin(folder, "phase --optics --angles 0:1:1 --out o.csv").code, 0);
}

TEST(WelkinProgram, NamesMistakesOfPhaseQueries) {
  const host_test::TempFolder folder;
  static_cast<void>(folder.write("good.csv", "10\n"));
  static_cast<void>(folder.write("half.csv", "0.5\n"));
  static_cast<void>(folder.write("one.csv", "random\n0.5\n1\n"));
  static_cast<void>(folder.write("p.csv", "0,1,1,1\n90,1,1,1\n"));
  static_cast<void>(folder.write("s.json", R"({"media": {"m": {"diameter_um": 500}}})"));
  const auto expectBad = [&](const std::string& arguments, const std::string& part) {
    expectBadInput(folder, "phase " + arguments, part);
  };
  expectBad("", "--in: expected one of --in, --angles, --samples and --optics");
  expectBad("--in good.csv", "--out: expected a file");
  expectBad("--optics --out o.csv", "--out: expected a file");
  expectBad("--in good.csv --angles 0:1:1 --out o.csv", "--angles: expected one of");
  expectBad("--in good.csv --samples half.csv --out o.csv", "--samples: expected one of");
  const std::string at = "--in good.csv --out o.csv ";
  expectBad(at + "--order 2 --optical-depth 1", "--optical-depth: expected --order or");
  expectBad("--samples half.csv --out o.csv --order 2", "--order: expected with --in or --angles");
  expectBad("--optics --optical-depth 2", "--optical-depth: expected with --in or --angles");
  expectBad(at + "--order 0", "order");
  expectBad(at + "--order 1001", "order");
  expectBad(at + "--order x", "--order");
  expectBad(at + "--optical-depth -1", "opticalDepth");
  expectBad(at + "--optical-depth nan", "opticalDepth");
  expectBad(at + "--particle mist", "--particle: expected one of cloud, fog, haze");
  expectBad(at + "--model mie", "--model: expected one of default, analytic, table");
  expectBad(at + "--particle rain --model analytic", "phaseModel");
  expectBad(at + "--diameter 500", "command line: medium.diameter_um");
  expectBad(at + "--scene s.json --medium m", "s.json: media.m.diameter_um");
  expectBad(at + "--scene s.json --medium x", "s.json: media.x: expected a value, got none");
  expectBad(at + "--spread 0.9", "medium.spread");
  expectBad(at + "--particle snow --roughness 2", "medium.roughness");
  expectBad(at + "--particle henyey-greenstein --asymmetry 1", "medium.asymmetry");
  expectBad(at + "--wavelength 1.1", "medium.wavelength_um");
  expectBad(at + "--particle user", "--file: expected the table (CSV) of particle user");
  expectBad(at + "--file p.csv", "p.csv: line 2, column angle_deg: expected 180 degrees");
  expectBad(at + "--particle user --file none.csv", "none.csv: no such file");
  expectBad("--samples good.csv --out o.csv", "good.csv: line 1, column random: expected a number");
  expectBad("--samples one.csv --out o.csv", "one.csv: line 3, column random: expected a number");
  expectBad("--samples half.csv --out o.csv --channel x",
            "--channel: expected one of red, green, blue");
}

TEST(WelkinProgram, QueriesTheSky) {
  const host_test::TempFolder folder;
  static_cast<void>(folder.write("a.csv",
                                 "x,y,z,elevation_deg,azimuth_deg,length\n"
                                 "0,10,0,90,0,inf\n0,10,0,0,90,1000\n"));
  static_cast<void>(folder.write("v.csv", "0,10,0,0,2,0,inf\n0,10,0,3,0,0,1000\n"));
  const std::string sun = " --set lights.0.elevation_deg=40 ";
  ASSERT_EQ(welkin(folder, "sky --in a.csv --out a.out.csv --max-order 1" + sun).code, 0);
  ASSERT_EQ(welkin(folder, "sky --in v.csv --out v.out.csv --max-order 1" + sun).code, 0);
  ASSERT_EQ(welkin(folder, "sky --in v.csv --out all.csv --orders" + sun).code, 0);
  const host::CsvTable angles = host::readCsv(folder.file("a.out.csv"), {});
  const host::CsvTable vectors = host::readCsv(folder.file("v.out.csv"), {});
  const host::CsvTable all = host::readCsv(folder.file("all.csv"), {});
  for (size_t row = 0; row < 2; ++row) {
    for (const char* column : {"radiance_r", "radiance_b", "transmittance_g"}) {
      const double a = angles.at(row, angles.find(column));
      EXPECT_GT(a, 0.0);
      EXPECT_LT(a, 1.0);
      // The same ray but for the rounding of sine and cosine, 1e-16 of a steep but smooth model.
      EXPECT_NEAR(vectors.at(row, vectors.find(column)), a, 1e4 * 0x1p-52 * a);
    }
    for (const char* channel : {"_r", "_g", "_b"}) {
      const double first = all.at(row, all.find(std::string("first") + channel));
      const int radiance = all.find(std::string("radiance") + channel);
      EXPECT_EQ(first, vectors.at(row, vectors.find(std::string("radiance") + channel)));
      EXPECT_GT(all.at(row, radiance), 1.02 * first);
    }
  }
  expectBadInput(folder, "sky --in v.csv --out x.csv --max-order 2", "--max-order");
}

}  // namespace
