// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/output_directory.h"

#include "tetradapt/core/atomic_file.h"
#include "tetradapt/core/exceptions.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <vector>

namespace tetradapt::report
{
  namespace fs = std::filesystem;

  namespace
  {
    bool
    is_number(const std::string &text)
    {
      return !text.empty() && std::all_of(text.begin(), text.end(), [](const unsigned char c) {
        return std::isdigit(c) != 0;
      });
    }

    /** Whether a run of the scene @p scene_name writes a file of this name. */
    bool
    is_own_file(const std::string &name, const std::string &scene_name)
    {
      for (const std::string own : {"convergence.csv",
                                    "convergence.txt",
                                    "results.csv",
                                    "results.txt",
                                    "study.csv",
                                    "study.txt",
                                    "mesh.csv",
                                    "size_field.vtu",
                                    "parameters.prm",
                                    "log.txt"})
        if (name == own)
          return true;
      if (name == scene_name + ".pvd")
        return true;
      // cycle_NNN.vtu
      return name.size() >= 13 && name.compare(0, 6, "cycle_") == 0
             && name.compare(name.size() - 4, 4, ".vtu") == 0
             && is_number(name.substr(6, name.size() - 10));
    }

    /** Whether a run draws a plot of this name. */
    bool
    is_own_plot(const std::string &name)
    {
      for (const std::string own : {"convergence_dofs",
                                    "convergence_seconds",
                                    "effectivity",
                                    "ren",
                                    "ren_tets",
                                    "goal_dofs",
                                    "quality",
                                    "indicators"})
        if (name == own + ".svg" || name == own + ".gp")
          return true;
      return false;
    }

    /** The file that @p name is a temporary of (".<file>.<process>.<attempt>.tmp",
     * as AtomicFile names them), or an empty text. */
    std::string
    file_of_temporary(const std::string &name)
    {
      if (name.size() < 6 || name[0] != '.' || name.compare(name.size() - 4, 4, ".tmp") != 0)
        return "";
      std::string rest = name.substr(1, name.size() - 5);
      for (unsigned int i = 0; i < 2; ++i)
        {
          const std::size_t dot = rest.rfind('.');
          if (dot == std::string::npos || !is_number(rest.substr(dot + 1)))
            return "";
          rest.resize(dot);
        }
      return rest;
    }

    /** Files that a run of @p scene_name would mix with its own. */
    std::vector<fs::path>
    stale_files(const fs::path &directory, const std::string &scene_name)
    {
      std::vector<fs::path> stale;
      for (const auto &entry : fs::directory_iterator(directory))
        {
          const std::string name = entry.path().filename().string();
          // parameters.prm is replaced at once, and may be the very scene that runs.
          if (name == "parameters.prm" || fs::is_directory(entry.symlink_status()))
            continue;
          if (is_own_file(name, scene_name) || is_own_file(file_of_temporary(name), scene_name))
            stale.push_back(entry.path());
        }
      if (fs::is_directory(directory / "plots"))
        for (const auto &entry : fs::directory_iterator(directory / "plots"))
          {
            const std::string name = entry.path().filename().string();
            if (is_own_plot(name) || is_own_plot(file_of_temporary(name)))
              stale.push_back(entry.path());
          }
      return stale;
    }

    void
    check_not_read(const scene::Scene &scene, const std::vector<fs::path> &stale)
    {
      std::vector<std::string> inputs;
      if (scene.mesh.source == scene::MeshSource::file
          || scene.mesh.source == scene::MeshSource::surface)
        inputs = scene.mesh.files;
      if (scene.reference.type != scene::ReferenceParameters::Type::none)
        inputs.push_back(scene.reference.file);
      inputs.push_back(scene.mesh.size_field);
      for (const std::string &input : inputs)
        for (const fs::path &path : stale)
          {
            std::error_code error;
            if (!input.empty() && fs::equivalent(input, path, error))
              throw core::InputError("The scene '" + scene.file + "' reads the file '" + input
                                     + "', which lies in its own output directory and would be "
                                       "overwritten. Move that file or set another directory in "
                                       "Output.");
          }
    }
  } // namespace

  std::string
  OutputDirectory::path_of(const scene::Scene &scene)
  {
    return scene.output.directory.empty() ? "output/" + scene.name : scene.output.directory;
  }

  OutputDirectory::OutputDirectory(const scene::Scene &scene)
    : directory(path_of(scene)), scene_name(scene.name)
  {
    std::error_code error;
    fs::create_directories(directory, error);
    if (!error && !fs::is_directory(directory))
      error = std::make_error_code(std::errc::not_a_directory);
    if (error)
      throw core::InputError("Cannot make the output directory '" + directory
                             + "': " + error.message() + ". Choose another one in Output.");
    try
      {
        // Never committed: nothing but a test whether files can be made here.
        {
          core::AtomicFile probe(file("log.txt"));
        }
        const auto stale = stale_files(directory, scene_name);
        check_not_read(scene, stale);
        for (const fs::path &path : stale)
          fs::remove(path);
      }
    catch (const fs::filesystem_error &e)
      {
        throw core::InputError("Cannot clear the output directory '" + directory
                               + "' of an earlier run's files: " + e.code().message()
                               + ". Choose another one in Output.");
      }
  }

  void
  OutputDirectory::remove_other_runs(const std::vector<const scene::Scene *> &runs) const
  {
    std::vector<std::string> names;
    for (const scene::Scene *run : runs)
      names.push_back(fs::path(path_of(*run)).filename().string());
    try
      {
        std::vector<fs::path> folders;
        for (const auto &entry : fs::directory_iterator(directory))
          {
            const std::string name = entry.path().filename().string();
            if (fs::is_directory(entry.symlink_status())
                && is_number(name.substr(0, name.find('-'))) && name.find('-') != std::string::npos
                && fs::exists(entry.path() / "parameters.prm")
                && fs::exists(entry.path() / "log.txt")
                && std::find(names.begin(), names.end(), name) == names.end())
              folders.push_back(entry.path());
          }
        for (const fs::path &folder : folders)
          {
            std::vector<fs::path> stale = stale_files(folder, scene_name);
            stale.push_back(folder / "parameters.prm");
            for (const scene::Scene *run : runs)
              check_not_read(*run, stale);
            for (const fs::path &path : stale)
              fs::remove(path);
            for (const fs::path &path : {folder / "plots", folder})
              if (fs::is_directory(path) && fs::is_empty(path))
                fs::remove(path);
          }
      }
    catch (const fs::filesystem_error &e)
      {
        throw core::InputError("Cannot clear the output directory '" + directory
                               + "' of an earlier study's runs: " + e.code().message()
                               + ". Choose another one in Output.");
      }
  }

  void
  OutputDirectory::write_parameters(const std::string &content) const
  {
    core::write_file(file("parameters.prm"), content);
  }

  namespace
  {
    /** Names of files, and what they are. */
    using Files = std::vector<std::pair<std::string, std::string>>;

    Files
    files_of_run(const std::string &scene_name)
    {
      return {{"results.txt", "exact and computed values"},
              {"convergence.txt", "the figures of every cycle, for reading"},
              {"convergence.csv", "the same for a spreadsheet"},
              {"mesh.csv", "the meshes: what was asked for, shapes, ids"},
              {"plots", "errors, effectivity, shapes as .svg"},
              {scene_name + ".pvd", "all cycles, for ParaView"},
              {"size_field.vtu", "sizes of the last mesh, for Mesh/Size field of another scene"},
              {"parameters.prm", "the complete input"},
              {"log.txt", "what happened when"}};
    }

    /** The @p candidates that exist in @p directory. */
    Files
    existing(const std::string &directory, Files candidates)
    {
      candidates.erase(std::remove_if(candidates.begin(),
                                      candidates.end(),
                                      [&](const auto &file) {
                                        std::error_code error;
                                        // log.txt gets its name when the run is over.
                                        return file.first != "log.txt"
                                               && !fs::exists(directory + "/" + file.first, error);
                                      }),
                       candidates.end());
      return candidates;
    }

    std::string
    in_short(const std::string &directory, const Files &files)
    {
      std::string text;
      for (const auto &file : files)
        text += (text.empty() ? "" : ", ") + file.first;
      return "Results in " + directory + ": " + text;
    }
  } // namespace

  std::string
  OutputDirectory::files_to_look_at() const
  {
    const Files files = existing(directory, files_of_run(scene_name));
    std::size_t width = 0;
    for (const auto &file : files)
      width = std::max(width, directory.size() + 1 + file.first.size());
    std::string text = "Files to look at:";
    for (const auto &[name, what] : files)
      {
        const std::string file = directory + "/" + name;
        text += "\n  " + file + std::string(width - file.size() + 2, ' ') + what;
      }
    return text;
  }

  std::string
  OutputDirectory::files_in_short() const
  {
    return in_short(directory, existing(directory, files_of_run(scene_name)));
  }

  std::string
  OutputDirectory::study_files_in_short(const std::string &directory)
  {
    return in_short(directory,
                    existing(directory, {{"study.txt", ""}, {"study.csv", ""}, {"plots", ""}}));
  }
} // namespace tetradapt::report
