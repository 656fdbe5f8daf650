// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_cli_options_h
#define tetradapt_cli_options_h

#include "tetradapt/scene/parameter_printer.h"

#include <string>
#include <vector>

namespace tetradapt::cli
{
  /** What the command line asks for. */
  struct Options
  {
    enum class Action
    {
      run,
      validate,
      preview,
      print_parameters,
      help,
      version
    };
    Action                   action = Action::run;
    scene::ParameterFormat   format = scene::ParameterFormat::prm;
    std::vector<std::string> scenes;           ///< parameter files, in order
    std::vector<std::string> settings;         ///< "Section/Name=value", in order
    std::string              output_directory; ///< empty: as the scenes say
    bool                     quiet = false, verbose = false;
  };

  /**
   * Reads the program's arguments, without its name. Options may stand before,
   * between and after the scenes; what follows "--" is a scene. A value follows
   * its option or is joined to it by "=".
   * @throws InputError naming the argument and what it should be.
   */
  Options
  parse_options(const std::vector<std::string> &arguments);

  /** The text of --help. */
  std::string
  help_text();

  /** The text of --version: the program's version, the libraries', compiler and
   * build type. */
  std::string
  version_text();
} // namespace tetradapt::cli

#endif
