// SPDX-License-Identifier: MIT
// The commands that give the truth and the distance from it: reference, slab, compare. No GPU.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "common/csv.hpp"
#include "common/image.hpp"
#include "common/json.hpp"
#include "reference/slab_benchmarks.hpp"
#include "welkin_program.hpp"

namespace {

using host_test::expectBadInput;
using host_test::expectSuccess;
using host_test::TempFolder;

// Haze of optical thickness 5 in the air over ground that is not black; 8 x 6 pixels.
constexpr const char* SCENE = R"({
  "sky": {}, "lights": [{"elevation_deg": 40, "azimuth_deg": 60}],
  "media": {"m": {"particle": "haze", "diameter_um": 0.6, "wavelength_um": 0.55}},
  "volumes": [{"fields": [{"medium": "m", "extinctionScale": 0.005}],
               "source": {"type": "slab", "size": [4, 4, 4], "extent": [1000, 1000, 1000]},
               "transform": {"origin": [-500, 300, -2500]}}],
  "camera": {"position": [0, 100, 0], "pitch_deg": 15}, "view": {"size": [8, 6]}})";

host::Image reference(const TempFolder& folder, const std::string& arguments) {
  expectSuccess(folder, "reference s.json -o o.exr " + arguments);
  return host::readExr(folder.file("o.exr"));
}

std::string bytesOf(const TempFolder& folder, const std::string& name) {
  return host::readTextFile(folder.file(name), 1 << 20, "picture");
}

// Calls use(i) for each colour sample of a picture.
template <typename Use>
void forSamples(const host::Image& image, Use use) {
  for (size_t i = 0; i < image.rgba.size(); ++i) {
    if (i % 4 != 3) {
      use(i);
    }
  }
}

TEST(WelkinReference, VarianceIsTheSpreadOfItsPictures) {
  const TempFolder folder;
  static_cast<void>(folder.write("s.json", SCENE));
  // Volumes alone, so that pixels are either noisy or black.
  const std::string volume = "--spp 128 --size 48x36 --set view.layers='[\"volumes\"]' ";
  const host::Image one = reference(folder, volume + "--variance v.exr --png p.png --stats j.json");
  const host::Image other = reference(folder, volume + "--seed 2 --variance w.exr");
  const host::Image first = host::readExr(folder.file("v.exr"));
  const host::Image second = host::readExr(folder.file("w.exr"));
  ASSERT_EQ(one.width, 48u);
  ASSERT_EQ(one.height, 36u);
  ASSERT_EQ(first.rgba.size(), one.rgba.size());
  double sum = 0.0;
  double count = 0.0;
  forSamples(one, [&](size_t i) {
    EXPECT_GE(one.rgba[i], 0.0f);
    const double variance = double{first.rgba[i]} + double{second.rgba[i]};
    if (variance > 0.0) {
      sum += std::pow(double{one.rgba[i]} - double{other.rgba[i]}, 2) / variance;
      count += 1.0;
    }
  });
  ASSERT_GT(count, 1000.0);
  // The colours share their paths. Mean of count / 3 squares of normal values: relative standard
  // error sqrt(2 / (count / 3)); four of these.
  EXPECT_NEAR(sum / count, 1.0, 4.0 * std::sqrt(6.0 / count));
  EXPECT_GT(std::filesystem::file_size(folder.file("p.png")), 0u);
  const host::Json stats = host::readJsonFile(folder.file("j.json"));
  EXPECT_EQ(stats.at("samples"), 128);
  EXPECT_EQ(stats.at("paths"), 48 * 36 * 128);  // grey: one path for three colours
}

TEST(WelkinReference, PreExposureScalesPictureAndVariance) {
  const TempFolder folder;
  static_cast<void>(folder.write("s.json", SCENE));
  const host::Image one = reference(folder, "--spp 16 --variance v.exr");
  const host::Image four =
      reference(folder, "--spp 16 --variance w.exr --set camera.preExposure=4");
  const host::Image v = host::readExr(folder.file("v.exr"));
  const host::Image w = host::readExr(folder.file("w.exr"));
  forSamples(one, [&](size_t i) {
    EXPECT_EQ(four.rgba[i], 4.0f * one.rgba[i]);  // powers of two: exact
    EXPECT_EQ(w.rgba[i], 16.0f * v.rgba[i]);
  });
}

TEST(WelkinReference, SeedDecidesEveryByte) {
  const TempFolder folder;
  static_cast<void>(folder.write("s.json", SCENE));
  expectSuccess(folder, "reference s.json -o a.exr --variance av.exr --spp 8 --seed 5");
  expectSuccess(folder, "reference s.json -o b.exr --variance bv.exr --spp 8 --seed 5 --threads 3");
  expectSuccess(folder, "reference s.json -o c.exr --variance cv.exr --spp 8 --seed 6");
  EXPECT_EQ(bytesOf(folder, "a.exr"), bytesOf(folder, "b.exr"));
  EXPECT_EQ(bytesOf(folder, "av.exr"), bytesOf(folder, "bv.exr"));
  EXPECT_NE(bytesOf(folder, "a.exr"), bytesOf(folder, "c.exr"));
  EXPECT_NE(bytesOf(folder, "av.exr"), bytesOf(folder, "cv.exr"));
}

TEST(WelkinReference, OrdersAddUp) {
  const TempFolder folder;
  static_cast<void>(folder.write("s.json", SCENE));
  const host::Image zero = reference(folder, "--spp 16 --order 0");
  const host::Image first = reference(folder, "--spp 16 --order 1");
  const host::Image atMostOne = reference(folder, "--spp 16 --max-order 1");
  const host::Image all = reference(folder, "--spp 16");
  double single = 0.0;
  double whole = 0.0;
  forSamples(all, [&](size_t i) {
    // The same paths, whatever counts; half a unit of each of three floats.
    const float rounding = 1.5f * 0x1p-23f * all.rgba[i];
    EXPECT_NEAR(zero.rgba[i] + first.rgba[i], atMostOne.rgba[i], rounding);
    EXPECT_LE(atMostOne.rgba[i], all.rgba[i] + rounding);
    single += double{atMostOne.rgba[i]};
    whole += double{all.rgba[i]};
  });
  EXPECT_GT(single, 0.0);
  // Haze of optical thickness 5 without absorption: far more than a tenth is scattered again.
  EXPECT_GT(whole, 1.1 * single);
}

TEST(WelkinReference, MieTheoryAgreesWithTheLibrarysTable) {
  const TempFolder folder;
  static_cast<void>(folder.write("s.json", SCENE));
  // Once scattered: the same paths, so that a pixel is proportional to its phase function.
  const std::string once = "--spp 16 --order 1 --set view.layers='[\"volumes\"]' ";
  const host::Image table = reference(folder, once);
  const host::Image mie = reference(folder, once + "--mie --stats j.json");
  // docs/models.md: |ln P| of the tables within 0.06.
  constexpr float TABLE = 0.06f;
  int differing = 0;
  forSamples(mie, [&](size_t i) {
    EXPECT_NEAR(mie.rgba[i], table.rgba[i], TABLE * table.rgba[i]) << i;
    differing += mie.rgba[i] != table.rgba[i] ? 1 : 0;
  });
  EXPECT_GT(differing, 0);
  EXPECT_EQ(host::readJsonFile(folder.file("j.json")).at("mie"), true);
}

TEST(WelkinReference, NamesMistakesAndWritesNothing) {
  const TempFolder folder;
  static_cast<void>(folder.write("s.json", SCENE));
  const std::string at = "reference s.json -o o.exr --variance v.exr ";
  expectBadInput(folder, "reference s.json", "--output");
  expectBadInput(folder, "reference none.json -o o.exr", "none.json: no such file");
  expectBadInput(folder, "reference s.json -o none/o.exr", "none/o.exr: expected an existing");
  expectBadInput(folder, "reference s.json -o o.exr --variance none/v.exr", "none/v.exr: expected");
  expectBadInput(folder, at + "--png none/p.png", "none/p.png: expected an existing folder");
  expectBadInput(folder, at + "--stats none/j.json", "none/j.json: expected an existing folder");
  expectBadInput(folder, at + "--spp 1", "--spp");
  expectBadInput(folder, at + "--spp many", "--spp");
  expectBadInput(folder, at + "--seed=-1", "--seed");
  expectBadInput(folder, at + "--threads 0", "--threads");
  expectBadInput(folder, at + "--size 8", "--size: expected WxH");
  expectBadInput(folder, at + "--size 0x6", "view.size.0: expected");
  expectBadInput(folder, at + "--max-order=-1", "--max-order");
  expectBadInput(folder, at + "--order 1 --max-order 2", "--order: expected --order or");
  expectBadInput(folder, at + "--set volumes.0.x=1", "volumes.0.x: unknown key");
  const std::string rain = "--set media.m='{\"particle\": \"rain\"}' ";
  expectBadInput(folder, at + rain + "--mie", "media.m: expected cloud, fog, haze, air or");
  for (const char* file : {"o.exr", "v.exr"}) {
    EXPECT_FALSE(std::filesystem::exists(folder.file(file))) << file;
  }
}

constexpr const char* SLABS = "tau,albedo,g,sunZenith_deg,viewZenith_deg,azimuth_deg\n";

host::CsvTable slab(const TempFolder& folder, const std::string& rows, const std::string& more) {
  static_cast<void>(folder.write("i.csv", SLABS + rows));
  expectSuccess(folder, "slab --in i.csv --out o.csv " + more);
  return host::readCsv(folder.file("o.csv"), {});
}

// H. C. van de Hulst, Multiple Light Scattering, 1980: table 12, isotropic, 0.8, depth 2, view at
// 60 degrees; table 35, Henyey-Greenstein 0.75, 0.9, depth 2. pi I, sun at the zenith.
TEST(WelkinSlab, GivesVanDeHulstsValues) {
  namespace truth = welkin::reference;
  const TempFolder folder;
  const host::CsvTable out = slab(folder,
                                  "2,0.8,0,0,60,0\n"
                                  "2,0.8,0,0,120,0\n"
                                  "2,0.9,0.75,0,0,0\n"
                                  "2,0.9,0.75,0,60,0\n",
                                  "");
  ASSERT_EQ(out.rowCount(), 4u);
  const double published[] = {
      truth::VAN_DE_HULST_12_REFLECTED[0].value, truth::VAN_DE_HULST_12_TRANSMITTED[0].value,
      truth::VAN_DE_HULST_35_REFLECTED[6].value, truth::VAN_DE_HULST_35_REFLECTED[3].value};
  constexpr double PRINTED = 0.6e-5;  // half a unit of the last digit, and a tenth for us
  const int radiance = out.find("radiance");
  for (size_t row = 0; row < 4; ++row) {
    EXPECT_NEAR(std::numbers::pi * out.at(row, radiance), published[row], PRINTED) << row;
    EXPECT_LT(out.at(row, out.find("single")), out.at(row, radiance)) << row;
    EXPECT_NEAR(out.at(row, out.find("fluxDirect")), std::exp(-2.0), 1e-12) << row;
  }
  EXPECT_NEAR(out.at(3, out.find("fluxUp")), truth::VAN_DE_HULST_35_REFLECTANCE, PRINTED);
  EXPECT_NEAR(out.at(3, out.find("fluxDown")) + out.at(3, out.find("fluxDirect")),
              truth::VAN_DE_HULST_35_TRANSMITTANCE, PRINTED);
}

TEST(WelkinSlab, MonteCarloAgreesWithOrdinates) {
  const TempFolder folder;
  const std::string rows =
      "2,0.8,0,0,60,0\n"
      "2,0.9,0.75,0,60,0\n"
      "0.5,1,-0.3,70,130,40\n"
      "8,1,0.5,30,20,180\n";
  const host::CsvTable exact = slab(folder, rows, "");
  const host::CsvTable drawn = slab(folder, rows, "--method montecarlo --samples 20000 --seed 7");
  const host::CsvTable again = slab(folder, rows, "--method montecarlo --samples 20000 --seed 7");
  const host::CsvTable other = slab(folder, rows, "--method montecarlo --samples 20000 --seed 70");
  for (size_t row = 0; row < exact.rowCount(); ++row) {
    const double radiance = exact.at(row, exact.find("radiance"));
    const double error = drawn.at(row, drawn.find("standardError"));
    EXPECT_NEAR(drawn.at(row, drawn.find("radiance")), radiance, 4.0 * error) << row;
    EXPECT_GT(error, 0.0) << row;
    EXPECT_LT(error, 0.03 * radiance) << row;
  }
  EXPECT_EQ(drawn.values, again.values);
  EXPECT_NE(drawn.values, other.values);
}

TEST(WelkinSlab, TakesAMedium) {
  const TempFolder folder;
  static_cast<void>(folder.write("i.csv", "2,0.9,40,60,0\n"));
  const auto run = [&](const std::string& medium) {
    expectSuccess(folder, "slab --in i.csv --out o.csv --nodes 16 " + medium);
    return host::readCsv(folder.file("o.csv"), {});
  };
  const host::CsvTable medium = run("--set particle=henyey-greenstein --set asymmetry=0.6");
  const host::CsvTable closed = slab(folder, "2,0.9,0.6,40,60,0\n", "--nodes 16");
  // Angles 5e-4 apart, linear in between: below 1e-6 of so smooth a function; float asymmetry 1e-7.
  const double radiance = closed.at(0, closed.find("radiance"));
  EXPECT_NEAR(medium.at(0, medium.find("radiance_r")), radiance, 1e-5 * radiance);
  EXPECT_EQ(medium.at(0, medium.find("radiance_b")), medium.at(0, medium.find("radiance_r")));
}

TEST(WelkinSlab, NamesMistakesAndWritesNothing) {
  const TempFolder folder;
  const auto expectBad = [&](const std::string& rows, const std::string& more,
                             const std::string& part) {
    static_cast<void>(folder.write("i.csv", SLABS + rows));
    expectBadInput(folder, "slab --in i.csv --out o.csv " + more, part);
  };
  const std::string good = "2,0.8,0,0,60,0\n";
  expectBad(good + "0,0.8,0,0,60,0\n", "", "i.csv: line 3, column tau: expected");
  expectBad(good + "\n2,1.1,0,0,60,0\n", "", "i.csv: line 4, column albedo: expected");
  expectBad("2,0.8,1,0,60,0\n", "", "line 2, column g: expected a number in [-0.999, 0.999]");
  expectBad("2,0.8,0,90,60,0\n", "", "line 2, column sunZenith_deg");
  expectBad("2,0.8,0,0,90,0\n", "", "line 2, column viewZenith_deg: expected");
  expectBad("2,0.8,0,0,60,inf\n", "", "line 2, column azimuth_deg");
  expectBad("2,x,0,0,60,0\n", "", "line 2, column albedo: expected a number");
  expectBad("2,0.8,0,0,60\n", "", "line 2");
  expectBad(good, "--particle cloud", "line 1: expected no other columns");
  expectBad(good, "--diameter 10", "line 1: expected no other columns");
  expectBad(good, "--method guess", "--method: expected ordinates or montecarlo");
  expectBad(good, "--nodes 7", "--nodes: expected a number in [8, 256]");
  expectBad(good, "--method montecarlo --samples=-5", "--samples");
  expectBad(good, "--method montecarlo --samples 1", "--samples");
  expectBad(good, "--seed=-1", "--seed");
  expectBad(good, "--medium m", "--medium: expected together with --scene");
  static_cast<void>(folder.write("j.csv",
                                 "tau,albedo,g,sunZenith_deg,viewZenith_deg,azimuth_deg,"
                                 "surfaceAlbedo\n2,0.8,0,0,60,0,0.5\n"));
  expectBadInput(folder, "slab --in j.csv --out o.csv --method montecarlo",
                 "line 2, column surfaceAlbedo: expected 0");
  expectBadInput(folder, "slab --in none.csv --out o.csv", "none.csv: no such file");
  expectBadInput(folder, "slab --in i.csv --out none/o.csv", "none/o.csv: expected an existing");
  EXPECT_FALSE(std::filesystem::exists(folder.file("o.csv")));
}

// Width and height of a PNG, from its first chunk.
std::pair<int, int> pngSize(const std::string& bytes) {
  const auto number = [&](size_t i) {
    return static_cast<uint8_t>(bytes.at(i)) * 256 + static_cast<uint8_t>(bytes.at(i + 1));
  };
  return {number(18), number(22)};
}

TEST(WelkinCompare, TakesTheReferencesNoiseOff) {
  const TempFolder folder;
  host::writeExr(folder.file("a.exr"), {12, 10, std::vector<float>(480, 1.25f)});
  host::writeExr(folder.file("b.exr"), {12, 10, std::vector<float>(480, 1.0f)});
  host::writeExr(folder.file("v.exr"), {12, 10, std::vector<float>(480, 0x1p-6f)});
  expectSuccess(folder, "compare a.exr b.exr --variance v.exr --flip-map f.png --json m.json");
  const host::Json metrics = host::readJsonFile(folder.file("m.json"));
  // An offset of a quarter, of which a sixteenth of relMSE would be noise: all exact in binary.
  EXPECT_EQ(metrics.at("relMSE"), 0.0625);
  EXPECT_EQ(metrics.at("rmseOverMean"), 0.25);
  EXPECT_EQ(metrics.at("maxRelativeError"), 0.25);
  EXPECT_EQ(metrics.at("relMSEdenoised"), 0.0625 - 0x1p-6);
  EXPECT_EQ(metrics.at("rmseOverMeanDenoised"), std::sqrt(0.0625 - 0x1p-6));
  EXPECT_EQ(metrics.at("standardError"), 0.125);
  EXPECT_GT(metrics.at("flip"), 0.0);
  EXPECT_LT(metrics.at("flip"), 1.0);
  EXPECT_EQ(pngSize(bytesOf(folder, "f.png")), (std::pair{12, 10}));
  expectSuccess(folder, "compare b.exr b.exr --flip-map g.png --json n.json");
  const host::Json same = host::readJsonFile(folder.file("n.json"));
  EXPECT_EQ(same.at("flip"), 0.0);
  EXPECT_FALSE(same.contains("standardError"));
  EXPECT_NE(bytesOf(folder, "f.png"), bytesOf(folder, "g.png"));
}

TEST(WelkinCompare, NamesMistakesAndWritesNothing) {
  const TempFolder folder;
  host::writeExr(folder.file("a.exr"), {4, 4, std::vector<float>(64, 1.25f)});
  host::writeExr(folder.file("c.exr"), {4, 5, std::vector<float>(80, 1.0f)});
  host::writeExr(folder.file("n.exr"), {4, 4, std::vector<float>(64, -1.0f)});
  const std::string out = " --flip-map f.png --json m.json";
  expectBadInput(folder, "compare a.exr c.exr" + out, "a.exr: expected 4 x 5 pixels as in c.exr");
  expectBadInput(folder, "compare a.exr a.exr --variance c.exr" + out,
                 "c.exr: expected 4 x 4 pixels as in a.exr, got 4 x 5");
  expectBadInput(folder, "compare a.exr a.exr --variance n.exr" + out,
                 "n.exr: expected variances, finite and at least 0");
  expectBadInput(folder, "compare a.exr a.exr --flip-exposures 1,0,2" + out,
                 "--flip-exposures: expected START,STOP,COUNT");
  expectBadInput(folder, "compare a.exr a.exr --flip-pixels-per-degree 0" + out,
                 "--flip-pixels-per-degree");
  for (const char* file : {"f.png", "m.json"}) {
    EXPECT_FALSE(std::filesystem::exists(folder.file(file))) << file;
  }
}

}  // namespace
