// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/io/vtk_scanner.h"

#include <algorithm>

namespace tetradapt::io
{
  bool
  VtkScanner::next_words()
  {
    std::string_view text;
    current_words.clear();
    if (!next_line(text))
      return false;
    while (!text.empty())
      {
        const std::size_t n = std::min(text.find_first_of(" \t\r\v\f"), text.size());
        current_words.emplace_back(text.substr(0, n));
        text = trimmed(text.substr(n));
      }
    return true;
  }



  void
  VtkScanner::need_words(const std::size_t n) const
  {
    if (current_words.size() < n)
      fail("the line beginning with " + excerpt(current_words[0]) + " is too short.");
  }



  std::size_t
  VtkScanner::word_count(const std::size_t i, const char *what) const
  {
    need_words(i + 1);
    std::int64_t n;
    if (!parse(current_words[i], n) || n < 0)
      fail(excerpt(current_words[i]) + " stands where " + what + " is expected.");
    // Each value takes one byte at least.
    check_count(n, what, 1);
    return n;
  }



  ScalarType
  VtkScanner::word_type(const std::size_t i) const
  {
    need_words(i + 1);
    ScalarType result;
    if (!legacy_scalar_type(lower_case(current_words[i]), result))
      fail("arrays of type " + excerpt(current_words[i]) + " cannot be read. Leave it out.");
    return result;
  }



  template <typename T>
  std::vector<T>
  VtkScanner::values(const std::size_t n, const ScalarType type, const char *what)
  {
    if (n > 0 && n - 1 > remaining() / (binary_arrays ? size_of(type) : 2))
      fail(std::to_string(n) + " numbers (" + what + " each) should follow, but only "
           + std::to_string(remaining()) + " bytes are left: the file is cut off.");
    std::vector<T> result(n);
    if (binary_arrays)
      {
        set_binary(true);
        convert(type, raw(n * size_of(type), what), n, is_little_endian(), result.data());
        set_binary(false);
      }
    else if constexpr (std::is_integral_v<T>)
      for (T &value : result)
        value = integer(what);
    else
      for (T &value : result)
        value = number(what);
    return result;
  }



  template std::vector<double>
  VtkScanner::values(std::size_t, ScalarType, const char *);
  template std::vector<std::int64_t>
  VtkScanner::values(std::size_t, ScalarType, const char *);



  void
  VtkScanner::skip_metadata()
  {
    // It ends with an empty line, or with the file.
    while (remaining() > 0 && !trimmed(line()).empty())
      ;
  }
} // namespace tetradapt::io
