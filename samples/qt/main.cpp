// SPDX-License-Identifier: MIT
// A second engine around Welkin, with other habits than samples/window:
//   Qt's event loop and its window's surface
//   z up, left-handed, reversed depth with a far plane in 24 bits beside a stencil
//   render passes, a picture of 32 bits per pixel without alpha, dual-source blending
//   three frames in flight, two views of one scene
//   a second thread that submits to the same queue
//   density in an image of the engine's own
#include <QCommandLineParser>
#include <QGuiApplication>
#include <cstdio>

#include "host_window.hpp"

namespace {

// Prints and exits for --help and for errors.
HostOptions parseOptions(const QGuiApplication& application, QSize& size) {
  QCommandLineParser parser;
  parser.setApplicationDescription(
      "Welkin in an engine of other habits. W A S D move, drag turns, left and right change the "
      "time of day, escape quits.");
  parser.addHelpOption();
  const QCommandLineOption sizeOption("size", "Pixels of the window.", "WIDTHxHEIGHT", "1280x720");
  const QCommandLineOption frames("frames", "Frames with clouds, then quit.", "count", "0");
  const QCommandLineOption quality("quality", "low, medium, high or ultra.", "level", "medium");
  const QCommandLineOption hour("hour", "Local solar time.", "hours", "10");
  const QCommandLineOption screenshot("screenshot", "PNG file for the last frame.", "file");
  const QCommandLineOption validate(
      "validate", "Load the validation layer; exit with 1 if it reports anything.");
  parser.addOptions({sizeOption, frames, quality, hour, screenshot, validate});
  parser.process(application);

  HostOptions options;
  unsigned width = 0;
  unsigned height = 0;
  char rest = 0;
  const QStringList levels{"low", "medium", "high", "ultra"};
  const qsizetype level = levels.indexOf(parser.value(quality));
  bool framesValid = false;
  bool hourValid = false;
  options.frames = parser.value(frames).toInt(&framesValid);
  options.hour = parser.value(hour).toDouble(&hourValid);
  if (std::sscanf(parser.value(sizeOption).toStdString().c_str(), "%ux%u%c", &width, &height,
                  &rest) != 2 ||
      width < 16 || height < 16 || width > 16384 || height > 16384 || level < 0 || !framesValid ||
      options.frames < 0 || !hourValid || options.hour < 0.0 || options.hour > 24.0 ||
      (parser.isSet(screenshot) && options.frames == 0)) {
    parser.showHelp(2);
  }
  size = QSize(static_cast<int>(width), static_cast<int>(height));
  options.renderer.quality = static_cast<uint32_t>(level);
  options.renderer.validate = parser.isSet(validate);
  options.screenshot = parser.value(screenshot);
  return options;
}

}  // namespace

int main(int count, char** arguments) {
  const QGuiApplication application(count, arguments);
  QSize size;
  HostWindow window(parseOptions(application, size));
  window.resize(size);
  window.show();
  QGuiApplication::exec();
  return window.result();
}
