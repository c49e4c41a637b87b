// SPDX-License-Identifier: MIT
#include "options.hpp"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <map>

namespace {

// "1280x720" into `options`; the message is what CLI11 prints.
std::string readSize(const std::string& text, Options& options) {
  unsigned width = 0;
  unsigned height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%ux%u%c", &width, &height, &rest) != 2 || width < 16 ||
      height < 16 || width > 16384 || height > 16384) {
    return "expected WIDTHxHEIGHT, 16 to 16384 each";
  }
  options.width = width;
  options.height = height;
  return "";
}

}  // namespace

Options parseOptions(int count, char** arguments) {
  Options options;
  const std::map<std::string, uint32_t> composites{{"compute", WLK_COMPOSITE_COMPUTE},
                                                   {"blend", WLK_COMPOSITE_BLEND},
                                                   {"separate", WLK_COMPOSITE_SEPARATE}};
  const std::map<std::string, uint32_t> qualities{{"low", WLK_QUALITY_LOW},
                                                  {"medium", WLK_QUALITY_MEDIUM},
                                                  {"high", WLK_QUALITY_HIGH},
                                                  {"ultra", WLK_QUALITY_ULTRA}};
  std::string size;
  CLI::App app{
      "A small Vulkan engine that shows Welkin's atmosphere.\n"
      "W A S D Q E move (shift: faster), drag turns, left and right change the time of "
      "day, F1 shows or hides the panel, escape quits."};
  app.add_option("--size", size, "Pixels of the window, WIDTHxHEIGHT")
      ->check([&](const std::string& text) { return readSize(text, options); });
  auto* frames = app.add_option("--frames", options.frames, "Frames to show, then quit")
                     ->check(CLI::PositiveNumber);
  app.add_option("--composite", options.composite, "How Welkin joins the picture")
      ->transform(CLI::CheckedTransformer(composites, CLI::ignore_case));
  app.add_option("--quality", options.settings.quality, "Welkin's quality level")
      ->transform(CLI::CheckedTransformer(qualities, CLI::ignore_case));
  app.add_option("--hour", options.settings.hour, "Local solar time")->check(CLI::Range(0.0, 24.0));
  app.add_option("--screenshot", options.screenshot, "PNG file for the last of --frames")
      ->needs(frames);
  app.add_option("--budget", options.settings.timeBudget_ms,
                 "Milliseconds of a frame that Welkin keeps to")
      ->check(CLI::Range(0.1, 1000.0));
  app.add_option("--scene", options.scene, "Air, lights, media and volumes of a scene file")
      ->check(CLI::ExistingFile);
  app.add_flag("--panel", options.panel, "Show the control panel with --frames, too");
  app.add_flag("--validate", options.validate,
               "Load the validation layer; exit with 1 if it reports anything");
  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));
  }
  return options;
}
