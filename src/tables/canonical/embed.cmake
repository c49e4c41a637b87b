# SPDX-License-Identifier: MIT
# cmake -DIN=slab.bin -DOUT=canonical_slab.h -P embed.cmake: big-endian words as a C array.
file(READ ${IN} digits HEX)
string(REGEX REPLACE "(........)(........)(........)(........)" "0x\\1,0x\\2,0x\\3,0x\\4,\n" words
       "${digits}")
file(WRITE ${OUT} "constexpr uint32_t CANONICAL_WORDS[] = {\n${words}};\n")
