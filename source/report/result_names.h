// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_result_names_h
#define tetradapt_report_result_names_h

#include <string>

/** Names of files and folders, as ResultFolder needs them. */
namespace tetradapt::report
{
  /** Makes @p path a folder if it is none, and returns it.
   * @throws InputError, or NumericalError if the disk is full. */
  std::string
  made_folder(const std::string &path);

  /** A name as one line: file names may hold line ends. */
  std::string
  escaped(const std::string &name);
  std::string
  unescaped(const std::string &text);

  /** Whether @p name stays in the folder, whoever wrote the list. */
  bool
  is_inside(const std::string &name);

  /** The process number if @p name is a temporary of @p file (".<file>.<process>.
   * <attempt>.tmp", as AtomicFile names them), else an empty text. */
  std::string
  process_of_temporary(const std::string &name, const std::string &file);
} // namespace tetradapt::report

#endif
