// SPDX-License-Identifier: MIT
#include "options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <map>
#include <stdexcept>

#include "values.hpp"

namespace {

// A check of CLI11, which prints the message, by a function that throws it.
template <typename Read>
auto readBy(Read read) {
  return [read](const std::string& text) -> std::string {
    try {
      read(text);
      return "";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
}

}  // namespace

Options parseOptions(int count, char** arguments) {
  Options options;
  const std::map<std::string, uint32_t> composites{{"compute", WLK_COMPOSITE_COMPUTE},
                                                   {"blend", WLK_COMPOSITE_BLEND},
                                                   {"separate", WLK_COMPOSITE_SEPARATE}};
  std::string size;
  std::vector<std::string> script;
  std::string screenshot;
  CLI::App app{
      "A small Vulkan engine that shows Welkin's atmosphere.\n"
      "W A S D Q E move (shift: faster), drag turns, left and right change the time of "
      "day, F1 shows or hides the panel, escape quits."};
  app.add_option("--size", size, "Pixels of the window, WIDTHxHEIGHT")
      ->check(readBy([&](const std::string& text) { options.size = readSize(text); }));
  auto* frames = app.add_option("--frames", options.frames, "Frames to show, then quit")
                     ->check(CLI::PositiveNumber);
  app.add_option("--composite", options.composite, "How Welkin joins the picture")
      ->transform(CLI::CheckedTransformer(composites, CLI::ignore_case));
  app.add_option("--quality", options.settings.quality, "Welkin's quality level")
      ->transform(CLI::CheckedTransformer(qualityLevels(), CLI::ignore_case));
  app.add_option("--hour", options.settings.hour, "Local solar time")->check(CLI::Range(0.0, 24.0));
  app.add_option("--screenshot", screenshot, "PNG file for the last of --frames")->needs(frames);
  app.add_option("--budget", options.settings.timeBudget_ms,
                 "Milliseconds of a frame that Welkin keeps to")
      ->check(CLI::Range(0.1, 1000.0));
  app.add_option("--scene", options.scene, "Air, lights, media and volumes of a scene file")
      ->check(CLI::ExistingFile);
  app.add_option("--at", script,
                 "FRAME:ACTION: what the panel would do, before a frame is drawn. May be repeated. "
                 "Actions: " +
                     actionHelp() + " (of the frame before, to standard output)")
      ->check(readBy([](const std::string& text) { parseAction(text); }))
      ->allow_extra_args(false);
  app.add_flag("--panel", options.panel, "Show the control panel with --frames, too");
  app.add_flag("--validate", options.validate,
               "Load the validation layer; exit with 1 if it reports anything");
  try {
    app.parse(count, arguments);
    std::transform(script.begin(), script.end(), std::back_inserter(options.script), parseAction);
    if (options.frames != 0 &&
        std::any_of(options.script.begin(), options.script.end(),
                    [&](const Action& action) { return action.frame > options.frames; })) {
      throw CLI::ValidationError("--at", "the frame comes after the last of --frames");
    }
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));
  }
  if (!screenshot.empty()) {
    options.script.push_back(screenshotAt(options.frames, screenshot));
  }
  return options;
}
