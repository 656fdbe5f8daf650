// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/gnuplot.h"

#include "tetradapt/core/atomic_file.h"
#include "tetradapt/core/child_process.h"
#include "tetradapt/core/exceptions.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace tetradapt::report
{
  namespace fs = std::filesystem;

  namespace
  {
    /** Seconds; a picture takes a fraction of one. */
    constexpr double time_limit = 30.;

    /** The first line of what gnuplot says, which names the trouble. */
    std::string
    first_words(const std::string &errors)
    {
      std::istringstream stream(errors);
      for (std::string line; std::getline(stream, line);)
        if (line.find_first_not_of(" \t^") != std::string::npos)
          return ": " + line.substr(line.find_first_not_of(" \t"));
      return "";
    }
  } // namespace

  std::string
  find_gnuplot()
  {
    const char *path = std::getenv("PATH");
    if (path == nullptr)
      return "";
    std::istringstream folders(path);
    for (std::string folder; std::getline(folders, folder, ':');)
      {
        const std::string file = (folder.empty() ? "." : folder) + "/gnuplot";
        std::error_code   error;
        if (fs::is_regular_file(file, error) && access(file.c_str(), X_OK) == 0)
          return file;
      }
    return "";
  }

  PictureFolder::PictureFolder(const std::string &folder, const core::Log &log)
    : folder(folder), log(log), program(find_gnuplot())
  {
  }

  void
  PictureFolder::add(const std::string &name, const std::string &script)
  {
    if (script.empty())
      return;
    std::error_code error;
    fs::create_directories(folder, error); // what is wrong, the file below says
    core::write_file(folder + "/" + name + ".gp", script);
    if (program.empty())
      {
        if (!missing_was_said)
          log.warning("Output/Plots: gnuplot is missing, so that " + folder
                      + " has its scripts only. Install Debian's gnuplot-nox, then: gnuplot -d "
                        "NAME.gp > NAME.svg");
        missing_was_said = true;
        return;
      }
    std::string trouble;
    try
      {
        const core::ChildResult result
          = core::run_child({"gnuplot", program, {"-d"}}, script, time_limit);
        if (result.timed_out)
          trouble = " in " + std::to_string(int(time_limit)) + " s";
        else if ((result.status >= 0 && (!WIFEXITED(result.status) || WEXITSTATUS(result.status)))
                 || result.output.find("</svg>") == std::string::npos)
          trouble = first_words(result.errors);
        else
          {
            core::write_file(folder + "/" + name + ".svg", result.output);
            return;
          }
      }
    catch (const core::NumericalError &failure)
      {
        trouble = std::string(": ") + failure.what();
      }
    log.warning("Output/Plots: gnuplot made no " + name + ".svg" + trouble);
  }
} // namespace tetradapt::report
