// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/cli/options.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/scene/nearest_names.h"

#include <algorithm>

namespace tetradapt::cli
{
  namespace
  {
    const std::vector<std::string> option_names{"--help",
                                                "--version",
                                                "--print-parameters",
                                                "--validate",
                                                "--preview",
                                                "--set",
                                                "--output-directory",
                                                "--quiet",
                                                "--verbose"};

    scene::ParameterFormat
    format_of(const std::string &text)
    {
      if (text == "prm")
        return scene::ParameterFormat::prm;
      if (text == "json")
        return scene::ParameterFormat::json;
      if (text == "markdown")
        return scene::ParameterFormat::markdown;
      throw core::InputError("--print-parameters=" + text + ": there is no such format. "
                             + scene::suggest(text, {"prm", "json", "markdown"}));
    }

    /** Goes through the arguments. */
    class Parser
    {
    public:
      explicit Parser(const std::vector<std::string> &arguments) : arguments(arguments)
      {
      }

      Options
      parse()
      {
        for (next = 0; next < arguments.size();)
          {
            const std::string &argument = arguments[next++];
            if (argument == "--")
              {
                options.scenes.insert(options.scenes.end(),
                                      arguments.begin() + next,
                                      arguments.end());
                break;
              }
            if (argument.size() > 1 && argument[0] == '-')
              read_option(argument);
            else
              options.scenes.push_back(argument);
          }
        const bool wants_scene = options.action == Options::Action::run
                                 || options.action == Options::Action::validate
                                 || options.action == Options::Action::preview;
        if (wants_scene && options.scenes.empty())
          throw core::InputError("no scene is given. Write 'tetradapt scene.prm', or 'tetradapt "
                                 "--help' to see the options.");
        return options;
      }

    private:
      void
      read_option(const std::string &argument)
      {
        const auto equals = argument.find('=');
        name              = argument.substr(0, equals);
        has_value         = equals != std::string::npos;
        value             = has_value ? argument.substr(equals + 1) : "";
        if (name == "-h")
          name = "--help";
        if (name == "-q")
          name = "--quiet";
        if (name == "-v")
          name = "--verbose";
        if (name == "--set")
          options.settings.push_back(needed_value("'Section/Name=value'"));
        else if (name == "--output-directory")
          {
            options.output_directory = needed_value("a folder");
            if (options.output_directory.empty())
              throw core::InputError("--output-directory: the name is empty. Give a folder.");
          }
        else if (name == "--print-parameters")
          {
            options.action = Options::Action::print_parameters;
            options.format = format_of(has_value ? value : "prm");
          }
        else
          read_switch(argument);
      }

      void
      read_switch(const std::string &argument)
      {
        if (std::find(option_names.begin(), option_names.end(), name) == option_names.end())
          throw core::InputError("unknown option '" + argument + "'. "
                                 + scene::suggest(name, option_names));
        if (has_value)
          throw core::InputError(name + " takes no value; '" + value + "' is given. Remove it.");
        if (name == "--help")
          options.action = Options::Action::help;
        else if (name == "--version")
          options.action = Options::Action::version;
        else if (name == "--validate")
          options.action = Options::Action::validate;
        else if (name == "--verbose")
          options.verbose = true;
        else if (name == "--preview")
          options.action = Options::Action::preview;
        else
          options.quiet = true;
      }

      /** The value of the present option, joined by "=" or the next argument. */
      std::string
      needed_value(const std::string &what)
      {
        if (has_value)
          return value;
        if (next == arguments.size())
          throw core::InputError(name + " needs a value: " + what + ".");
        return arguments[next++];
      }

      const std::vector<std::string> &arguments;
      std::size_t                     next = 0;
      std::string                     name, value;
      bool                            has_value = false;
      Options                         options;
    };
  } // namespace

  Options
  parse_options(const std::vector<std::string> &arguments)
  {
    return Parser(arguments).parse();
  }

  std::string
  help_text()
  {
    return R"(Usage: tetradapt [options] scene.prm [scene.prm ...]

Solves each scene with finite elements on tetrahedra, measures or estimates the
error, and lets TetGen refine the mesh until the error is small.

  --set 'Section/Name=value'   set a parameter, as if it stood in the scene's
                               file; repeatable:
                               --set 'Loads/tip/Value=0; 0; -2'
  --output-directory FOLDER    write there, not to output/<scene>; with several
                               scenes, to folders in it with their names
  --validate                   read and check the scenes, print what each needs
                               and skips, and run nothing
  --preview                    make the first mesh, write its surface with
                               supports, loads and regions to preview.vtu in
                               the output folder, print the areas that they
                               act on, and solve nothing
  --print-parameters[=FORMAT]  print all parameters with defaults and
                               documentation; FORMAT is prm (default), json or
                               markdown
  -v, --verbose                print the plan, meshes, solvers and times also,
                               which log.txt always has
  -q, --quiet                  print nothing but warnings and errors
  --version                    print the versions of program and libraries
  -h, --help                   print this text

Several scenes run one after another; one that fails does not stop the others.
A scene with a subsection Study runs once for every combination of its values,
each in a folder of its own, and ends with one table (study.csv) of all.
In parallel: mpirun -np 2 tetradapt scene.prm

What it does not do: contact, follower pressures, error estimates for large
deformation, dynamics, plasticity or failure, shells, beams and elements other
than tetrahedra.

Exit code: 0 all done; 1 a computation failed; 2 bad input (also if, with
several scenes, a computation failed as well). Messages go to stderr, tables to
stdout. doc/columns.md explains every figure.
)";
  }
} // namespace tetradapt::cli
