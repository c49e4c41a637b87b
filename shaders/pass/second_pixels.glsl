// SPDX-License-Identifier: MIT
// What the rays of every second pixel saw, and the list of pixels between them that need rays of
// their own: one buffer, see LIST_HEAD. Second pixel (i, j) is pixel (2 i, 2 j); those of the last
// row and column may lie outside of the view by one, so that every pixel has neighbours around it.
layout(set = 0, binding = 11, std430) buffer SecondPixels { uint seconds[]; };
// The same buffer: four words at once cost the driver hardly more than one.
layout(set = 0, binding = 11, std430) buffer SecondRays { vec4 secondRays[]; };

uvec2 firstSecond() {
  return uvec2(volume.rect.xy) / 2u;
}

uvec2 lastSecond() {
  return uvec2(volume.rect.zw) / 2u;
}

uvec2 secondsOfView() {
  return uvec2(frame.viewport.xy) / 2u + 1u;
}

// In secondRays.
uint secondAddress(uvec2 second) {
  return (LIST_HEAD + SECOND_SIZE * (second.y * secondsOfView().x + second.x)) / 4u;
}

uint listAddress() {
  return LIST_HEAD + SECOND_SIZE * secondsOfView().x * secondsOfView().y;
}

void storeSecond(uvec2 second, vec4 state, float end, vec2 hidden) {
  uint at = secondAddress(second);
  secondRays[at] = state;
  if (DEPTH_ENABLED || DISTANCE) {
    secondRays[at + 1u] = vec4(end, hidden, 0.0f);
  }
}

uvec2 listedPixel(uint number) {
  uint both = seconds[listAddress() + number];
  return uvec2(both & 0xffffu, both >> 16u);
}
