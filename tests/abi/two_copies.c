/* SPDX-License-Identifier: MIT
 *
 * A program with a Welkin inside loads another, as a plug-in would bring it, a hundred times: each
 * has its own state, and the loaded one leaves when it is closed.
 */
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
#include <welkin/welkin.h>

#define LOADS 100

typedef struct Welkin {
  WlkResult (*init)(uint32_t, uint32_t, void*);
  WlkResult (*create)(uint32_t, const WlkContextInfo*, WlkContext*);
  void (*destroy)(WlkContext);
  WlkResult (*createMedium)(WlkContext, const WlkMediumInfo*, WlkMedium*);
  WlkResult (*lastError)(WlkErrorInfo*);
} Welkin;

static int failures = 0;

static void require(int condition, const char* what) {
  if (!condition) {
    fprintf(stderr, "not true: %s\n", what);
    ++failures;
  }
}

/* ISO C has no cast of an object pointer to a function's; dlsym's manual has this way. */
static void find(void* library, const char* name, void* function) {
  void* symbol = dlsym(library, name);
  require(symbol != NULL, name);
  memcpy(function, &symbol, sizeof symbol);
}

static Welkin loaded(void* library) {
  Welkin welkin;
  find(library, "wlkInitStruct", &welkin.init);
  find(library, "wlkCreateContext", &welkin.create);
  find(library, "wlkDestroyContext", &welkin.destroy);
  find(library, "wlkCreateMedium", &welkin.createMedium);
  find(library, "wlkGetLastError", &welkin.lastError);
  return welkin;
}

static WlkResult lastResult(const Welkin* welkin) {
  WlkErrorInfo info;
  welkin->init(WLK_STRUCT_ERROR_INFO, sizeof info, &info);
  welkin->lastError(&info);
  return info.result;
}

/* A context that creates a medium and refuses another. */
static void use(const Welkin* welkin) {
  WlkContextInfo contextInfo;
  WlkMediumInfo mediumInfo;
  WlkContext context = NULL;
  WlkMedium medium = {0};
  welkin->init(WLK_STRUCT_CONTEXT_INFO, sizeof contextInfo, &contextInfo);
  require(welkin->create(WLK_API_VERSION, &contextInfo, &context) == WLK_SUCCESS,
          "a context is created");
  welkin->init(WLK_STRUCT_MEDIUM_INFO, sizeof mediumInfo, &mediumInfo);
  mediumInfo.particle = WLK_PARTICLE_HENYEY_GREENSTEIN;
  require(welkin->createMedium(context, &mediumInfo, &medium) == WLK_SUCCESS,
          "a medium is created");
  mediumInfo.asymmetry = 2.0f;
  require(welkin->createMedium(context, &mediumInfo, &medium) == WLK_ERROR_INVALID_ARGUMENT,
          "g = 2 is refused");
  welkin->destroy(context);
}

int main(int argc, char** argv) {
  const Welkin inside = {wlkInitStruct, wlkCreateContext, wlkDestroyContext, wlkCreateMedium,
                         wlkGetLastError};
  if (argc != 2) {
    return 2;
  }
  for (int i = 0; i < LOADS && failures == 0; ++i) {
    void* library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
    if (library == NULL) {
      fprintf(stderr, "%s\n", dlerror());
      return 1;
    }
    const Welkin other = loaded(library);
    require(other.create != inside.create, "these are two copies");
    use(&other);
    require(lastResult(&other) == WLK_ERROR_INVALID_ARGUMENT, "the loaded one knows its error");
    require(lastResult(&inside) == WLK_SUCCESS, "the one inside knows nothing of it");
    dlclose(library);
    require(dlopen(argv[1], RTLD_NOW | RTLD_NOLOAD) == NULL, "the loaded one has left");
  }
  use(&inside);
  require(lastResult(&inside) == WLK_ERROR_INVALID_ARGUMENT, "the one inside works as well");
  return failures != 0;
}
