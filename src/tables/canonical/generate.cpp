// SPDX-License-Identifier: MIT
// welkin_canonical FILE: solves the canonical slab transport and writes its table, big-endian words
// in blocks of four.
#include <cstdio>
#include <ctime>
#include <fstream>

#include "tables/canonical_builder.hpp"

int main(int argc, char** argv) {
  using namespace welkin;
  if (argc != 2) {
    std::fprintf(stderr, "usage: welkin_canonical FILE\n");
    return 2;
  }
  const std::clock_t begin = std::clock();
  const auto seconds = [&] {
    return static_cast<double>(std::clock() - begin) / static_cast<double>(CLOCKS_PER_SEC);
  };
  const std::vector<double> moments = canonicalMoments(canonicalPhase(), CANONICAL_TERMS);
  CanonicalTable table;
  canonicalPhaseCurves(moments, table);
  CanonicalDraft draft = emptyCanonicalDraft();
  for (size_t i = 0; i < RADIANCE_GRID.thickness; ++i) {
    computeCanonical(i, moments, table, draft);
    std::printf("thickness %.4g: %.1f s\n", canonicalNodeThickness(i), seconds());
    std::fflush(stdout);
  }
  compressCanonical(draft, table);
  std::vector<uint32_t> words = encodeCanonical(table);
  words.resize((words.size() + 3) / 4 * 4);
  std::ofstream out(argv[1], std::ios::binary);
  for (const uint32_t word : words) {
    for (int shift = 24; shift >= 0; shift -= 8) {
      out.put(static_cast<char>(word >> shift & 255));
    }
  }
  std::printf("%zu bytes, %.1f CPU s\n", words.size() * 4, seconds());
  return out ? 0 : 1;
}
