// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/text_lines.h"

#include "tetradapt/report/record_columns.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::report
{
  namespace
  {
    bool
    continues_character(const char c)
    {
      return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
    }

    /** The first @p n characters. */
    std::string
    start_of(const std::string &text, std::size_t n)
    {
      std::size_t end = 0;
      while (end < text.size() && (n > 0 || continues_character(text[end])))
        {
          if (!continues_character(text[end]))
            --n;
          ++end;
        }
      return text.substr(0, end);
    }

    std::string
    cut(const std::string &text, const std::size_t width)
    {
      return text_width(text) <= width ? text : start_of(text, width - 3) + "...";
    }
  } // namespace

  std::size_t
  text_width(const std::string &text)
  {
    return text.size() - std::count_if(text.begin(), text.end(), continues_character);
  }

  std::string
  padded(const std::string &text, const std::size_t width)
  {
    const std::string shown = cut(text, width);
    return shown + std::string(width - text_width(shown), ' ');
  }

  std::string
  wrapped(const std::string &text, const std::size_t width, const std::size_t indent)
  {
    std::string result, line;
    std::size_t begin = 0;
    while (begin < text.size())
      {
        // A word with the blanks before it, which count where it does not begin a line.
        const std::size_t word = std::min(text.find_first_not_of(' ', begin), text.size());
        const std::size_t end  = std::min(text.find(' ', word), text.size());
        const std::string gap  = text.substr(begin, word - begin);
        const std::string next = cut(text.substr(word, end - word), width - indent);
        begin                  = end;
        if (next.empty())
          break;
        const bool fits = text_width(line) + gap.size() + text_width(next) <= width;
        if (fits)
          line += gap + next;
        else
          {
            result += line + '\n';
            line = std::string(indent, ' ') + next;
          }
      }
    return result + line + '\n';
  }

  std::string
  short_vector(const dealii::Tensor<1, 3> &vector, const double smallest)
  {
    std::string text;
    for (unsigned int c = 0; c < 3; ++c)
      text += (c == 0 ? "(" : ", ")
              + format_number(std::abs(vector[c]) < smallest ? 0. : vector[c], 5);
    return text + ")";
  }
} // namespace tetradapt::report
