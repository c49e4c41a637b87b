// SPDX-License-Identifier: MIT
// OpenEXR files there and back, and what is refused.
#include <ImfChannelList.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfPreviewImage.h>
#include <ImfStringAttribute.h>
#include <ImfStringVectorAttribute.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/image.hpp"
#include "common/text.hpp"
#include "expect_input_error.hpp"
#include "temp_folder.hpp"

namespace {

using host_test::expectInputError;

host::Image ramp(uint32_t width, uint32_t height) {
  host::Image image{width, height, {}};
  for (size_t i = 0; i < image.pixelCount() * 4; ++i) {
    image.rgba.push_back(0.1f * static_cast<float>(i) - 3.0f);
  }
  return image;
}

// One channel of floats with any data window.
void writeChannel(const std::string& file, const char* channel, const Imath::Box2i& window,
                  float value) {
  Imf::Header header(window, window);
  header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
  const auto width = static_cast<size_t>(window.max.x - window.min.x + 1);
  const auto height = static_cast<size_t>(window.max.y - window.min.y + 1);
  std::vector<float> values(width * height, value);
  Imf::FrameBuffer frame;
  frame.insert(channel, Imf::Slice::Make(Imf::FLOAT, values.data(), window, sizeof(float),
                                         width * sizeof(float)));
  Imf::OutputFile output(file.c_str(), header);
  output.setFrameBuffer(frame);
  output.writePixels(static_cast<int>(height));
}

TEST(HostExr, KeepsEveryBitOfAPicture) {
  const host_test::TempFolder folder;
  host::Image image = ramp(37, 21);
  image.rgba[5] = 1e30f;
  image.rgba[6] = INFINITY;
  host::writeExr(folder.file("a.exr"), image);
  const host::Image back = host::readExr(folder.file("a.exr"));
  ASSERT_EQ(back.width, 37u);
  ASSERT_EQ(back.height, 21u);
  EXPECT_EQ(back.rgba, image.rgba);
}

TEST(HostExr, KeepsRadianceBesideTransmittance) {
  const host_test::TempFolder folder;
  const host::Image image = ramp(8, 4);
  const host::Image transmittance = ramp(8, 4);
  host::writeExr(folder.file("a.exr"), image, &transmittance);
  EXPECT_EQ(host::readExr(folder.file("a.exr")).rgba, image.rgba);
}

TEST(HostExr, ReadsDepthFromAShiftedDataWindow) {
  const host_test::TempFolder folder;
  const std::string file = folder.file("z.exr");
  writeChannel(file, "Z", {{-3, 5}, {6, 8}}, 0.25f);
  const host::DepthImage depth = host::readExrDepth(file);
  EXPECT_EQ(depth.width, 10u);
  EXPECT_EQ(depth.height, 4u);
  EXPECT_EQ(depth.values, std::vector<float>(40, 0.25f));
}

TEST(HostExr, RefusesWhatIsMissingForeignOrCutOff) {
  const host_test::TempFolder folder;
  expectInputError("no such file", [&] { host::readExr(folder.file("none.exr")); });
  const std::string text = folder.write("text.exr", "this is no picture");
  expectInputError("text.exr: expected an OpenEXR file", [&] { host::readExr(text); });
  const std::string empty = folder.write("empty.exr", "");
  expectInputError("expected an OpenEXR file", [&] { host::readExr(empty); });
  for (const double keep : {0.02, 0.3, 0.7, 0.99}) {
    const std::string cut = folder.file("cut.exr");
    host::writeExr(cut, ramp(64, 64));
    host_test::cutOff(cut, keep);
    expectInputError("cut.exr: expected", [&] { host::readExr(cut); });
  }
}

TEST(HostExr, RefusesOtherChannelsAndTooManyPixels) {
  const host_test::TempFolder folder;
  const std::string file = folder.file("y.exr");
  writeChannel(file, "Y", {{0, 0}, {3, 3}}, 1.0f);
  expectInputError("channel R", [&] { host::readExr(file); });
  expectInputError("channel Z", [&] { host::readExrDepth(file); });
  writeChannel(file, "Z", {{0, 0}, {static_cast<int>(host::MAX_IMAGE_EDGE), 0}}, 1.0f);
  expectInputError("dataWindow: expected 1 to 16384", [&] { host::readExrDepth(file); });
}

// The header of a picture as it is written, with one byte or one number changed.
std::string edited(const host_test::TempFolder& folder, const std::string& after, size_t offset,
                   uint64_t value, size_t bytes) {
  host::writeExr(folder.file("a.exr"), ramp(64, 64));
  std::string content = host::readTextFile(folder.file("a.exr"), 1 << 20, "EXR");
  const size_t at = content.find(after) + offset;
  for (size_t i = 0; i < bytes; ++i) {
    content[at + i] = static_cast<char>(value >> (8 * i));
  }
  return folder.write("edited.exr", content);
}

TEST(HostExr, RefusesKindsThatTheHostDoesNotNeedBeforeTheLibrarySeesThem) {
  const host_test::TempFolder folder;
  const std::string magic("\x76\x2f\x31\x01", 4);
  for (const uint32_t flag : {0x200u, 0x800u, 0x1000u}) {  // tiled, deep, multi-part
    const std::string file = edited(folder, magic, 4, 2 | flag, 4);
    expectInputError("one part of scan lines", [&] { host::readExr(file); });
  }
  const std::string type("compression\0compression\0\1\0\0\0", 28);
  for (uint32_t lossy = 4; lossy < 12; ++lossy) {
    const std::string file = edited(folder, type, 28, lossy, 1);
    expectInputError("compression: expected none, RLE, ZIPS or ZIP", [&] { host::readExr(file); });
  }
  const std::string window("dataWindow\0box2i\0\x10\0\0\0", 21);
  EXPECT_NO_THROW(host::readExr(edited(folder, window, 21 + 12, 63, 4)));
  const std::string large = edited(folder, window, 21 + 8, 16000 | uint64_t{16000} << 32, 8);
  expectInputError("too short for its pixels", [&] { host::readExr(large); });
  const std::string size = edited(folder, window, 21 - 4, 0xffffffff, 4);
  expectInputError("a header that is whole", [&] { host::readExr(size); });
}

// Found by fuzzing: a size that is not the type's made the library take 1.6 GiB for 373 bytes.
TEST(HostExr, RefusesSizesThatAreNotTheTypes) {
  const host_test::TempFolder folder;
  const auto refuses = [&](const std::string& after, size_t offset, uint64_t size) {
    const std::string file = edited(folder, after, offset, size, 4);
    expectInputError("expected a value of type", [&] { host::readExr(file); });
  };
  const std::string ratio("pixelAspectRatio\0float\0", 23);
  refuses(ratio, ratio.size(), 5);
  refuses(ratio, ratio.size(), 3);
  const std::string list("channels\0chlist\0", 16);
  refuses(list, list.size(), 72);
  refuses(list, list.size(), 74);
}

TEST(HostExr, TakesAttributesOfEveryLength) {
  const host_test::TempFolder folder;
  const std::string file = folder.file("a.exr");
  Imf::Header header(4, 4);
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  header.insert("words", Imf::StringVectorAttribute({"one", "", "three"}));
  header.insert("word", Imf::StringAttribute("word"));
  header.insert("floats", Imf::FloatVectorAttribute({1, 2, 3}));
  header.setPreviewImage(Imf::PreviewImage(3, 2));
  const std::vector<float> values(16, 0.5f);
  Imf::FrameBuffer frame;
  frame.insert("Z", Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow(), 4, 16));
  {
    Imf::OutputFile output(file.c_str(), header);
    output.setFrameBuffer(frame);
    output.writePixels(4);
  }
  EXPECT_EQ(host::readExrDepth(file).values, values);
}

TEST(HostPng, MapsBlackToBlackAndBrightToWhiteMonotonically) {
  for (const host::ToneMap map : {host::ToneMap::Linear, host::ToneMap::Filmic}) {
    double last = 0.0;
    for (double x = 0.0; x < 64.0; x += 1.0 / 64.0) {
      const double value = host::displayValue(x, 0.0, map);
      EXPECT_GE(value, last);
      last = value;
    }
    EXPECT_EQ(host::displayValue(-1.0, 0.0, map), 0.0);
    EXPECT_EQ(host::displayValue(NAN, 0.0, map), 0.0);
    EXPECT_DOUBLE_EQ(host::displayValue(INFINITY, 0.0, map), 1.0);
    EXPECT_EQ(host::displayValue(0.0, 0.0, map), 0.0);
    EXPECT_GT(last, 0.99);
  }
}

TEST(HostPng, ShiftsByWholeStops) {
  EXPECT_EQ(host::displayValue(0.25, 1.0, host::ToneMap::Linear),
            host::displayValue(0.5, 0.0, host::ToneMap::Linear));
  // sRGB encodes 0.5 as 0.735357 (IEC 61966-2-1), six digits.
  EXPECT_NEAR(host::displayValue(0.5, 0.0, host::ToneMap::Linear), 0.735357, 0.5e-6);
}

}  // namespace
