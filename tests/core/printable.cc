// SPDX-License-Identifier: AGPL-3.0-or-later
// What may be printed of a text that comes from a file.

#include "tetradapt/core/printable.h"

#include <iostream>

using tetradapt::core::printable;

namespace
{
  void
  show(const std::string &what, const std::string &text)
  {
    std::cout << what << ": " << printable(text) << std::endl;
  }

  /** Whether a terminal could take any byte of it for a command. */
  bool
  is_harmless(const std::string &text)
  {
    for (std::size_t i = 0; i < text.size(); ++i)
      {
        const auto c = static_cast<unsigned char>(text[i]);
        if ((c < 32 && c != '\n' && c != '\t') || c == 127)
          return false;
        if (c == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0)
          return false;
      }
    return true;
  }
} // namespace

int
main()
{
  show("kept",
       "plain, \xc3\xa9t\xc3\xa9, \xe2\x88\x92"
       "1, \xf0\x9d\x94\x98 \\x\tand\na line");
  show("escape sequence", "a\x1b[31mred\x1b]0;title\x07");
  show("DEL, BEL, CR",
       "a\x7f"
       "b\a"
       "c\rd");
  show("zero", std::string("a\0b", 3));
  show("C1 as UTF-8",
       "\xc2\x9b"
       "31m\xc2\x85");
  show("C1 as bytes",
       "\x9b"
       "31m");
  show("overlong", "\xc0\xaf \xe0\x80\x9b \xf0\x80\x80\x9b");
  show("surrogate, too large", "\xed\xa0\x80 \xf4\x90\x80\x80");
  show("cut off", "\xe2\x88");
  show("direction",
       "a\xe2\x80\xaegnp.exe\xe2\x81\xa6"
       "b\xef\xbb\xbf");
  const std::string long_text = "start" + std::string(200000, 'x') + "end";
  show("a long line", long_text);
  std::string long_letters;
  for (unsigned int i = 0; i < 3000; ++i)
    long_letters += "\xe2\x88\x92";
  const std::string cut = printable("a" + long_letters);
  std::cout << "cut between letters: " << (cut.find('\\') == std::string::npos)
            << (printable(cut) == cut) << std::endl;
  const std::string lines = std::string(1500, 'a') + "\n" + std::string(1500, 'b');
  std::cout << "each line by itself: " << (printable(lines) == lines) << std::endl;

  unsigned int n_wrong = 0, seed = 1;
  for (unsigned int i = 0; i < 20000; ++i)
    {
      std::string text;
      for (unsigned int k = 0; k < 12; ++k)
        {
          seed = seed * 1664525u + 1013904223u;
          text += static_cast<char>(k % 3 == 0 ? 0xC2 : seed >> 24);
        }
      n_wrong += !is_harmless(printable(text)) || printable(printable(text)) != printable(text);
    }
  std::cout << "anything: " << n_wrong << std::endl;
}
