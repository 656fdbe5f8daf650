// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_io_vtk_scanner_h
#define tetradapt_io_vtk_scanner_h

#include "tetradapt/io/file_scanner.h"
#include "tetradapt/io/scalar_types.h"

#include <vector>

namespace tetradapt::io
{
  /** Reads keyword lines and arrays of a legacy VTK file, ASCII or binary. */
  class VtkScanner : public FileScanner
  {
  public:
    explicit VtkScanner(const std::string &file) : FileScanner(file)
    {
    }

    /** Whether arrays are stored as bytes, the highest first. */
    void
    set_binary_arrays(bool binary)
    {
      binary_arrays = binary;
    }

    /** Splits the next line that is not blank into words(). False: none is left. */
    bool
    next_words();

    const std::vector<std::string> &
    words() const
    {
      return current_words;
    }

    /** The current line must have @p n words. */
    void
    need_words(std::size_t n) const;

    /** Word @p i of the current line as a count of things that take at least a
     * byte each in the rest of the file. */
    std::size_t
    word_count(std::size_t i, const char *what) const;

    /** Word @p i of the current line as a type of numbers. */
    ScalarType
    word_type(std::size_t i) const;

    /** The next @p n numbers; T is double or std::int64_t. */
    template <typename T>
    std::vector<T>
    values(std::size_t n, ScalarType type, const char *what);

    /** Goes behind a METADATA block, which ends with an empty line. */
    void
    skip_metadata();

  private:
    bool                     binary_arrays = false;
    std::vector<std::string> current_words;
  };
} // namespace tetradapt::io

#endif
