// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_io_byte_source_h
#define tetradapt_io_byte_source_h

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tetradapt::io
{
  /** Bytes one after the other, from memory as they are or in base64. Padding
   * may end any group of base64 and more may follow: VTK encodes the header and
   * the data of a compressed array one by one. */
  class ByteSource
  {
  public:
    /** @param fail throws the message that it is given. */
    ByteSource(std::string_view                                content,
               bool                                            base64,
               const std::function<void(const std::string &)> &fail)
      : rest(content), base64(base64), fail(fail)
    {
    }

    void
    read(unsigned char *target, std::size_t n);

    /** At least as many bytes as can still be read. */
    std::size_t
    remaining() const
    {
      return n_decoded - decoded_place + (base64 ? rest.size() / 4 * 3 + 3 : rest.size());
    }

    /** Decompresses @p compressed by zlib; the result must have @p size bytes. */
    void
    inflate(std::size_t compressed, unsigned char *target, std::size_t size);

  private:
    void
    decode_group();

    std::string_view                                rest;
    bool                                            base64;
    const std::function<void(const std::string &)> &fail;
    unsigned char                                   decoded[3]    = {0, 0, 0};
    unsigned int                                    n_decoded     = 0;
    unsigned int                                    decoded_place = 0;
    std::vector<unsigned char>                      buffer;
  };

  /** How the arrays of one file are stored. */
  struct BinaryLayout
  {
    bool         compressed   = false;
    bool         swap         = false; ///< bytes of a number are in the other order
    unsigned int header_bytes = 4;     ///< 4 or 8
  };

  /** The bytes of one array behind its header, decompressed.
   * @param most bytes that the array may have: a longer one is refused before memory is
   *        taken for it, as a few compressed bytes may stand for a thousand times as many. */
  std::vector<unsigned char>
  read_array(ByteSource                                     &source,
             const BinaryLayout                             &layout,
             std::uint64_t                                   most,
             const std::function<void(const std::string &)> &fail);

  /**
   * @p n_bytes bytes as VTK's vtkZLibDataCompressor has them, with a header of
   * 64-bit numbers: what read_array() reads.
   * @param shrink whether to compress (at zlib's fastest level) or only to store.
   */
  std::string
  compressed_array(const unsigned char *data, std::size_t n_bytes, bool shrink);
} // namespace tetradapt::io

#endif
