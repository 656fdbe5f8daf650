// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_io_scalar_types_h
#define tetradapt_io_scalar_types_h

#include <cstddef>
#include <cstdint>
#include <string>

namespace tetradapt::io
{
  /** Types of numbers in binary files. */
  enum class ScalarType
  {
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    int64,
    uint64,
    float32,
    float64
  };

  /** Bytes of a number. */
  std::size_t
  size_of(ScalarType type);

  /** The type that XML VTK files call @p name ("Float64"). False: none. */
  bool
  xml_scalar_type(const std::string &name, ScalarType &type);

  /** The type that legacy VTK files call @p name ("double"). False: none. */
  bool
  legacy_scalar_type(const std::string &name, ScalarType &type);

  /** Whether this machine stores the lowest byte of a number first. */
  bool
  is_little_endian();

  /** Converts @p n numbers at @p data, with their bytes reversed if @p swap, to
   * doubles or to integers (unsigned ones beyond the range become negative). */
  void
  convert(ScalarType type, const unsigned char *data, std::size_t n, bool swap, double *values);
  void
  convert(
    ScalarType type, const unsigned char *data, std::size_t n, bool swap, std::int64_t *values);
} // namespace tetradapt::io

#endif
