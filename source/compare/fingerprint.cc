// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/fingerprint.h"

#include <cstdio>
#include <cstring>

namespace tetradapt::compare
{
  namespace
  {
    std::uint64_t
    rotate(const std::uint64_t x, const unsigned int bits)
    {
      return (x << bits) | (x >> (64 - bits));
    }

    /** Spreads every bit of x over all bits (Stafford's variant of the finaliser of
     * MurmurHash3, as splitmix64 uses it). */
    std::uint64_t
    mix(std::uint64_t x)
    {
      x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
      x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
      return x ^ (x >> 31);
    }
  } // namespace

  void
  Fingerprint::add_word(const std::uint64_t word)
  {
    // Odd multipliers and rotations are invertible: no word is ever lost.
    first  = rotate((first ^ word) * 0x9e3779b97f4a7c15ULL, 29);
    second = rotate(second + word * 0xc2b2ae3d27d4eb4fULL, 31) * 0x165667b19e3779f9ULL;
  }

  void
  Fingerprint::add(const void *bytes, const std::size_t size)
  {
    const char   *begin = static_cast<const char *>(bytes);
    std::uint64_t word;
    std::size_t   i = 0;
    for (; i + sizeof(word) <= size; i += sizeof(word))
      {
        std::memcpy(&word, begin + i, sizeof(word));
        add_word(word);
      }
    if (i < size)
      {
        word = 0;
        std::memcpy(&word, begin + i, size - i);
        add_word(word);
      }
    length += size;
    add_word(length);
  }

  void
  Fingerprint::add(const std::string &text)
  {
    add(text.data(), text.size());
  }

  std::string
  Fingerprint::hex() const
  {
    const std::uint64_t a = mix(first ^ mix(second)), b = mix(second + mix(first));
    char                text[33];
    std::snprintf(text,
                  sizeof(text),
                  "%016llx%016llx",
                  static_cast<unsigned long long>(a),
                  static_cast<unsigned long long>(b));
    return text;
  }
} // namespace tetradapt::compare
