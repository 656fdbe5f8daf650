// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_function_clones_h
#define tetradapt_core_function_clones_h

/**
 * Put before a function, TETRADAPT_CLONES has it compiled for processors with 512-bit vectors,
 * with 256-bit ones and for any: the program takes the best when it starts. What it
 * calls has to become part of it, by TETRADAPT_PART_OF_CLONES, or be cloned itself, else it
 * is compiled for any processor only.
 */
#if defined(__x86_64__) && defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__)
#define TETRADAPT_CLONES                                                                           \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define TETRADAPT_CLONES
#endif
#define TETRADAPT_PART_OF_CLONES inline __attribute__((always_inline))

#endif
