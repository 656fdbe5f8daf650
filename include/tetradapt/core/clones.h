// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_clones_h
#define tetradapt_core_clones_h

/**
 * TETRADAPT_CLONES before a function has it compiled for several instruction sets; the
 * loader picks the best that the processor has, where it can (GCC and glibc on x86-64). The
 * function must be no template and no member of one: GCC ignores it there.
 *
 * What such a function calls must become part of it to profit: TETRADAPT_INLINE. Nothing
 * else becomes part of it, not even operator[] of a std::vector or std::max: inside,
 * pointers and plain arrays only.
 */
#if defined(__x86_64__) && defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__)              \
  && defined(__GLIBC__)
#define TETRADAPT_CLONES                                                                           \
  __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define TETRADAPT_CLONES
#endif

#if defined(__GNUC__)
#define TETRADAPT_INLINE inline __attribute__((always_inline))
#else
#define TETRADAPT_INLINE inline
#endif

#endif
