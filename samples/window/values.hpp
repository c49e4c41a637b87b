// SPDX-License-Identifier: MIT
// How values are written on the command line and in scripts.
#pragma once

#include <map>
#include <string>

#include "settings.hpp"

// "1280x720". Throws std::invalid_argument with what was expected instead.
Size readSize(const std::string& text);
// A number and nothing else; throws the same.
float readNumber(const std::string& text, const Range& range);
const std::map<std::string, uint32_t>& qualityLevels();
