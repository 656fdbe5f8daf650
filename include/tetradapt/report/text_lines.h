// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_text_lines_h
#define tetradapt_report_text_lines_h

#include <deal.II/base/tensor.h>

#include <string>

namespace tetradapt::report
{
  /** Characters, not bytes, of UTF-8. */
  std::size_t
  text_width(const std::string &text);

  /** @p text with blanks to @p width characters; one that is longer is cut, with "..." at its
   * end. */
  std::string
  padded(const std::string &text, std::size_t width);

  /**
   * @p text as lines of at most @p width characters, broken at blanks; all but the first begin
   * with @p indent blanks. A word that fills more than a line is cut, with "..." at its end. Ends
   * with a line end.
   */
  std::string
  wrapped(const std::string &text, std::size_t width, std::size_t indent);

  /** "(1, -0.5, 0)": five digits; components below @p smallest are shown as 0. */
  std::string
  short_vector(const dealii::Tensor<1, 3> &vector, double smallest);
} // namespace tetradapt::report

#endif
