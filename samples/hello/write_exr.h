/* SPDX-License-Identifier: MIT */
#ifndef WELKIN_SAMPLES_HELLO_WRITE_EXR_H
#define WELKIN_SAMPLES_HELLO_WRITE_EXR_H

#include <stdint.h>

/* Writes R, G and B of `width` * `height` RGBA floats, top row first. Returns 0 on failure. */
int writeExr(const char* path, const float* rgba, uint32_t width, uint32_t height);

#endif
