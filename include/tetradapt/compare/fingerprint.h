// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_fingerprint_h
#define tetradapt_compare_fingerprint_h

#include <cstddef>
#include <cstdint>
#include <string>

namespace tetradapt::compare
{
  /**
   * A 128-bit hash of a sequence of bytes, to tell inputs apart and to notice
   * damage. Two 64-bit lanes take in each 8-byte word by different multiplications
   * and rotations and are mixed at the end: equal sequences give equal hashes,
   * two different ones by chance with probability 2^-128. Not made to
   * withstand somebody who looks for collisions. Several GB/s; the value depends on
   * the processor's order of bytes.
   */
  class Fingerprint
  {
  public:
    void
    add(const void *bytes, std::size_t size);

    /** Adds a text and its length, so that ("ab", "c") differs from ("a", "bc"). */
    void
    add(const std::string &text);

    /** The hash of all that was added, 32 hexadecimal digits. */
    std::string
    hex() const;

  private:
    void
    add_word(std::uint64_t word);

    std::uint64_t first = 0x243f6a8885a308d3ULL, second = 0x13198a2e03707344ULL;
    std::uint64_t length = 0;
  };
} // namespace tetradapt::compare

#endif
