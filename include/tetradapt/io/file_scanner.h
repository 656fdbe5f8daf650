// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_io_file_scanner_h
#define tetradapt_io_file_scanner_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace tetradapt::io
{
  /** A file's whole content. @throws core::InputError if it cannot be read, is no
   * plain file or is empty. */
  std::string
  read_file(const std::string &file);

  /**
   * Reads words, numbers, lines and raw bytes from a file held in memory, one
   * after the other, and knows where it is when something is wrong. Every
   * function throws core::InputError with file and line (or byte, in binary parts)
   * instead of reading past the end.
   */
  class FileScanner
  {
  public:
    explicit FileScanner(const std::string &file);

    const std::string &
    file() const
    {
      return name;
    }
    std::size_t
    position() const
    {
      return place;
    }
    std::size_t
    remaining() const
    {
      return content.size() - place;
    }
    /** In binary parts messages give the byte, else the line. */
    void
    set_binary(bool binary)
    {
      is_binary = binary;
    }
    /** From here on, the rest of a line behind @p mark is white space. */
    void
    set_comment(char mark)
    {
      comment = mark;
    }

    /** Skips white space. Whether nothing is left then. */
    bool
    at_end();

    /** The rest of the line, without its end; the next call starts behind it. */
    std::string_view
    line();

    /** The next line that is not blank, without space around it. False: none is
     * left. */
    bool
    next_line(std::string_view &text);

    /** The next word. @p what says in messages what it should have been. */
    std::string_view
    word(const char *what);

    /** The next word must be @p expected. */
    void
    expect(const std::string &expected);

    /** The next word as an integer between @p smallest and @p largest. */
    std::int64_t
    integer(const char *what, std::int64_t smallest = INT64_MIN, std::int64_t largest = INT64_MAX);

    /** The next word as a finite number. */
    double
    number(const char *what);

    /**
     * The next word as a number of things that follow.
     * @param bytes_each what each takes in the file at least; a count that the
     *        rest of the file cannot hold is refused here, before anybody
     *        reserves memory for it.
     */
    std::size_t
    count(const char *what, std::size_t bytes_each);

    /** Refuses a count as count() does. */
    void
    check_count(std::uint64_t n, const char *what, std::size_t bytes_each) const;

    /** Copies @p n bytes to @p target. */
    void
    bytes(void *target, std::size_t n, const char *what);

    /** The next @p n bytes where they lie; valid as long as the scanner. */
    const unsigned char *
    raw(std::size_t n, const char *what);

    /** Whether binary() reverses the order of bytes. */
    void
    set_swap(bool swap)
    {
      is_swapped = swap;
    }

    /** A plain value as it lies in the file. */
    template <typename T>
    T
    binary(const char *what)
    {
      unsigned char buffer[sizeof(T)];
      bytes(buffer, sizeof(T), what);
      if (is_swapped)
        std::reverse(buffer, buffer + sizeof(T));
      T value;
      std::memcpy(&value, buffer, sizeof(T));
      return value;
    }

    /** Goes on behind the next occurrence of @p text. */
    void
    skip_past(const std::string &text);

    /** Throws "'file', line 12: message". */
    [[noreturn]] void
    fail(const std::string &message) const;

  private:
    std::string name;
    std::string content;
    std::size_t place      = 0;
    std::size_t last_place = 0; ///< where the last thing read begins
    bool        is_binary  = false;
    bool        is_swapped = false;
    char        comment    = '\0';
  };

  /** The start of @p text, fit for a message: at most 40 printable letters. */
  std::string
  excerpt(std::string_view text);

  /** @p text as an integer or a number: all of it, with an optional sign.
   * @return whether it is one; numbers must be finite. */
  bool
  parse(std::string_view text, std::int64_t &value);
  bool
  parse(std::string_view text, double &value);

  /** Without white space at both ends. */
  std::string_view
  trimmed(std::string_view text);

  /** In lower-case letters (ASCII only). */
  std::string
  lower_case(std::string_view text);
} // namespace tetradapt::io

#endif
