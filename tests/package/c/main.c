/* SPDX-License-Identifier: MIT
 *
 * What an installed library has to answer: its version, a phase function with a closed form, and
 * an error, which crosses its C++ inside. Needs no maths library of its own.
 */
#include <stdio.h>
#include <string.h>
#include <welkin/welkin.h>

static int failures = 0;

static void require(int condition, const char* what) {
  if (!condition) {
    fprintf(stderr, "not true: %s\n", what);
    ++failures;
  }
}

static void phaseFunction(WlkContext context, WlkMedium medium) {
  /* Forward, for Henyey and Greenstein's g = 1/2: (1 + g) / (4 pi (1 - g)^2). */
  const double expected = 1.5 / (4.0 * 3.14159265358979324 * 0.25);
  /* The library's tables and this constant in double; the medium's g is exact in float. */
  const double tolerance = 1e-6 * expected;
  const double angle = 0.0;
  double phase[3] = {0.0, 0.0, 0.0};
  WlkPhaseQuery query;
  wlkInitStruct(WLK_STRUCT_PHASE_QUERY, sizeof query, &query);
  query.medium = medium;
  query.count = 1;
  query.scatteringAngle = &angle;
  require(wlkEvalPhase(context, &query, phase) == WLK_SUCCESS, "the phase function is evaluated");
  for (int channel = 0; channel < 3; ++channel) {
    const double error = phase[channel] - expected;
    require(error < tolerance && -error < tolerance, "the phase function is Henyey-Greenstein's");
  }
}

int main(void) {
  WlkContextInfo contextInfo;
  WlkMediumInfo mediumInfo;
  WlkErrorInfo error;
  WlkContext context = NULL;
  WlkMedium medium = {0};
  require(wlkGetVersion() == WLK_API_VERSION, "header and library are of one version");
  wlkInitStruct(WLK_STRUCT_CONTEXT_INFO, sizeof contextInfo, &contextInfo);
  if (wlkCreateContext(WLK_API_VERSION, &contextInfo, &context) != WLK_SUCCESS) {
    fprintf(stderr, "no context\n");
    return 1;
  }
  wlkInitStruct(WLK_STRUCT_MEDIUM_INFO, sizeof mediumInfo, &mediumInfo);
  mediumInfo.particle = WLK_PARTICLE_HENYEY_GREENSTEIN;
  mediumInfo.asymmetry = 0.5f;
  require(wlkCreateMedium(context, &mediumInfo, &medium) == WLK_SUCCESS, "a medium is created");
  phaseFunction(context, medium);

  mediumInfo.asymmetry = 2.0f;
  require(wlkCreateMedium(context, &mediumInfo, &medium) == WLK_ERROR_INVALID_ARGUMENT,
          "g = 2 is refused");
  wlkInitStruct(WLK_STRUCT_ERROR_INFO, sizeof error, &error);
  wlkGetLastError(&error);
  require(strcmp(error.field, "asymmetry") == 0, "the error names the field");
  wlkDestroyContext(context);
  if (failures == 0) {
    puts("welkin answers");
  }
  return failures != 0;
}
