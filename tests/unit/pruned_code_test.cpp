// SPDX-License-Identifier: MIT
// Truth: what SPIRV-Tools, a library of Khronos, leaves of the same module with the same constants.
#include "vk/pruned_code.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>
#include <string>

#include "aerial_comp_spv.h"
#include "ambient_cells_comp_spv.h"
#include "ambient_gather_comp_spv.h"
#include "ambient_restrict_comp_spv.h"
#include "ambient_source_comp_spv.h"
#include "ambient_sweep_comp_spv.h"
#include "ambient_view_comp_spv.h"
#include "composite_blend_frag_spv.h"
#include "composite_comp_spv.h"
#include "eye_clear_comp_spv.h"
#include "eye_march_comp_spv.h"
#include "eye_slices_comp_spv.h"
#include "eye_spread_comp_spv.h"
#include "eye_tiles_comp_spv.h"
#include "light_depth_comp_spv.h"
#include "light_slices_comp_spv.h"
#include "shadow_map_comp_spv.h"
#include "shadow_resolve_comp_spv.h"
#include "sky_table_comp_spv.h"
#include "surface_cells_comp_spv.h"
#include "surface_cover_comp_spv.h"
#include "surface_ends_comp_spv.h"
#include "surface_faces_comp_spv.h"
#include "surface_list_comp_spv.h"
#include "surface_map_comp_spv.h"
#include "surface_scatter_comp_spv.h"
#include "surface_shade_comp_spv.h"
#include "surface_shell_comp_spv.h"
#include "transport_cells_comp_spv.h"
#include "transport_depth_comp_spv.h"
#include "transport_extrapolate_comp_spv.h"
#include "transport_gather_comp_spv.h"
#include "transport_response_comp_spv.h"
#include "transport_restrict_comp_spv.h"
#include "transport_source_comp_spv.h"
#include "transport_sweep_comp_spv.h"
#include "transport_view_comp_spv.h"
#include "vk/pipelines.hpp"
#include "volume_distance_comp_spv.h"

namespace welkin::vk {
namespace {

using Code = std::vector<uint32_t>;

constexpr spv_target_env ENVIRONMENT = SPV_ENV_VULKAN_1_2;
constexpr uint32_t HEADER_WORDS = 5;
constexpr uint32_t OP_SPEC_CONSTANT_OP = 52;
constexpr uint32_t OP_STORE = 62;
constexpr uint32_t OP_IMAGE_WRITE = 99;
constexpr uint32_t OP_SREM = 138;
constexpr uint32_t OP_SMOD = 139;
constexpr uint32_t OP_CONTROL_BARRIER = 224;
constexpr uint32_t OP_ATOMIC_LOAD = 227;
constexpr uint32_t OP_ATOMIC_XOR = 242;
constexpr uint32_t OP_LOOP_MERGE = 246;

Code prunedOf(std::span<const uint32_t> code, std::span<const uint32_t> constants) {
  const auto pruned = prunedCode(code, constants, std::pmr::new_delete_resource());
  return {pruned.begin(), pruned.end()};
}

// The same by SPIRV-Tools. `unused`: without what is computed and not used, stores to variables
// that nothing reads among it.
Code frozen(std::span<const uint32_t> code, std::span<const uint32_t> constants, bool unused) {
  std::unordered_map<uint32_t, Code> values;
  for (uint32_t i = 0; i < constants.size(); ++i) {
    values[i] = {constants[i]};
  }
  spvtools::Optimizer optimizer(ENVIRONMENT);
  optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
      .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
      .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
      .RegisterPass(spvtools::CreateCCPPass())
      .RegisterPass(spvtools::CreateDeadBranchElimPass());
  if (!unused) {
    optimizer.RegisterPass(spvtools::CreateAggressiveDCEPass());
  }
  Code result;
  EXPECT_TRUE(optimizer.Run(code.data(), code.size(), &result));
  return result;
}

std::string faultsOf(const Code& code) {
  std::string text;
  spvtools::SpirvTools tools(ENVIRONMENT);
  tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&,
                               const char* message) { text += std::string(message) + "\n"; });
  return tools.Validate(code) ? "" : "invalid: " + text;
}

bool acts(uint32_t op) {
  return op == OP_STORE || op == OP_IMAGE_WRITE || op == OP_LOOP_MERGE ||
         op == OP_CONTROL_BARRIER || (op >= OP_ATOMIC_LOAD && op <= OP_ATOMIC_XOR);
}

// How often the module does what has an effect, by opcode.
std::map<uint32_t, int> actsOf(const Code& code) {
  std::map<uint32_t, int> result;
  for (size_t at = HEADER_WORDS; at < code.size(); at += code[at] >> 16) {
    if (acts(code[at] & 0xffffu)) {
      ++result[code[at] & 0xffffu];
    }
  }
  return result;
}

struct Pass {
  const char* name;
  std::span<const uint32_t> code;
};

void PrintTo(const Pass& pass, std::ostream* out) {
  *out << pass.name;
}

class PrunedCodeOf : public testing::TestWithParam<Pass> {};

TEST_P(PrunedCodeOf, IsValidAndDoesWhatSpirvToolsLeave) {
  std::mt19937 random(1);
  const std::span<const uint32_t> code = GetParam().code;
  for (uint32_t i = 0; i < 6; ++i) {
    std::array<uint32_t, MAX_CONSTANTS + 1> constants{};
    for (uint32_t k = 0; k < MAX_CONSTANTS; ++k) {
      constants[k] = random() % 2;
    }
    constants[TEXELS_CONSTANT] = i % 2;
    constants[3] = 1 + random() % 4;  // fields, of which there is one
    const Code pruned = prunedOf(code, constants);
    EXPECT_EQ(faultsOf(pruned), "");
    EXPECT_EQ(actsOf(pruned), actsOf(frozen(code, constants, true)));
    // Not taken away: constants and types that nothing uses any more.
    const size_t least = frozen(code, constants, false).size();
    EXPECT_LT(pruned.size(), least + least / 10 + 3000);
    EXPECT_EQ(prunedOf(pruned, constants), pruned) << "nothing is left to be pruned";
  }
}

class CountingMemory : public std::pmr::memory_resource {
 public:
  int blocks = 0;
  size_t bytes = 0;

 private:
  void* do_allocate(size_t size, size_t alignment) override {
    ++blocks;
    bytes += size;
    return std::pmr::new_delete_resource()->allocate(size, alignment);
  }
  void do_deallocate(void* place, size_t size, size_t alignment) override {
    std::pmr::new_delete_resource()->deallocate(place, size, alignment);
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

TEST_P(PrunedCodeOf, TakesTwoBlocksOfTheHost) {
  CountingMemory memory;
  prunedCode(GetParam().code, {}, &memory);
  EXPECT_EQ(memory.blocks, 2) << "the code and the work";
  EXPECT_LT(memory.bytes, size_t{3} << 20);
}

TEST_P(PrunedCodeOf, KeepsAllThatIsNotDecided) {
  // Usual values of the module, the constants being none.
  const std::span<const uint32_t> code = GetParam().code;
  EXPECT_EQ(actsOf(prunedOf(code, {})), actsOf(frozen(code, {}, true)));
}

// Vulkan leaves them undefined where an operand is negative, and GPUs do where the divisor is no
// power of two: numbers are made unsigned first.
TEST_P(PrunedCodeOf, TakesNoRemainderOfSignedNumbers) {
  const std::span<const uint32_t> code = GetParam().code;
  for (size_t at = HEADER_WORDS; at < code.size(); at += std::max(code[at] >> 16, 1U)) {
    uint32_t operation = code[at] & 0xffffU;
    operation = operation == OP_SPEC_CONSTANT_OP ? code[at + 3] : operation;
    ASSERT_TRUE(operation != OP_SREM && operation != OP_SMOD) << "word " << at;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Passes, PrunedCodeOf,
    testing::Values(
        Pass{"Aerial", aerial_comp_spv}, Pass{"AmbientCells", ambient_cells_comp_spv},
        Pass{"AmbientGather", ambient_gather_comp_spv},
        Pass{"AmbientRestrict", ambient_restrict_comp_spv},
        Pass{"AmbientSource", ambient_source_comp_spv},
        Pass{"AmbientSweep", ambient_sweep_comp_spv}, Pass{"AmbientView", ambient_view_comp_spv},
        Pass{"CompositeBlend", composite_blend_frag_spv}, Pass{"Composite", composite_comp_spv},
        Pass{"EyeMarch", eye_march_comp_spv}, Pass{"EyeSlices", eye_slices_comp_spv},
        Pass{"EyeSpread", eye_spread_comp_spv}, Pass{"EyeTiles", eye_tiles_comp_spv},
        Pass{"EyeClear", eye_clear_comp_spv}, Pass{"LightDepth", light_depth_comp_spv},
        Pass{"LightSlices", light_slices_comp_spv}, Pass{"ShadowMap", shadow_map_comp_spv},
        Pass{"ShadowResolve", shadow_resolve_comp_spv}, Pass{"SkyTable", sky_table_comp_spv},
        Pass{"SurfaceCells", surface_cells_comp_spv}, Pass{"SurfaceCover", surface_cover_comp_spv},
        Pass{"SurfaceEnds", surface_ends_comp_spv}, Pass{"SurfaceFaces", surface_faces_comp_spv},
        Pass{"SurfaceList", surface_list_comp_spv}, Pass{"SurfaceMap", surface_map_comp_spv},
        Pass{"SurfaceScatter", surface_scatter_comp_spv},
        Pass{"SurfaceShade", surface_shade_comp_spv}, Pass{"SurfaceShell", surface_shell_comp_spv},
        Pass{"TransportCells", transport_cells_comp_spv},
        Pass{"TransportDepth", transport_depth_comp_spv},
        Pass{"TransportExtrapolate", transport_extrapolate_comp_spv},
        Pass{"TransportGather", transport_gather_comp_spv},
        Pass{"TransportResponse", transport_response_comp_spv},
        Pass{"TransportRestrict", transport_restrict_comp_spv},
        Pass{"TransportSource", transport_source_comp_spv},
        Pass{"TransportSweep", transport_sweep_comp_spv},
        Pass{"TransportView", transport_view_comp_spv},
        Pass{"VolumeDistance", volume_distance_comp_spv}),
    [](const auto& one) { return std::string(one.param.name); });

Code assemble(const std::string& body, const std::string& names = "",
              const std::string& decorations = "") {
  const std::string text = R"(
    OpCapability Shader
    %std = OpExtInstImport "GLSL.std.450"
    OpMemoryModel Logical GLSL450
    OpEntryPoint GLCompute %main "main" %out
    OpExecutionMode %main LocalSize 1 1 1
)" + names + R"(
    OpDecorate %choice SpecId 2
    )" + decorations + R"(
    OpDecorate %block Block
    OpMemberDecorate %block 0 Offset 0
    OpDecorate %out DescriptorSet 0
    OpDecorate %out Binding 0
    %void = OpTypeVoid
    %bool = OpTypeBool
    %uint = OpTypeInt 32 0
    %float = OpTypeFloat 32
    %local = OpTypePointer Function %float
    %half = OpConstant %float 1.5
    %zero = OpConstant %uint 0
    %one = OpConstant %uint 1
    %two = OpConstant %uint 2
    %choice = OpSpecConstantTrue %bool
    %block = OpTypeStruct %uint
    %pointer = OpTypePointer StorageBuffer %block
    %member = OpTypePointer StorageBuffer %uint
    %out = OpVariable %pointer StorageBuffer
    %type = OpTypeFunction %void
    %main = OpFunction %void None %type
    %entry = OpLabel
    %whole = OpVariable %local Function
    %place = OpAccessChain %member %out %zero
    )" + body + "\nOpFunctionEnd\n";
  Code code;
  spvtools::SpirvTools tools(ENVIRONMENT);
  EXPECT_TRUE(tools.Assemble(text, &code));
  EXPECT_EQ(faultsOf(code), "");
  return code;
}

std::string textOf(const Code& code) {
  std::string text;
  spvtools::SpirvTools tools(ENVIRONMENT);
  EXPECT_TRUE(tools.Disassemble(code, &text, SPV_BINARY_TO_TEXT_OPTION_NO_HEADER));
  return text;
}

const char* const CHOICE = R"(
    OpSelectionMerge %meet None
    OpBranchConditional %choice %left %right
    %left = OpLabel
    OpBranch %meet
    %right = OpLabel
    %read = OpLoad %uint %place
    OpBranch %meet
    %meet = OpLabel
    %value = OpPhi %uint %one %left %read %right
    OpStore %place %value
    OpReturn)";

TEST(PrunedCode, FollowsAChoice) {
  const Code code = assemble(CHOICE);
  for (const uint32_t choice : {0u, 1u}) {
    const std::array<uint32_t, 3> constants{9, 9, choice};
    const Code pruned = prunedOf(code, constants);
    EXPECT_EQ(faultsOf(pruned), "");
    EXPECT_LT(pruned.size(), code.size());
    EXPECT_EQ(textOf(pruned).find("OpLoad") == std::string::npos, choice == 1);
  }
  EXPECT_EQ(prunedOf(code, {}), prunedOf(code, std::array<uint32_t, 3>{0, 0, 1}));
}

TEST(PrunedCode, KnowsThePhiThatAChoiceDecides) {
  // What is left of the phi decides the second branch.
  const Code code = assemble(R"(
    OpSelectionMerge %meet None
    OpBranchConditional %choice %left %right
    %left = OpLabel
    OpBranch %meet
    %right = OpLabel
    OpBranch %meet
    %meet = OpLabel
    %value = OpPhi %uint %one %left %two %right
    %second = OpIEqual %bool %value %two
    OpSelectionMerge %end None
    OpBranchConditional %second %write %end
    %write = OpLabel
    OpStore %place %value
    OpBranch %end
    %end = OpLabel
    OpReturn)");
  EXPECT_EQ(actsOf(prunedOf(code, std::array<uint32_t, 3>{0, 0, 1}))[OP_STORE], 0);
  const Code kept = prunedOf(code, std::array<uint32_t, 3>{0, 0, 0});
  EXPECT_EQ(actsOf(kept)[OP_STORE], 1);
  EXPECT_EQ(faultsOf(kept), "");
}

const char* const LOOP = R"(
    OpBranch %head
    %head = OpLabel
    %count = OpPhi %uint %zero %entry %next %again
    OpLoopMerge %after %again None
    OpBranch %test
    %test = OpLabel
    OpSelectionMerge %go None
    OpBranchConditional %choice %leave %go
    %leave = OpLabel
    OpBranch %after
    %go = OpLabel
    OpStore %place %count
    OpBranch %again
    %again = OpLabel
    %next = OpIAdd %uint %count %one
    %more = OpULessThan %bool %next %two
    OpBranchConditional %more %head %after
    %after = OpLabel
    OpReturn)";

TEST(PrunedCode, LeavesAModuleWhoseLoopEndsBeforeItsFirstTurn) {
  const Code code = assemble(LOOP);
  EXPECT_EQ(prunedOf(code, std::array<uint32_t, 3>{0, 0, 1}), code);
  const Code turns = prunedOf(code, std::array<uint32_t, 3>{0, 0, 0});
  EXPECT_EQ(faultsOf(turns), "");
  EXPECT_LT(turns.size(), code.size());
  EXPECT_EQ(actsOf(turns)[OP_STORE], 1);
}

TEST(PrunedCode, LeavesAModuleWhoseLoopHasOneTurn) {
  const Code code = assemble(R"(
    OpBranch %head
    %head = OpLabel
    %count = OpPhi %uint %zero %entry %next %again
    OpLoopMerge %after %again None
    OpBranch %again
    %again = OpLabel
    OpStore %place %count
    %next = OpIAdd %uint %count %one
    OpBranchConditional %choice %head %after
    %after = OpLabel
    OpReturn)");
  EXPECT_EQ(prunedOf(code, std::array<uint32_t, 3>{0, 0, 0}), code);
}

TEST(PrunedCode, DecoratesNothingThatIsGone) {
  const Code code =
      assemble(R"(
    OpSelectionMerge %meet None
    OpBranchConditional %choice %left %meet
    %left = OpLabel
    %sum = OpFAdd %float %half %half
    %bits = OpBitcast %uint %sum
    OpStore %place %bits
    OpBranch %meet
    %meet = OpLabel
    OpReturn)",
               "OpName %left \"left\"\nOpName %sum \"sum\"", "OpDecorate %sum NoContraction");
  const Code pruned = prunedOf(code, std::array<uint32_t, 3>{0, 0, 0});
  EXPECT_EQ(faultsOf(pruned), "");
  EXPECT_EQ(textOf(pruned).find("NoContraction"), std::string::npos);
  const Code kept = prunedOf(code, std::array<uint32_t, 3>{0, 0, 1});
  EXPECT_EQ(faultsOf(kept), "");
  EXPECT_NE(textOf(kept).find("NoContraction"), std::string::npos);
}

TEST(PrunedCode, KeepsTheBlockWhereBranchesMeetThatNeverDo) {
  // Both sides return where the choice is made, and the other branch is not decided.
  const Code code = assemble(R"(
    %read = OpLoad %uint %place
    %unknown = OpIEqual %bool %read %two
    OpSelectionMerge %meet None
    OpBranchConditional %unknown %left %right
    %left = OpLabel
    OpReturn
    %right = OpLabel
    OpSelectionMerge %inner None
    OpBranchConditional %choice %done %inner
    %done = OpLabel
    OpReturn
    %inner = OpLabel
    OpBranch %meet
    %meet = OpLabel
    OpStore %place %one
    OpReturn)");
  const Code pruned = prunedOf(code, std::array<uint32_t, 3>{0, 0, 1});
  EXPECT_EQ(faultsOf(pruned), "");
  EXPECT_EQ(actsOf(pruned)[OP_STORE], 0);
  EXPECT_NE(textOf(pruned).find("OpUnreachable"), std::string::npos);
}

TEST(PrunedCode, KeepsWhatWritesThroughAPointer) {
  const Code code = assemble(R"(
    %part = OpExtInst %float %std Modf %half %whole
    %unused = OpExtInst %float %std Fract %half
    %read = OpLoad %float %whole
    %written = OpConvertFToU %uint %read
    OpStore %place %written
    OpReturn)");
  const std::string text = textOf(prunedOf(code, {}));
  EXPECT_NE(text.find("Modf"), std::string::npos);
  EXPECT_EQ(text.find("Fract"), std::string::npos);
}

TEST(PrunedCode, LeavesWhatIsNoModule) {
  const Code code = assemble(CHOICE);
  EXPECT_EQ(prunedOf({}, {}), Code{});
  EXPECT_EQ(prunedOf(Code{1, 2, 3, 4, 5, 6}, {}), (Code{1, 2, 3, 4, 5, 6}));
  for (const size_t words : {size_t{5}, size_t{6}, code.size() - 1, code.size() - 9}) {
    const Code part(code.begin(), code.begin() + static_cast<ptrdiff_t>(words));
    prunedOf(part, {});  // no reading past the end
  }
}

}  // namespace
}  // namespace welkin::vk
