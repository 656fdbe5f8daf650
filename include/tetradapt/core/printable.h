// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_printable_h
#define tetradapt_core_printable_h

#include <string>

namespace tetradapt::core
{
  /**
   * @p text as it may be printed, whatever a file or a command line put into it: control
   * characters (escape sequences, DEL, C1), marks that turn the direction of writing, and
   * bytes that are no UTF-8 become "\x1b" or "\u009b"; line ends and tabs stay. Of a line
   * of more than 2000 bytes the middle is left out, which is said.
   */
  std::string
  printable(const std::string &text);
} // namespace tetradapt::core

#endif
