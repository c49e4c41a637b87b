// SPDX-License-Identifier: MIT
#include "vk/pruned_code.hpp"

#include <algorithm>
#include <optional>

#include "vk/spirv.hpp"

namespace welkin::vk {
namespace {

constexpr uint32_t NONE = ~0u;

class Pruner {
 public:
  Pruner(std::span<const uint32_t> code, std::span<const uint32_t> constants,
         std::pmr::memory_resource* memory)
      : code_(code),
        constants_(constants),
        memory_(memory),
        values_(code[3], memory),
        specId_(code[3], NONE, memory),
        blockOf_(code[3], NONE, memory),
        definition_(code[3], NONE, memory),
        blocks_(memory),
        live_(memory),
        used_(memory),
        lost_(memory) {}

  // False where the module has to stay as it is.
  bool prune() {
    if (!read()) {
      return false;
    }
    // Every round knows more values of phis from the branches found so far.
    for (size_t before = 0, now = blocks_.size() + 1; now != before;) {
      before = now;
      evaluate();
      now = reach();
    }
    for (const Block& block : blocks_) {
      if (block.reached && block.merge != NONE && opAt(block.merge) == OP_LOOP_MERGE &&
          !turns(block)) {
        return false;
      }
    }
    keepUsed();
    findLost();
    return true;
  }

  // What is left, into memory that has room for all.
  void write(std::pmr::vector<uint32_t>& out) const {
    out.assign(code_.begin(), code_.begin() + HEADER_WORDS);
    for (uint32_t at = HEADER_WORDS; at < bodies_; at += wordsAt(at)) {
      const bool names = opAt(at) == OP_NAME || opAt(at) == OP_DECORATE;
      if (!names || !lost_[code_[at + 1]]) {
        out.insert(out.end(), code_.begin() + at, code_.begin() + at + wordsAt(at));
      }
    }
    for (uint32_t at = bodies_; at < code_.size();) {
      if (opAt(at) != OP_LABEL) {
        out.insert(out.end(), code_.begin() + at, code_.begin() + at + wordsAt(at));
        at += wordsAt(at);
        continue;
      }
      const Block& block = blocks_[blockOf_[code_[at + 1]]];
      if (block.reached) {
        writeBlock(block, out);
      } else if (block.named) {
        out.insert(out.end(), {code_[at], code_[at + 1], OP_UNREACHABLE | 1u << 16});
      }
      at = block.end;
    }
  }

 private:
  struct Block {
    uint32_t label = 0;   // id
    uint32_t begin = 0;   // words, of the label
    uint32_t branch = 0;  // of what ends it
    uint32_t end = 0;
    uint32_t merge = NONE;  // of what names the block where its branches meet
    bool first = false;     // of its function
    bool reached = true;
    bool named = false;  // where branches meet that are not decided
  };

  uint32_t opAt(uint32_t at) const { return code_[at] & 0xffffu; }
  uint32_t wordsAt(uint32_t at) const { return code_[at] >> 16; }
  std::span<const uint32_t> instruction(uint32_t at) const {
    return code_.subspan(at, wordsAt(at));
  }
  bool reached(uint32_t label) const { return blocks_[blockOf_[label]].reached; }

  // Blocks, and where what a function computes is defined. False if it is not a module.
  bool read() {
    Block block;
    bool inside = false;
    bool first = false;
    for (uint32_t at = HEADER_WORDS; at < code_.size(); at += wordsAt(at)) {
      if (wordsAt(at) == 0 || at + wordsAt(at) > code_.size()) {
        return false;
      }
      const uint32_t op = opAt(at);
      if (op == OP_FUNCTION) {
        bodies_ = bodies_ == NONE ? at : bodies_;
        first = true;
      } else if (op == OP_LABEL) {
        if (inside) {
          return false;  // ended by what is not known here
        }
        block = {code_[at + 1], at, 0, 0, NONE, first};
        inside = true;
        first = false;
      } else if (inside && (op == OP_SELECTION_MERGE || op == OP_LOOP_MERGE)) {
        block.merge = at;
      } else if (inside && op >= OP_BRANCH && op <= OP_UNREACHABLE) {
        block.branch = at;
        block.end = at + wordsAt(at);
        blockOf_[block.label] = static_cast<uint32_t>(blocks_.size());
        blocks_.push_back(block);
        inside = false;
      } else if (inside && isPure(instruction(at))) {
        definition_[code_[at + 2]] = at;
      } else if (op == OP_DECORATE && code_[at + 2] == SPEC_ID) {
        specId_[code_[at + 1]] = code_[at + 3];
      }
    }
    bool known = bodies_ != NONE && !inside;
    for (const Block& one : blocks_) {
      forTargets(one, [&](uint32_t label) { known = known && blockOf_[label] != NONE; });
    }
    return known;
  }

  // Values that the constants decide, of all that is reached.
  void evaluate() {
    for (uint32_t at = HEADER_WORDS; at < bodies_; at += wordsAt(at)) {
      const std::span<const uint32_t> words = instruction(at);
      const uint32_t op = opAt(at);
      if (op == OP_CONSTANT_TRUE || op == OP_CONSTANT_FALSE) {
        values_[words[2]] = op == OP_CONSTANT_TRUE;
      } else if (op == OP_CONSTANT && words.size() == 4) {
        values_[words[2]] = words[3];
      } else if (op == OP_SPEC_TRUE || op == OP_SPEC_FALSE) {
        const uint32_t id = specId_[words[2]];
        values_[words[2]] = id < constants_.size() ? constants_[id] != 0 : op == OP_SPEC_TRUE;
      } else if (op == OP_SPEC_CONSTANT && words.size() == 4) {
        const uint32_t id = specId_[words[2]];
        values_[words[2]] = id < constants_.size() ? constants_[id] : words[3];
      } else if (op == OP_SPEC_OPERATION && words[3] >= OP_IADD && words[3] <= OP_BITWISE_AND) {
        values_[words[2]] = valueOf(words[3], words.subspan(4));
      }
    }
    for (const Block& block : blocks_) {
      for (uint32_t at = block.begin; block.reached && at < block.branch; at += wordsAt(at)) {
        const std::span<const uint32_t> words = instruction(at);
        if (opAt(at) == OP_PHI) {
          values_[words[2]] = values_[words[2]] ? values_[words[2]] : valueOfPhi(block, words);
        } else if (opAt(at) >= OP_IADD && opAt(at) <= OP_BITWISE_AND) {
          values_[words[2]] = valueOf(opAt(at), words.subspan(3));
        }
      }
    }
  }

  std::optional<uint32_t> valueOfPhi(const Block& block, std::span<const uint32_t> words) const {
    std::optional<uint32_t> value;
    for (size_t i = 3; i + 1 < words.size(); i += 2) {
      if (!leads(words[i + 1], block.label)) {
        continue;
      }
      const std::optional<uint32_t>& one = values_[words[i]];
      if (!one || (value && *value != *one)) {
        return std::nullopt;
      }
      value = one;
    }
    return value;
  }

  // Of what decides branches: booleans and integers of 32 bits.
  std::optional<uint32_t> valueOf(uint32_t op, std::span<const uint32_t> operands) const {
    const std::optional<uint32_t> a = values_[operands[0]];
    const std::optional<uint32_t> b = operands.size() > 1 ? values_[operands[1]] : a;
    if (op == OP_LOGICAL_AND && ((a && *a == 0) || (b && *b == 0))) {
      return 0;
    }
    if (op == OP_LOGICAL_OR && ((a && *a != 0) || (b && *b != 0))) {
      return 1;
    }
    if (op == OP_SELECT) {
      return a ? values_[operands[*a != 0 ? 1 : 2]] : std::nullopt;
    }
    if (!a || !b) {
      return std::nullopt;
    }
    switch (op) {
      case OP_LOGICAL_AND:
      case OP_BITWISE_AND:
        return *a & *b;
      case OP_LOGICAL_OR:
      case OP_BITWISE_OR:
        return *a | *b;
      case OP_LOGICAL_NOT:
        return *a == 0;
      case OP_LOGICAL_EQUAL:
      case OP_IEQUAL:
        return *a == *b;
      case OP_LOGICAL_NOT_EQUAL:
      case OP_INOT_EQUAL:
        return *a != *b;
      case OP_UGREATER:
        return *a > *b;
      case OP_UGREATER_EQUAL:
        return *a >= *b;
      case OP_ULESS:
        return *a < *b;
      case OP_ULESS_EQUAL:
        return *a <= *b;
      case OP_IADD:
        return *a + *b;
      case OP_ISUB:
        return *a - *b;
      default:
        return std::nullopt;
    }
  }

  // Where a decided branch goes, else NONE.
  uint32_t decided(const Block& block) const {
    if (opAt(block.branch) != OP_BRANCH_CONDITIONAL) {
      return NONE;
    }
    const std::optional<uint32_t>& value = values_[code_[block.branch + 1]];
    return value ? code_[block.branch + (*value != 0 ? 2 : 3)] : NONE;
  }

  // Calls `visit` with every label that the block may branch to.
  template <class Visit>
  void forTargets(const Block& block, const Visit& visit) const {
    const uint32_t op = opAt(block.branch);
    const uint32_t only = decided(block);
    if (only != NONE) {
      visit(only);
    } else if (op == OP_BRANCH) {
      visit(code_[block.branch + 1]);
    } else if (op == OP_BRANCH_CONDITIONAL) {
      visit(code_[block.branch + 2]);
      visit(code_[block.branch + 3]);
    } else if (op == OP_SWITCH) {
      // Its selector has 32 bits.
      for (uint32_t at = block.branch + 2; at < block.end; at += 2) {
        visit(code_[at]);
      }
    }
  }

  bool leads(uint32_t from, uint32_t to) const {
    const Block& block = blocks_[blockOf_[from]];
    bool result = false;
    if (block.reached) {
      forTargets(block, [&](uint32_t label) { result = result || label == to; });
    }
    return result;
  }

  // Marks what is reached, and returns how many blocks are.
  size_t reach() {
    std::pmr::vector<uint32_t> open(memory_);
    for (uint32_t i = 0; i < blocks_.size(); ++i) {
      blocks_[i].reached = blocks_[i].first;
      if (blocks_[i].first) {
        open.push_back(i);
      }
    }
    size_t count = open.size();
    while (!open.empty()) {
      const uint32_t i = open.back();
      open.pop_back();
      forTargets(blocks_[i], [&](uint32_t label) {
        Block& target = blocks_[blockOf_[label]];
        if (!target.reached) {
          target.reached = true;
          open.push_back(blockOf_[label]);
          ++count;
        }
      });
    }
    return count;
  }

  // Whether a loop still has a turn: a block that goes back to its head.
  bool turns(const Block& head) const {
    return reached(code_[head.merge + 2]) &&
           std::any_of(blocks_.begin() + blockOf_[head.label], blocks_.end(),
                       [&](const Block& block) { return leads(block.label, head.label); });
  }

  // Calls `visit` with the place of each instruction that stays if it is used: all of the blocks
  // reached, without those that decided branches no longer need.
  template <class Visit>
  void forReached(const Visit& visit) const {
    for (const Block& block : blocks_) {
      for (uint32_t at = block.begin; block.reached && at < block.end; at += wordsAt(at)) {
        visit(block, at);
      }
    }
  }

  void use(std::span<const uint32_t> ids) {
    for (const uint32_t id : ids) {
      // Literals may look like ids: what they name stays, too.
      if (id < definition_.size() && definition_[id] != NONE && !used_[definition_[id]]) {
        used_[definition_[id]] = true;
        live_.push_back(definition_[id]);
      }
    }
  }

  // Marks what stays: what does something, and all that it needs.
  void keepUsed() {
    used_.assign(code_.size(), false);
    forReached([&](const Block& block, uint32_t at) {
      if (at == block.branch && decided(block) != NONE) {
        return;
      }
      if (!isPure(instruction(at))) {
        used_[at] = true;
        use(instruction(at).subspan(1));
      }
      if (at == block.merge && !droppedMerge(block)) {
        blocks_[blockOf_[code_[at + 1]]].named = true;
      }
    });
    while (!live_.empty()) {
      const uint32_t at = live_.back();
      const std::span<const uint32_t> words = instruction(at);
      live_.pop_back();
      if (opAt(at) != OP_PHI) {
        use(words.subspan(1));
        continue;
      }
      const auto after =
          std::upper_bound(blocks_.begin(), blocks_.end(), at,
                           [](uint32_t place, const Block& block) { return place < block.begin; });
      for (size_t i = 3; i + 1 < words.size(); i += 2) {
        if (leads(words[i + 1], std::prev(after)->label)) {
          use(words.subspan(i, 1));
        }
      }
    }
  }

  // Marks the ids that nothing defines any more.
  void findLost() {
    lost_.assign(code_[3], false);
    for (const Block& block : blocks_) {
      for (uint32_t at = block.begin; at < block.end; at += wordsAt(at)) {
        const bool label = at == block.begin && (block.reached || block.named);
        if (!label && !used_[at]) {
          lost_[resultOf(instruction(at))] = true;
        }
      }
    }
  }

  bool droppedMerge(const Block& block) const {
    return decided(block) != NONE && opAt(block.merge) == OP_SELECTION_MERGE;
  }

  void writePhi(const Block& block, std::span<const uint32_t> words,
                std::pmr::vector<uint32_t>& out) const {
    const size_t begin = out.size();
    out.insert(out.end(), words.begin(), words.begin() + 3);
    for (size_t i = 3; i + 1 < words.size(); i += 2) {
      if (leads(words[i + 1], block.label)) {
        out.insert(out.end(), {words[i], words[i + 1]});
      }
    }
    out[begin] = OP_PHI | static_cast<uint32_t>(out.size() - begin) << 16;
  }

  void writeBlock(const Block& block, std::pmr::vector<uint32_t>& out) const {
    for (uint32_t at = block.begin; at < block.branch; at += wordsAt(at)) {
      const std::span<const uint32_t> words = instruction(at);
      if (!used_[at] || (at == block.merge && droppedMerge(block))) {
        continue;
      }
      if (opAt(at) == OP_PHI) {
        writePhi(block, words, out);
      } else {
        out.insert(out.end(), words.begin(), words.end());
      }
    }
    const uint32_t only = decided(block);
    if (only != NONE) {
      out.insert(out.end(), {OP_BRANCH | 2u << 16, only});
    } else {
      const std::span<const uint32_t> words = instruction(block.branch);
      out.insert(out.end(), words.begin(), words.end());
    }
  }

  std::span<const uint32_t> code_;
  std::span<const uint32_t> constants_;
  std::pmr::memory_resource* memory_;
  std::pmr::vector<std::optional<uint32_t>> values_;  // of ids
  std::pmr::vector<uint32_t> specId_;                 // of ids
  std::pmr::vector<uint32_t> blockOf_;                // of labels
  std::pmr::vector<uint32_t> definition_;             // of ids that come of nothing but themselves
  std::pmr::vector<Block> blocks_;
  std::pmr::vector<uint32_t> live_;  // places whose operands are still to be marked
  std::pmr::vector<bool> used_;      // of words where what stays begins
  std::pmr::vector<bool> lost_;      // ids
  uint32_t bodies_ = NONE;           // where functions begin
};

}  // namespace

std::pmr::vector<uint32_t> prunedCode(std::span<const uint32_t> code,
                                      std::span<const uint32_t> constants,
                                      std::pmr::memory_resource* memory) {
  std::pmr::vector<uint32_t> all(code.begin(), code.end(), memory);
  if (code.size() <= HEADER_WORDS || code[0] != MAGIC) {
    return all;
  }
  // One block from the host for all of the work: 20 bytes for each id, and what grows with the
  // code.
  const size_t room = size_t{20} * code[3] + size_t{6} * code.size();
  std::pmr::monotonic_buffer_resource work(room, memory);
  Pruner pruner(code, constants, &work);
  if (pruner.prune()) {
    pruner.write(all);
  }
  return all;
}

}  // namespace welkin::vk
