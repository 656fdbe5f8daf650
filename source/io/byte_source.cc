// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/io/byte_source.h"

#include "tetradapt/core/exceptions.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace tetradapt::io
{
  namespace
  {
    constexpr unsigned char invalid = 255;



    /** The value of each letter of base64. */
    std::array<unsigned char, 256>
    base64_values()
    {
      std::array<unsigned char, 256> values;
      values.fill(invalid);
      const std::string letters
        = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
      for (unsigned int i = 0; i < letters.size(); ++i)
        values[static_cast<unsigned char>(letters[i])] = i;
      return values;
    }
  } // namespace



  void
  ByteSource::decode_group()
  {
    static const std::array<unsigned char, 256> values = base64_values();

    unsigned int  n_letters = 0, n_padding = 0;
    std::uint32_t bits = 0;
    while (n_letters + n_padding < 4)
      {
        if (rest.empty())
          fail("the array is cut off.");
        const char c = rest.front();
        rest.remove_prefix(1);
        if (c == ' ' || (c >= '\t' && c <= '\r'))
          continue;
        const unsigned char value = values[static_cast<unsigned char>(c)];
        if (c == '=' && n_letters >= 2)
          ++n_padding;
        else if (value != invalid && n_padding == 0)
          {
            bits |= static_cast<std::uint32_t>(value) << (18 - 6 * n_letters);
            ++n_letters;
          }
        else
          fail("the array is cut off, or its base64 text is damaged.");
      }
    decoded[0]    = bits >> 16 & 255;
    decoded[1]    = bits >> 8 & 255;
    decoded[2]    = bits & 255;
    n_decoded     = 3 - n_padding;
    decoded_place = 0;
  }



  void
  ByteSource::read(unsigned char *target, const std::size_t n)
  {
    if (!base64)
      {
        if (n > rest.size())
          fail("the array is cut off: it needs " + std::to_string(n) + " bytes and "
               + std::to_string(rest.size()) + " are left.");
        if (n > 0)
          std::memcpy(target, rest.data(), n);
        rest.remove_prefix(n);
        return;
      }
    for (std::size_t i = 0; i < n; ++i)
      {
        if (decoded_place == n_decoded)
          decode_group();
        target[i] = decoded[decoded_place++];
      }
  }



  void
  ByteSource::inflate(const std::size_t compressed, unsigned char *target, const std::size_t size)
  {
    if (compressed > remaining())
      fail("the array is cut off.");
    buffer.resize(compressed);
    read(buffer.data(), compressed);
    uLongf length = size;
    if (::uncompress(target, &length, buffer.data(), compressed) != Z_OK || length != size)
      fail("a compressed block is damaged.");
  }



  std::vector<unsigned char>
  read_array(ByteSource                                     &source,
             const BinaryLayout                             &layout,
             const std::uint64_t                             most,
             const std::function<void(const std::string &)> &fail)
  {
    const auto too_long = [&]() {
      fail("it holds more than the " + std::to_string(most)
           + " bytes that it can have by the sizes that the file states.");
    };
    const auto header = [&]() -> std::uint64_t {
      unsigned char bytes[8];
      source.read(bytes, layout.header_bytes);
      if (layout.swap)
        std::reverse(bytes, bytes + layout.header_bytes);
      std::uint32_t small = 0;
      std::uint64_t large = 0;
      std::memcpy(&small, bytes, 4);
      if (layout.header_bytes == 8)
        std::memcpy(&large, bytes, 8);
      return layout.header_bytes == 8 ? large : small;
    };

    std::vector<unsigned char> data;
    const std::uint64_t        first = header();
    if (!layout.compressed)
      {
        if (first > source.remaining())
          fail("the array is cut off: its header promises " + std::to_string(first) + " bytes.");
        if (first > most)
          too_long();
        data.resize(first);
        source.read(data.data(), first);
        return data;
      }

    // Number of blocks, size of a block, size of the last one (0: a whole one),
    // compressed size of each.
    const std::uint64_t block_size = header();
    const std::uint64_t last_size  = header();
    if (first > source.remaining() / layout.header_bytes)
      fail("the array is cut off: its header promises " + std::to_string(first) + " blocks.");
    std::vector<std::uint64_t> compressed(first);
    std::uint64_t              total = 0, total_compressed = 0;
    for (std::size_t b = 0; b < first; ++b)
      {
        compressed[b]            = header();
        const std::uint64_t size = (b + 1 == first && last_size != 0) ? last_size : block_size;
        // zlib cannot compress better than 1 : 1032.
        total_compressed += std::min<std::uint64_t>(compressed[b], source.remaining() + 1);
        if (total_compressed > source.remaining() || size > 1032 * compressed[b] + 64)
          fail("the array is cut off, or its header is damaged.");
        total += size;
        if (total > most)
          too_long();
      }
    data.resize(total);
    std::size_t place = 0;
    for (std::size_t b = 0; b < first; ++b)
      {
        const std::size_t size = (b + 1 == first && last_size != 0) ? last_size : block_size;
        source.inflate(compressed[b], data.data() + place, size);
        place += size;
      }
    return data;
  }



  std::string
  compressed_array(const unsigned char *data, const std::size_t n_bytes, const bool shrink)
  {
    constexpr std::size_t      block_bytes = 1 << 20;
    const std::size_t          n_blocks    = (n_bytes + block_bytes - 1) / block_bytes;
    const std::size_t          start       = (3 + n_blocks) * sizeof(std::uint64_t);
    std::vector<std::uint64_t> header{n_blocks, block_bytes, n_bytes % block_bytes};
    // Most arrays are single numbers: room for a whole block each would cost more than all else.
    std::string result(start + n_blocks * ::compressBound(std::min(block_bytes, n_bytes)), '\0');
    std::size_t place = start;
    for (std::size_t b = 0; b < n_blocks; ++b)
      {
        uLongf length = result.size() - place;
        if (::compress2(reinterpret_cast<Bytef *>(&result[place]),
                        &length,
                        data + b * block_bytes,
                        std::min(block_bytes, n_bytes - b * block_bytes),
                        shrink ? Z_BEST_SPEED : Z_NO_COMPRESSION)
            != Z_OK)
          throw core::NumericalError("Compressing an array for a .vtu file failed.");
        header.push_back(length);
        place += length;
      }
    std::memcpy(&result[0], header.data(), start);
    result.resize(place);
    result.shrink_to_fit();
    return result;
  }
} // namespace tetradapt::io
