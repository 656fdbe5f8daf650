// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/io/file_scanner.h"

#include "tetradapt/core/exceptions.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace tetradapt::io
{
  namespace
  {
    bool
    is_space(const char c)
    {
      return c == ' ' || (c >= '\t' && c <= '\r');
    }
  } // namespace



  std::string
  read_file(const std::string &file)
  {
    std::error_code error;
    const auto      status = std::filesystem::status(file, error);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
      throw core::InputError("'" + file + "' is not a file but a folder or a device.");
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
      throw core::InputError("Cannot open '" + file + "': " + std::strerror(errno) + ".");
    const auto size = std::filesystem::file_size(file, error);
    if (error)
      throw core::InputError("Cannot read '" + file + "': " + error.message() + ".");
    if (size == 0)
      throw core::InputError("'" + file + "' is empty.");
    std::string content(size, '\0');
    if (!stream.read(content.data(), size))
      throw core::InputError("Cannot read '" + file + "': it ended after "
                             + std::to_string(stream.gcount()) + " of " + std::to_string(size)
                             + " bytes.");
    return content;
  }



  std::string
  excerpt(const std::string_view text)
  {
    std::string result = "'";
    for (const char c : text.substr(0, 40))
      result += (c >= ' ' && c <= '~') ? c : '?';
    return result + (text.size() > 40 ? "...'" : "'");
  }



  bool
  parse(std::string_view text, std::int64_t &value)
  {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-')
      text.remove_prefix(1);
    const char *end    = text.data() + text.size();
    const auto  result = std::from_chars(text.data(), end, value);
    return result.ec == std::errc() && result.ptr == end;
  }



  bool
  parse(std::string_view text, double &value)
  {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-')
      text.remove_prefix(1);
    const char *end    = text.data() + text.size();
    const auto  result = std::from_chars(text.data(), end, value);
    if (result.ptr != end || text.empty())
      return false;
    // Too small a number is zero or subnormal, which from_chars does not say.
    if (result.ec == std::errc::result_out_of_range)
      value = std::strtod(std::string(text).c_str(), nullptr);
    else if (result.ec != std::errc())
      return false;
    return std::isfinite(value);
  }



  std::string_view
  trimmed(std::string_view text)
  {
    while (!text.empty() && is_space(text.front()))
      text.remove_prefix(1);
    while (!text.empty() && is_space(text.back()))
      text.remove_suffix(1);
    return text;
  }



  std::string
  lower_case(const std::string_view text)
  {
    std::string result(text);
    for (char &c : result)
      if (c >= 'A' && c <= 'Z')
        c += 'a' - 'A';
    return result;
  }



  FileScanner::FileScanner(const std::string &file) : name(file), content(read_file(file))
  {
  }



  bool
  FileScanner::at_end()
  {
    const char       *p   = content.data() + place;
    const char *const end = content.data() + content.size();
    while (p < end)
      if (is_space(*p))
        ++p;
      else if (comment != '\0' && *p == comment)
        p = std::find(p, end, '\n');
      else
        break;
    place = p - content.data();
    return p == end;
  }



  std::string_view
  FileScanner::line()
  {
    last_place = place;
    if (place >= content.size())
      fail("the file ends where another line should follow.");
    const std::size_t      end = std::min(content.find('\n', place), content.size());
    const std::string_view text(content.data() + place, end - place);
    place = std::min(end + 1, content.size());
    return text;
  }



  bool
  FileScanner::next_line(std::string_view &text)
  {
    while (place < content.size())
      {
        text = line();
        if (comment != '\0')
          text = text.substr(0, text.find(comment));
        text = trimmed(text);
        if (!text.empty())
          return true;
      }
    last_place = place;
    return false;
  }



  std::string_view
  FileScanner::word(const char *what)
  {
    const bool none = at_end();
    last_place      = place;
    if (none)
      fail(std::string("the file ends where ") + what + " should follow.");
    const char       *begin = content.data() + place;
    const char *const end   = content.data() + content.size();
    const char       *p     = begin;
    while (p < end && !is_space(*p) && !(comment != '\0' && *p == comment))
      ++p;
    place = p - content.data();
    return {begin, static_cast<std::size_t>(p - begin)};
  }



  void
  FileScanner::expect(const std::string &expected)
  {
    const std::string_view text = word(expected.c_str());
    if (text != expected)
      fail(excerpt(text) + " stands where " + expected + " is expected.");
  }



  std::int64_t
  FileScanner::integer(const char *what, const std::int64_t smallest, const std::int64_t largest)
  {
    const std::string_view text = word(what);
    std::int64_t           value;
    if (!parse(text, value))
      fail(excerpt(text) + " stands where " + what + ", a whole number, is expected.");
    if (value < smallest || value > largest)
      fail(std::string(what) + " is " + std::to_string(value) + ", but must be "
           + (value < smallest ? "at least " + std::to_string(smallest)
                               : "at most " + std::to_string(largest))
           + ".");
    return value;
  }



  double
  FileScanner::number(const char *what)
  {
    const std::string_view text = word(what);
    double                 value;
    if (!parse(text, value))
      fail(excerpt(text) + " stands where " + what + ", a finite number, is expected.");
    return value;
  }



  std::size_t
  FileScanner::count(const char *what, const std::size_t bytes_each)
  {
    const std::int64_t n = integer(what, 0);
    check_count(n, what, bytes_each);
    return n;
  }



  void
  FileScanner::check_count(const std::uint64_t n,
                           const char         *what,
                           const std::size_t   bytes_each) const
  {
    // The last of a list of words needs no space behind it.
    if (n > 0 && (n - 1) > remaining() / std::max<std::size_t>(bytes_each, 1))
      fail(std::string(what) + " is " + std::to_string(n) + ", but only "
           + std::to_string(remaining())
           + " bytes of the file are left: it is cut off, or the number is wrong.");
  }



  const unsigned char *
  FileScanner::raw(const std::size_t n, const char *what)
  {
    last_place = place;
    if (n > remaining())
      fail(std::string(what) + " would take " + std::to_string(n) + " bytes, but only "
           + std::to_string(remaining()) + " are left: the file is cut off.");
    const unsigned char *data = reinterpret_cast<const unsigned char *>(content.data()) + place;
    place += n;
    return data;
  }



  void
  FileScanner::bytes(void *target, const std::size_t n, const char *what)
  {
    std::memcpy(target, raw(n, what), n);
  }



  void
  FileScanner::skip_past(const std::string &text)
  {
    last_place              = place;
    const std::size_t found = content.find(text, place);
    if (found == std::string::npos)
      fail(text + " is missing after this place: the file is cut off.");
    place = found + text.size();
  }



  void
  FileScanner::fail(const std::string &message) const
  {
    const std::size_t at = std::min(last_place, content.size());
    if (is_binary)
      throw core::InputError("'" + name + "', byte " + std::to_string(at) + ": " + message);
    const auto line_number
      = 1 + std::count(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    throw core::InputError("'" + name + "', line " + std::to_string(line_number) + ": " + message);
  }
} // namespace tetradapt::io
