// SPDX-License-Identifier: MIT
// Structures that grow: a library of 1.2 and callers of 1.0, 1.1, 1.2 and 1.3.
#include <gtest/gtest.h>

#include <array>
#include <functional>

#include "api/validate.hpp"

namespace {

// The head and `a` are of 1.0, `b` came with 1.1, `c` with 1.2.
struct Grown {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  double a;
  double b;
  uint32_t c;
  uint32_t reserved0;
};
constexpr uint32_t OF_1_0 = offsetof(Grown, b);
constexpr uint32_t OF_1_1 = offsetof(Grown, c);
constexpr uint32_t TYPE = WLK_STRUCT_SKY;  // any: names the structure in errors

}  // namespace

template <>
constexpr uint32_t welkin::FIRST_SIZE<Grown> = OF_1_0;

namespace welkin {
namespace {

// What a caller holds, with what lies behind.
struct Caller {
  explicit Caller(uint32_t size) {
    bytes.fill(0x5a);
    Grown whole{TYPE, size, nullptr, 1, 2, 3, 0};
    std::memcpy(bytes.data(), &whole, std::min<size_t>(size, sizeof whole));
    for (size_t i = sizeof whole; i < size; ++i) {
      bytes[i] = 0;
    }
  }
  Grown* structure() { return reinterpret_cast<Grown*>(bytes.data()); }
  alignas(8) std::array<unsigned char, 96> bytes{};
};

WlkResult codeOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Failure& failure) {
    return failure.result;
  }
  return WLK_SUCCESS;
}

TEST(Growth, EverySizeSince10IsReadAsFarAsItGoes) {
  for (uint32_t size = OF_1_0; size <= sizeof(Grown) + 16; size += 8) {
    Caller caller(size);
    const Grown copy = copyStruct<Grown>(caller.structure(), TYPE);
    EXPECT_EQ(copy.a, 1) << size;
    EXPECT_EQ(copy.b, size >= OF_1_1 ? 2 : 0) << size;
    EXPECT_EQ(copy.c, size >= sizeof(Grown) ? 3u : 0u) << size;
  }
}

TEST(Growth, ShorterThan10OrWithUnknownFieldsIsRefused) {
  Caller shorter(OF_1_0 - 8);
  EXPECT_EQ(codeOf([&] { copyStruct<Grown>(shorter.structure(), TYPE); }),
            WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(codeOf([&] { startOutput(shorter.structure(), TYPE); }), WLK_ERROR_INVALID_ARGUMENT);
  Caller newer(sizeof(Grown) + 8);
  newer.bytes[sizeof(Grown) + 4] = 1;
  EXPECT_EQ(codeOf([&] { copyStruct<Grown>(newer.structure(), TYPE); }), WLK_ERROR_STRUCT_TOO_NEW);
}

TEST(Growth, OutputsAreWrittenAsFarAsTheCallerKnows) {
  for (uint32_t size = OF_1_0; size <= sizeof(Grown) + 16; size += 8) {
    Caller caller(size);
    Grown value = startOutput(caller.structure(), TYPE);
    EXPECT_EQ(value.structSize, size);
    value.a = 11;
    value.b = 12;
    value.c = 13;
    finishOutput(value, caller.structure());
    const Caller untouched(size);
    EXPECT_EQ(caller.structure()->a, 11) << size;
    EXPECT_EQ(caller.structure()->structSize, size);
    for (size_t i = std::min<size_t>(size, sizeof(Grown)); i < caller.bytes.size(); ++i) {
      ASSERT_EQ(caller.bytes[i], untouched.bytes[i]) << size << ": byte " << i;
    }
  }
}

TEST(Growth, ElementsHaveTheCallersStride) {
  for (const uint32_t stride : {OF_1_0, OF_1_1, uint32_t{sizeof(Grown)}, 64u}) {
    std::array<unsigned char, 128> bytes{};
    const Grown second{TYPE, stride, nullptr, 5, 6, 7, 0};
    std::memcpy(bytes.data() + stride, &second, std::min<size_t>(stride, sizeof second));
    const Grown copy = copyElement(reinterpret_cast<const Grown*>(bytes.data()), stride, 1, TYPE);
    EXPECT_EQ(copy.a, 5) << stride;
    EXPECT_EQ(copy.b, stride >= OF_1_1 ? 6 : 0) << stride;
    EXPECT_EQ(copy.c, stride >= sizeof(Grown) ? 7u : 0u) << stride;
  }
}

TEST(Growth, ReservedRoomMustBeZeroOnlyWhereTheCallerHasIt) {
  Caller caller(sizeof(Grown));
  caller.structure()->reserved0 = 1;
  EXPECT_EQ(codeOf([&] { copyStruct<Grown>(caller.structure(), TYPE); }),
            WLK_ERROR_INVALID_ARGUMENT);
  caller.structure()->structSize = OF_1_1;
  EXPECT_EQ(codeOf([&] { copyStruct<Grown>(caller.structure(), TYPE); }), WLK_SUCCESS);
}

}  // namespace
}  // namespace welkin
