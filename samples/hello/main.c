/* SPDX-License-Identifier: MIT
 *
 * The smallest host: a sky, a sun and one cloud made of spheres, rendered without an engine or a
 * window, written as hello.exr (linear, scene-referred; any OpenEXR viewer opens it).
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <welkin/welkin.h>

#include "write_exr.h"

enum { WIDTH = 480, HEIGHT = 270, VOXELS = 64 };

/* Fills a structure with its defaults. */
#define INIT(sType, structure) check(wlkInitStruct((sType), sizeof(structure), &(structure)))

static void check(WlkResult result) {
  if (result < 0) {
    WlkErrorInfo error;
    memset(&error, 0, sizeof error);
    (void)wlkInitStruct(WLK_STRUCT_ERROR_INFO, sizeof error, &error);
    (void)wlkGetLastError(&error);
    fprintf(stderr, "%s: %s: %s\n", wlkResultName(result), error.field, error.message);
    exit(1);
  }
}

static void* allocateOrExit(size_t size) {
  void* memory = malloc(size);
  if (memory == NULL) {
    fprintf(stderr, "out of memory\n");
    exit(1);
  }
  return memory;
}

/* ---------------------------------------------------------------------------------- the cloud */

/* 1 inside a puff, falling smoothly to 0 at its edge; coordinates in the unit box. */
static float puff(float x, float y, float z, const float centre[3], float radius) {
  const float dx = x - centre[0], dy = y - centre[1], dz = z - centre[2];
  const float inside = 1.0f - sqrtf(dx * dx + dy * dy + dz * dz) / radius;
  return inside <= 0.0f ? 0.0f : (inside >= 0.5f ? 1.0f : 2.0f * inside);
}

static float cloudAt(float x, float y, float z) {
  static const float centres[6][3] = {{0.50f, 0.45f, 0.50f}, {0.30f, 0.35f, 0.50f},
                                      {0.70f, 0.35f, 0.45f}, {0.60f, 0.60f, 0.55f},
                                      {0.42f, 0.55f, 0.40f}, {0.50f, 0.32f, 0.70f}};
  static const float radii[6] = {0.30f, 0.24f, 0.24f, 0.22f, 0.20f, 0.22f};
  float density = 0.0f;
  for (int i = 0; i < 6; ++i) {
    density = fmaxf(density, puff(x, y, z, centres[i], radii[i]));
  }
  /* Bumps, and a flat base. */
  density -= 0.25f * (1.0f + sinf(37.0f * x) * sinf(41.0f * y) * sinf(31.0f * z));
  return y < 0.25f ? 0.0f : fmaxf(density, 0.0f);
}

static void addCloud(WlkContext context) {
  WlkMediumInfo mediumInfo;
  WlkMedium medium;
  INIT(WLK_STRUCT_MEDIUM_INFO, mediumInfo);
  mediumInfo.diameter_um = 20.0f;
  check(wlkCreateMedium(context, &mediumInfo, &medium));

  WlkVolumeField field = {medium, 0.01f, 0};
  WlkVolumeInfo volumeInfo;
  WlkVolume volume;
  INIT(WLK_STRUCT_VOLUME_INFO, volumeInfo);
  volumeInfo.size[0] = volumeInfo.size[1] = volumeInfo.size[2] = VOXELS;
  volumeInfo.fieldCount = 1;
  volumeInfo.fields = &field;
  /* 2 km wide and 1 km high, 150 m above the sea, its near side 2 km in front of the eye. */
  const double box[12] = {2000, 0, 0, -1000, 0, 1000, 0, 150, 0, 0, 2000, -4000};
  memcpy(volumeInfo.worldFromVolume, box, sizeof box);
  check(wlkCreateVolume(context, &volumeInfo, &volume));

  float* values = allocateOrExit(sizeof(float) * VOXELS * VOXELS * VOXELS);
  float* value = values;
  for (int z = 0; z < VOXELS; ++z) {
    for (int y = 0; y < VOXELS; ++y) {
      for (int x = 0; x < VOXELS; ++x) {
        const float step = 1.0f / (float)VOXELS;
        *value++ =
            cloudAt(((float)x + 0.5f) * step, ((float)y + 0.5f) * step, ((float)z + 0.5f) * step);
      }
    }
  }
  WlkVolumeUpload upload;
  INIT(WLK_STRUCT_VOLUME_UPLOAD, upload);
  upload.extent[0] = upload.extent[1] = upload.extent[2] = VOXELS;
  upload.data = values;
  upload.dataSize = sizeof(float) * VOXELS * VOXELS * VOXELS;
  check(wlkUploadVolume(context, volume, &upload));
  free(values);
}

/* ----------------------------------------------------------------------------------- the frame */

static void setScene(WlkContext context) {
  WlkSky sky;
  WlkLight sun;
  INIT(WLK_STRUCT_SKY, sky);
  check(wlkSetSky(context, &sky));
  INIT(WLK_STRUCT_LIGHT, sun);
  const float direction[3] = {-0.64f, 0.48f, -0.6f}; /* to the left, just outside the picture */
  memcpy(sun.direction, direction, sizeof direction);
  sun.irradiance[0] = sun.irradiance[1] = sun.irradiance[2] = 10.0f;
  check(wlkSetLights(context, 1, sizeof sun, &sun));
  addCloud(context);
}

int main(void) {
  WlkContextInfo contextInfo;
  WlkHeadlessInfo headless;
  WlkContext context;
  INIT(WLK_STRUCT_CONTEXT_INFO, contextInfo);
  INIT(WLK_STRUCT_HEADLESS_INFO, headless);
  contextInfo.next = &headless;
  check(wlkCreateContext(WLK_API_VERSION, &contextInfo, &context));
  setScene(context);

  WlkViewInfo viewInfo;
  WlkCamera camera;
  WlkView view;
  INIT(WLK_STRUCT_VIEW_INFO, viewInfo);
  viewInfo.width = WIDTH;
  viewInfo.height = HEIGHT;
  check(wlkCreateView(context, &viewInfo, &view));
  INIT(WLK_STRUCT_CAMERA, camera); /* 2 m above the sea, looking along -z, 60 degrees high */
  check(wlkSetCamera(context, view, &camera));

  check(wlkPrepare(context));
  check(wlkRenderHeadless(context, view, NULL));

  WlkImageData image;
  INIT(WLK_STRUCT_IMAGE_DATA, image);
  image.dataSize = sizeof(float) * 4 * WIDTH * HEIGHT;
  image.data = allocateOrExit((size_t)image.dataSize);
  check(wlkReadback(context, view, &image));
  const int written = writeExr("hello.exr", image.data, WIDTH, HEIGHT);
  printf(written ? "wrote hello.exr\n" : "cannot write hello.exr\n");

  free(image.data);
  wlkDestroyContext(context); /* with all that was made from it */
  return written ? 0 : 1;
}
