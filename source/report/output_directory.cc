// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/output_directory.h"

#include "tetradapt/core/exceptions.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

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
                                    "reactions.csv",
                                    "regions.csv",
                                    "size_field.vtu",
                                    "preview.vtu",
                                    "parameters.prm",
                                    "log.txt",
                                    "log_new.txt",
                                    "log_failed.txt"})
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
    is_own_plot(const std::string &path)
    {
      if (path.compare(0, 6, "plots/") != 0)
        return false;
      const std::string name = path.substr(6);
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

    /** Names of a log that is being written, of one that became a result, and of one of a
     * run that had no result. */
    constexpr char new_log[] = "log_new.txt", log[] = "log.txt", failed_log[] = "log_failed.txt";
    constexpr char input[] = "parameters.prm";

    /** Whether @p name tells about a run without being a result. */
    bool
    is_account(const std::string &name)
    {
      return name == new_log || name == log || name == failed_log || name == input;
    }

    std::vector<std::string>
    files_read(const scene::Scene &scene)
    {
      std::vector<std::string> files{scene.mesh.size_field};
      if (scene.mesh.source == scene::MeshSource::file
          || scene.mesh.source == scene::MeshSource::surface)
        files.insert(files.end(), scene.mesh.files.begin(), scene.mesh.files.end());
      if (scene.reference.type != scene::ReferenceParameters::Type::none)
        files.push_back(scene.reference.file);
      return files;
    }

    /** Whether begin() would remove @p file. */
    bool
    is_removed(const std::string &file, const ResultFolder &folder)
    {
      std::error_code error;
      for (const std::string &name : folder.earlier_files())
        if (fs::equivalent(file, folder.file(name), error))
          return true;
      for (const std::string &name : folder.earlier_folders())
        for (fs::path above = fs::path(file).parent_path(); above.has_relative_path();
             above          = above.parent_path())
          if (fs::equivalent(above, folder.file(name), error))
            return true;
      return false;
    }

    void
    check_not_read(const scene::Scene &scene, const ResultFolder &folder)
    {
      for (const std::string &file : files_read(scene))
        if (!file.empty() && is_removed(file, folder))
          throw core::InputError("The scene '" + scene.file + "' reads the file '" + file
                                 + "', which lies in its own output directory and would be "
                                   "overwritten. Move that file or set another directory in "
                                   "Output.");
    }
  } // namespace

  std::string
  OutputDirectory::path_of(const scene::Scene &scene)
  {
    return scene.output.directory.empty() ? "output/" + scene.name : scene.output.directory;
  }

  OutputDirectory::OutputDirectory(const scene::Scene                      &scene,
                                   const std::string                       &parameters,
                                   const std::vector<const scene::Scene *> &runs)
    : folder(path_of(scene)), scene_name(scene.name), parameters(parameters)
  {
    folder.check_free(
      [&](const std::string &name) { return is_own_file(name, scene_name) || is_own_plot(name); });
    for (const scene::Scene *run : runs)
      folder.add_folder(fs::path(path_of(*run)).filename().string());
    check_not_read(scene, folder);
    for (const scene::Scene *run : runs)
      check_not_read(*run, folder);
    const auto earlier = folder.earlier_files();
    if (folder.earlier_folders().empty() && std::all_of(earlier.begin(), earlier.end(), is_account))
      begin();
  }

  std::string
  OutputDirectory::log_path()
  {
    log_name = folder.has_begun() ? log : new_log;
    folder.discard(log_name); // of a run that was killed
    return folder.prepare(log_name);
  }

  void
  OutputDirectory::begin()
  {
    if (folder.has_begun())
      return;
    folder.begin();
    if (!log_name.empty() && folder.rename(log_name, log))
      log_name = log;
    folder.write(input, parameters);
    for (const std::string &name : folder.earlier_folders())
      folder.remove_folder(name);
  }

  void
  OutputDirectory::end()
  {
    if (!folder.has_begun() && !log_name.empty() && folder.rename(log_name, failed_log))
      log_name = failed_log;
    folder.finish();
  }

  std::string
  OutputDirectory::kept_results() const
  {
    return folder.has_begun() ? ""
                              : "The results of an earlier run in '" + folder.path()
                                  + "' are kept; the log of this one is " + folder.file(failed_log);
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
              {"reactions.csv", "reactions, loads and their balance in every cycle"},
              {"regions.csv", "volume, mass and largest values of each region"},
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
                                        return !fs::exists(directory + "/" + file.first, error);
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
    const Files files = existing(folder.path(), files_of_run(scene_name));
    std::size_t width = 0;
    for (const auto &file : files)
      width = std::max(width, folder.path().size() + 1 + file.first.size());
    std::string text = "Files to look at:";
    for (const auto &[name, what] : files)
      {
        const std::string file = folder.path() + "/" + name;
        text += "\n  " + file + std::string(width - file.size() + 2, ' ') + what;
      }
    return text;
  }

  std::string
  OutputDirectory::files_in_short() const
  {
    return in_short(folder.path(), existing(folder.path(), files_of_run(scene_name)));
  }

  std::string
  OutputDirectory::study_files_in_short(const std::string &directory)
  {
    return in_short(directory,
                    existing(directory, {{"study.txt", ""}, {"study.csv", ""}, {"plots", ""}}));
  }
} // namespace tetradapt::report
