// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "common/scene.hpp"

// Apart from its users, since JSON's header takes 10 s to compile. Throws host::InputError.
host::Scene readScene(const std::string& file);
