// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/gnuplot.h"

#include "tetradapt/core/child_process.h"
#include "tetradapt/core/exceptions.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
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

    /** The SVG documents that @p output consists of. */
    std::vector<std::string>
    documents(const std::string &output)
    {
      const std::string        end = "</svg>";
      std::vector<std::string> result;
      for (std::size_t at = 0; at < output.size();)
        {
          const std::size_t found = output.find(end, at);
          if (found == std::string::npos)
            break;
          const std::size_t next
            = std::min(output.find_first_not_of(" \r\n", found + end.size()), output.size());
          result.push_back(output.substr(at, found + end.size() - at) + "\n");
          at = next;
        }
      return result;
    }

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
        // An empty entry means the working directory, where anybody may have put a program.
        if (folder.empty())
          continue;
        const std::string file = folder + "/gnuplot";
        std::error_code   error;
        if (fs::is_regular_file(file, error) && access(file.c_str(), X_OK) == 0)
          return file;
      }
    return "";
  }

  PictureFolder::PictureFolder(ResultFolder &folder, const core::Log &log)
    : folder(folder), log(log), program(find_gnuplot())
  {
  }

  void
  PictureFolder::add(const std::string &name, const std::string &script)
  {
    if (script.empty())
      return;
    folder.write("plots/" + name + ".gp", script);
    waiting.push_back({name, script});
  }

  std::optional<std::string>
  PictureFolder::draw(const std::vector<Picture> &pictures) const
  {
    std::string input;
    for (const Picture &picture : pictures)
      input += (input.empty() ? "" : "reset\n") + picture.script;
    core::ChildResult result;
    try
      {
        result = core::run_child({"gnuplot", program, {"-d"}}, input, time_limit);
      }
    catch (const core::NumericalError &failure)
      {
        return std::string(": ") + failure.what();
      }
    if (result.timed_out)
      return " in " + std::to_string(int(time_limit)) + " s";
    const std::vector<std::string> drawn = documents(result.output);
    if ((result.status >= 0 && (!WIFEXITED(result.status) || WEXITSTATUS(result.status)))
        || drawn.size() != pictures.size())
      return first_words(result.errors);
    for (std::size_t i = 0; i < drawn.size(); ++i)
      folder.write("plots/" + pictures[i].name + ".svg", drawn[i]);
    return std::nullopt;
  }

  void
  PictureFolder::draw()
  {
    const std::vector<Picture> pictures = std::move(waiting);
    waiting.clear();
    if (pictures.empty())
      return;
    if (program.empty())
      {
        if (!missing_was_said)
          log.warning("Output/Plots: gnuplot is missing, so that " + folder.file("plots")
                      + " has its scripts only. Install Debian's gnuplot-nox, then: gnuplot -d "
                        "NAME.gp > NAME.svg");
        missing_was_said = true;
        return;
      }
    if (pictures.size() > 1 && !draw(pictures))
      return;
    // One by one, so that a picture that fails costs no other.
    for (const Picture &picture : pictures)
      if (const auto trouble = draw({picture}))
        log.warning("Output/Plots: gnuplot made no " + picture.name + ".svg" + *trouble);
  }
} // namespace tetradapt::report
