// SPDX-License-Identifier: AGPL-3.0-or-later
#include "result_names.h"

#include "tetradapt/core/exceptions.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace tetradapt::report
{
  namespace fs = std::filesystem;

  /** Makes @p path a folder if it is none, and returns it. */
  std::string
  made_folder(const std::string &path)
  {
    std::error_code error;
    fs::create_directories(path, error);
    if (!error && !fs::is_directory(path, error) && !error)
      error = std::make_error_code(std::errc::not_a_directory);
    const std::string text
      = "Cannot make the output directory '" + path + "': " + error.message() + ". ";
    if (error == std::errc::no_space_on_device || error == std::errc::io_error)
      throw core::NumericalError(text + "Make room on the disk or choose another one in Output.");
    if (error)
      throw core::InputError(text + "Choose another one in Output.");
    return path;
  }

  /** A name as one line: file names may hold line ends. */
  std::string
  escaped(const std::string &name)
  {
    std::string text;
    for (const char c : name)
      text += c == '\\' ? "\\\\" : c == '\n' ? "\\n" : std::string(1, c);
    return text;
  }

  std::string
  unescaped(const std::string &text)
  {
    std::string name;
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\\' && i + 1 < text.size())
        name += text[++i] == 'n' ? '\n' : text[i];
      else
        name += text[i];
    return name;
  }

  /** Whether @p name stays in the folder, whoever wrote the list. */
  bool
  is_inside(const std::string &name)
  {
    const fs::path path(name);
    return !name.empty() && path.is_relative()
           && std::all_of(path.begin(), path.end(), [](const fs::path &part) {
                return !part.empty() && part != "." && part != "..";
              });
  }

  namespace
  {
    bool
    is_number(const std::string &text)
    {
      return !text.empty() && std::all_of(text.begin(), text.end(), [](const unsigned char c) {
        return std::isdigit(c) != 0;
      });
    }
  } // namespace

  /** The process number if @p name is a temporary of @p file (".<file>.<process>.
   * <attempt>.tmp", as AtomicFile names them), else an empty text. */
  std::string
  process_of_temporary(const std::string &name, const std::string &file)
  {
    const std::string start = "." + file + ".", end = ".tmp";
    if (name.size() < start.size() + end.size() || name.compare(0, start.size(), start) != 0
        || name.compare(name.size() - end.size(), end.size(), end) != 0)
      return "";
    const std::string numbers = name.substr(start.size(), name.size() - start.size() - end.size());
    const std::size_t dot     = numbers.find('.');
    if (dot == std::string::npos || !is_number(numbers.substr(0, dot))
        || !is_number(numbers.substr(dot + 1)))
      return "";
    return numbers.substr(0, dot);
  }
} // namespace tetradapt::report
