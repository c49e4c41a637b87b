// SPDX-License-Identifier: MIT
// OpenEXR files of the host's own kind: single part, scan lines, float or half, no loss, no
// subsampling.
#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>

#include <array>
#include <memory>
#include <string>

#include "common/error.hpp"
#include "common/exr_header.hpp"
#include "common/image.hpp"

namespace host {
namespace {

namespace fs = std::filesystem;

struct OpenFile {
  std::unique_ptr<Imf::InputFile> input;
  Imath::Box2i window;
  uint32_t width = 0;
  uint32_t height = 0;
};

// Opens a file and checks everything that decides how much memory reading it takes.
OpenFile openExr(const fs::path& file) {
  const std::string name = file.string();
  const ExrWindow window = checkExrHeader(file);
  OpenFile open;
  try {
    open.input = std::make_unique<Imf::InputFile>(name.c_str(), 1);
    open.window = open.input->header().dataWindow();
  } catch (const std::exception& e) {
    throw InputError(name, "", std::string("expected an OpenEXR file: ") + e.what());
  }
  // The same bytes read by two readers; the file may have changed between them.
  const Imath::Box2i expected({window.minX, window.minY},
                              {window.minX + static_cast<int>(window.width) - 1,
                               window.minY + static_cast<int>(window.height) - 1});
  if (open.window != expected) {
    throw InputError(name, "dataWindow", "expected a file that nobody writes");
  }
  // A complete file holds every chunk, so its length bounds the memory of an honest picture.
  if (!open.input->isComplete()) {
    throw InputError(name, "", "expected a complete file, this one is cut off");
  }
  open.width = window.width;
  open.height = window.height;
  return open;
}

bool hasPlainChannel(const OpenFile& open, const char* channel) {
  const Imf::Channel* found = open.input->header().channels().findChannel(channel);
  return found != nullptr && found->xSampling == 1 && found->ySampling == 1;
}

// The library addresses pixel (x, y) at base + x * xStride + y * yStride with absolute x and y.
Imf::Slice sliceAt(const OpenFile& open, float* data, size_t channels, double fill) {
  return Imf::Slice::Make(Imf::FLOAT, data, open.window, channels * sizeof(float),
                          channels * sizeof(float) * open.width, 1, 1, fill);
}

void readPixels(const fs::path& file, OpenFile& open, const Imf::FrameBuffer& frame) {
  try {
    open.input->setFrameBuffer(frame);
    open.input->readPixels(open.window.min.y, open.window.max.y);
  } catch (const std::exception& e) {
    throw InputError(file.string(), "", std::string("expected intact pixel data: ") + e.what());
  }
}

}  // namespace

Image readExr(const fs::path& file) {
  OpenFile open = openExr(file);
  Image image;
  image.width = open.width;
  image.height = open.height;
  image.rgba.resize(image.pixelCount() * 4);
  Imf::FrameBuffer frame;
  constexpr std::array<const char*, 4> CHANNELS = {"R", "G", "B", "A"};
  for (size_t i = 0; i < CHANNELS.size(); ++i) {
    if (i < 3 && !hasPlainChannel(open, CHANNELS[i])) {
      throw InputError(file.string(), std::string("channel ") + CHANNELS[i],
                       "expected channels R, G, B without subsampling");
    }
    frame.insert(CHANNELS[i], sliceAt(open, image.rgba.data() + i, 4, i == 3 ? 1.0 : 0.0));
  }
  readPixels(file, open, frame);
  return image;
}

DepthImage readExrDepth(const fs::path& file) {
  OpenFile open = openExr(file);
  const char* channel = hasPlainChannel(open, "Z") ? "Z" : "R";
  if (!hasPlainChannel(open, channel)) {
    throw InputError(file.string(), "channel Z", "expected a channel Z or R without subsampling");
  }
  DepthImage depth;
  depth.width = open.width;
  depth.height = open.height;
  depth.values.resize(size_t{depth.width} * depth.height);
  Imf::FrameBuffer frame;
  frame.insert(channel, sliceAt(open, depth.values.data(), 1, 0.0));
  readPixels(file, open, frame);
  return depth;
}

void writeExr(const fs::path& file, const Image& image, const Image* transmittance) {
  try {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    const size_t stride = 4 * sizeof(float);
    Imf::FrameBuffer frame;
    const auto add = [&](const std::string& name, const float* data) {
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
      frame.insert(name, Imf::Slice::Make(Imf::FLOAT, data, header.dataWindow(), stride,
                                          stride * image.width));
    };
    constexpr std::array<const char*, 4> CHANNELS = {"R", "G", "B", "A"};
    for (size_t i = 0; i < CHANNELS.size(); ++i) {
      add(CHANNELS[i], image.rgba.data() + i);
      if (transmittance != nullptr && i < 3) {
        add(std::string("transmittance.") + CHANNELS[i], transmittance->rgba.data() + i);
      }
    }
    Imf::OutputFile output(file.string().c_str(), header);
    output.setFrameBuffer(frame);
    output.writePixels(static_cast<int>(image.height));
  } catch (const std::exception& e) {
    throw HostError(file.string() + ": cannot write: " + e.what());
  }
}

}  // namespace host
