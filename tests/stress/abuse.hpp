// SPDX-License-Identifier: MIT
// What the tests of hostile input share: a scene that must not change, and the checks of a failing
// call: its code, and the structure and field that wlkGetLastError names.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <functional>
#include <vector>

#include "support/headless_scene.hpp"

namespace welkin::test {

// One scene per process: sky, fog, sun, a cloud and a volume to abuse, at 16 x 12 pixels.
class VictimScene {
 public:
  static VictimScene& get();
  HeadlessScene scene;
  WlkMedium medium{};
  WlkVolume volume{};  // 4^3 voxels, one field of `medium`, all 0.5, around the eye's line of sight
  // Renders and compares with the picture of the scene as it was made, bit for bit.
  void expectUnchanged();
  // Sets everything that tests may have changed back.
  void restore();

 private:
  VictimScene();
  Image before_;
};

inline WlkErrorInfo lastError() {
  auto info = make<WlkErrorInfo>();
  (void)wlkGetLastError(&info);
  return info;
}

// The call returns `code`, and the thread's last error has it and names `field`.
::testing::AssertionResult failsWith(WlkResult result, WlkResult code, const char* field);

#define EXPECT_FAILS(call, code, field) \
  EXPECT_TRUE(::welkin::test::failsWith((call), (code), (field)))

// A context without a device.
class CpuContext {
 public:
  explicit CpuContext(const WlkAllocator& allocator = {});
  ~CpuContext() { wlkDestroyContext(context); }
  CpuContext(const CpuContext&) = delete;
  CpuContext& operator=(const CpuContext&) = delete;
  WlkContext context = nullptr;
};

template <typename T>
struct LongerThan {
  T known;
  unsigned char tail[24];
};
template <typename T>
LongerThan<T> longerThan(const T& valid) {
  LongerThan<T> longer{valid, {}};
  longer.known.structSize = sizeof(T) + sizeof longer.tail;
  return longer;
}

// Runs a function that takes a structure of type T through every wrong header. `valid` is a
// structure it accepts, other than the one that is set: a half-made change shows.
template <typename T>
void abuseHeader(const T& valid, const std::function<WlkResult(const T*)>& call) {
  T bad = valid;
  bad.sType = valid.sType == WLK_STRUCT_SKY ? uint32_t{WLK_STRUCT_FOG} : uint32_t{WLK_STRUCT_SKY};
  EXPECT_FAILS(call(&bad), WLK_ERROR_UNKNOWN_STRUCT, "sType");
  bad.sType = 0;
  EXPECT_FAILS(call(&bad), WLK_ERROR_UNKNOWN_STRUCT, "sType");
  for (const uint32_t size : {0u, 8u, uint32_t{sizeof(T)} - 1u, 0xffffffffu}) {
    bad = valid;
    bad.structSize = size;
    EXPECT_FAILS(call(&bad), WLK_ERROR_INVALID_ARGUMENT, "structSize") << size;
  }
  const std::array<uint32_t, 4> unknown{9999, 16, 0, 0};
  bad = valid;
  bad.next = &unknown;
  EXPECT_FAILS(call(&bad), WLK_ERROR_UNKNOWN_STRUCT, "next");
  // What has no meaning yet is 0, or it could never get one.
  const auto refuse = [&](uint32_t& reserved, const char* field) {
    reserved = 1;
    EXPECT_FAILS(call(&bad), WLK_ERROR_INVALID_ARGUMENT, field);
    reserved = 0;
  };
  bad = valid;
  if constexpr (requires { bad.reserved0; }) {
    refuse(bad.reserved0, "reserved0");
  }
  if constexpr (requires { bad.reserved1; }) {
    refuse(bad.reserved1, "reserved1");
  }
  LongerThan<T> longer = longerThan(valid);
  for (size_t i = 0; i < sizeof longer.tail; i += sizeof longer.tail - 1) {
    longer.tail[i] = 1;
    EXPECT_FAILS(call(&longer.known), WLK_ERROR_STRUCT_TOO_NEW, "structSize") << i;
    longer.tail[i] = 0;
  }
}

// A longer structure whose surplus is zero is one of a newer header that uses nothing new.
template <typename T>
void expectLongerAccepted(const T& valid, const std::function<WlkResult(const T*)>& call) {
  const LongerThan<T> longer = longerThan(valid);
  EXPECT_GE(call(&longer.known), 0) << lastError().message;
}

}  // namespace welkin::test
