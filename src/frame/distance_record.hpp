// SPDX-License-Identifier: MIT
// The mean distance of a view's volumes in an image of the engine's.
#pragma once

#include "frame/frame_commands.hpp"

namespace welkin {

// After all volumes; appends its line to the statistics of views that tell it.
void recordVolumeDistance(FrameCommands& commands, const ViewTargets& targets);

}  // namespace welkin
