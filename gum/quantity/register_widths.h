#pragma once

// Loops over many numbers run in the widest registers that the machine has: GUMCERT_WIDE_CLONES before a function makes
// the compiler build it for each width, and the program takes the widest at its start. The instructions are the same
// IEEE 754 operations on each number, and FMA, which would round differently, stays out (-ffp-contract=off): so all
// widths give the same bits. A test (tests/register_widths) defines GUMCERT_REGISTERS to build one width alone.
#if defined(GUMCERT_REGISTERS)
#define GUMCERT_WIDE_CLONES __attribute__((target(GUMCERT_REGISTERS)))
#elif defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define GUMCERT_WIDE_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define GUMCERT_WIDE_CLONES
#endif

// What its loops say to g++ ("#pragma GCC ivdep") is nothing to Clang.
#if defined(__clang__)
#pragma clang diagnostic ignored "-Wunknown-pragmas"
#endif
