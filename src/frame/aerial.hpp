// SPDX-License-Identifier: MIT
// Aerial perspective: what the composite does to a pixel, for the froxels of a view, into the
// engine's images.
#pragma once

#include "frame/frame_commands.hpp"

namespace welkin {

// Buffers for the froxels; `batches` where several volumes take several batches each. Throws
// LIMIT_EXCEEDED.
void makeAerial(vk::Device& device, const WlkAerialPerspective& info, uint32_t framesInFlight,
                bool batches, ViewResources& resources);

// Begins the pass if the frame has images for it: its line of the statistics, the slices with
// volumes. Records nothing.
void planAerial(FrameCommands& commands, const ViewTargets& targets);
// Throws NOT_PREPARED if the pipeline is missing.
vk::PipelineKey aerialKeyOf(const vk::Pipelines& pipelines, const ViewState& view);

// Pixels as froxels.
PixelRect froxelRect(const PixelRect& rect, const ViewState& view);
VkDeviceSize aerialVolumeOffset(const ViewState& view, uint32_t slot, uint32_t rank);

// The constants, from those that the view's frame has by now.
void writeAerialFrame(const FrameCommands& commands, bool half);
// The images, after all volumes.
void recordAerial(FrameCommands& commands, const ViewTargets& targets, VkDeviceSize counterOffset);

}  // namespace welkin
