// SPDX-License-Identifier: MIT
// Buffers of rows of 16 bytes that are read as texels: drivers such as lavapipe read a buffer word
// by word and lane by lane, and wait for each; a texel they fetch for less than one word. Devices
// whose buffers of texels are too small read words: Device::texels().
layout(constant_id = 16) const bool TEXELS = true;
