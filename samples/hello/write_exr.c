/* SPDX-License-Identifier: MIT
 *
 * The smallest OpenEXR writer: three float channels, uncompressed scan lines, little-endian bytes.
 */
#include "write_exr.h"

#include <stdio.h>
#include <string.h>

static void put32(FILE* file, uint32_t value) {
  const unsigned char bytes[4] = {(unsigned char)value, (unsigned char)(value >> 8),
                                  (unsigned char)(value >> 16), (unsigned char)(value >> 24)};
  fwrite(bytes, 1, sizeof bytes, file);
}

static void putFloat(FILE* file, float value) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  put32(file, bits);
}

static void putAttribute(FILE* file, const char* name, const char* type, uint32_t size) {
  fwrite(name, 1, strlen(name) + 1, file);
  fwrite(type, 1, strlen(type) + 1, file);
  put32(file, size);
}

int writeExr(const char* path, const float* rgba, uint32_t width, uint32_t height) {
  FILE* file = fopen(path, "wb");
  if (file == NULL) {
    return 0;
  }
  put32(file, 20000630); /* magic number */
  put32(file, 2);        /* version, single part, scan lines */
  putAttribute(file, "channels", "chlist", 3 * 18 + 1);
  for (const char* name = "BGR"; *name != '\0'; ++name) {
    fputc(*name, file);
    fputc(0, file);
    put32(file, 2); /* 32-bit float */
    put32(file, 0); /* not perceptually linear, reserved */
    put32(file, 1); /* every pixel in x and y */
    put32(file, 1);
  }
  fputc(0, file);
  putAttribute(file, "compression", "compression", 1);
  fputc(0, file);
  for (int i = 0; i < 2; ++i) {
    putAttribute(file, i == 0 ? "dataWindow" : "displayWindow", "box2i", 16);
    put32(file, 0);
    put32(file, 0);
    put32(file, width - 1);
    put32(file, height - 1);
  }
  putAttribute(file, "lineOrder", "lineOrder", 1);
  fputc(0, file);
  putAttribute(file, "pixelAspectRatio", "float", 4);
  putFloat(file, 1.0f);
  putAttribute(file, "screenWindowCenter", "v2f", 8);
  putFloat(file, 0.0f);
  putFloat(file, 0.0f);
  putAttribute(file, "screenWindowWidth", "float", 4);
  putFloat(file, 1.0f);
  fputc(0, file); /* end of the header; then the offset of every line, then the lines */
  const uint32_t lineSize = width * 12, first = (uint32_t)ftell(file) + 8 * height;
  for (uint32_t y = 0; y < height; ++y) {
    put32(file, first + y * (lineSize + 8));
    put32(file, 0);
  }
  for (uint32_t y = 0; y < height; ++y) {
    put32(file, y);
    put32(file, lineSize);
    for (int channel = 2; channel >= 0; --channel) { /* B, G, R: alphabetical */
      for (uint32_t x = 0; x < width; ++x) {
        putFloat(file, rgba[4 * ((size_t)y * width + x) + (size_t)channel]);
      }
    }
  }
  const int good = !ferror(file);
  return fclose(file) == 0 && good;
}
