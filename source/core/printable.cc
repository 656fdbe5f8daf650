// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/printable.h"

#include <cstdint>
#include <cstdio>

namespace tetradapt::core
{
  namespace
  {
    /** Bytes of a line, and how many of its beginning and its end are shown of a longer one. */
    constexpr std::size_t longest_line = 2000, shown_begin = 1200, shown_end = 600;

    bool
    continues(const std::string &text, const std::size_t i)
    {
      return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0) == 0x80;
    }

    /** Decodes the character at @p i; returns its number of bytes, 0 if there is none in
     * valid UTF-8. */
    unsigned int
    decode(const std::string &text, const std::size_t i, std::uint32_t &code)
    {
      const auto         c = static_cast<unsigned char>(text[i]);
      const unsigned int n = c < 0x80                  ? 1
                             : (c >= 0xC2 && c < 0xE0) ? 2
                             : (c >= 0xE0 && c < 0xF0) ? 3
                             : (c >= 0xF0 && c < 0xF5) ? 4
                                                       : 0;
      code                 = n < 2 ? c : c & (0xFFu >> (n + 1));
      for (unsigned int k = 1; k < n; ++k)
        {
          if (!continues(text, i + k))
            return 0;
          code = code << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3Fu);
        }
      const bool is_too_long     = (n == 3 && code < 0x800) || (n == 4 && code < 0x10000);
      const bool is_no_character = (code >= 0xD800 && code < 0xE000) || code > 0x10FFFF;
      return is_too_long || is_no_character ? 0 : n;
    }

    /** Whether a terminal shows something else than the character's glyph. */
    bool
    is_control(const std::uint32_t code)
    {
      return (code < 0x20 && code != '\n' && code != '\t') || (code >= 0x7F && code < 0xA0)
             || (code >= 0x200B && code <= 0x200F) || (code >= 0x2028 && code <= 0x202E)
             || (code >= 0x2060 && code <= 0x206F) || code == 0xFEFF;
    }

    std::string
    shortened(const std::string &line)
    {
      if (line.size() <= longest_line)
        return line;
      std::size_t begin = shown_begin, end = line.size() - shown_end;
      while (continues(line, begin))
        --begin;
      while (continues(line, end))
        ++end;
      return line.substr(0, begin) + " ... (" + std::to_string(end - begin)
             + " bytes left out) ... " + line.substr(end);
    }
  } // namespace

  std::string
  printable(const std::string &text)
  {
    std::string result, line;
    char        escape[16];
    for (std::size_t i = 0; i < text.size();)
      {
        std::uint32_t      code = 0;
        const unsigned int n    = decode(text, i, code);
        if (n == 1 && code == '\n')
          {
            result += shortened(line) + '\n';
            line.clear();
          }
        else if (n > 0 && !is_control(code))
          line.append(text, i, n);
        else
          {
            if (n > 1)
              std::snprintf(escape, sizeof escape, "\\u%04x", code);
            else
              std::snprintf(escape, sizeof escape, "\\x%02x", static_cast<unsigned char>(text[i]));
            line += escape;
          }
        i += n > 0 ? n : 1;
      }
    return result + shortened(line);
  }
} // namespace tetradapt::core
