// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_output_directory_h
#define tetradapt_report_output_directory_h

#include "tetradapt/report/result_folder.h"
#include "tetradapt/scene/scene.h"

#include <string>
#include <vector>

namespace tetradapt::report
{
  /**
   * The directory that a run or a study writes to. What an earlier run left is removed when
   * begin() is called, that is, when this one has something to show; a run that fails
   * before leaves the old results, and its log has the name log_failed.txt. Where an
   * earlier run left nothing but its log and its input, the new one begins at once.
   */
  class OutputDirectory
  {
  public:
    /**
     * Prepares the directory of @p scene: its Output directory, or output/<name>
     * below the working directory. To be made on MPI rank 0 only.
     *
     * @param parameters the complete effective input, which begin() writes as parameters.prm.
     * @param runs of a study, whose directories lie in this one.
     * @throws InputError if the directory cannot be made or written to, if another run
     *         writes to it, if the run would replace files that the program did not write,
     *         or if the scene reads one of the files that would be removed.
     */
    OutputDirectory(const scene::Scene                      &scene,
                    const std::string                       &parameters,
                    const std::vector<const scene::Scene *> &runs = {});

    /** Where a run of @p scene writes to; touches no file. */
    static std::string
    path_of(const scene::Scene &scene);

    /** What writes the files of the run. */
    ResultFolder &
    files()
    {
      return folder;
    }

    const std::string &
    path() const
    {
      return folder.path();
    }

    /** Path of the file @p name in the directory. */
    std::string
    file(const std::string &name) const
    {
      return folder.file(name);
    }

    /** Path of the log, a file that does not exist: log.txt, or log_new.txt until begin()
     * where earlier results are kept so long. */
    std::string
    log_path();

    /** Removes what earlier runs left, also in directories of an earlier study's runs that
     * this one has not, and gives the log its name. Only the first call does something.
     * @throws InputError if another program writes to such a directory. */
    void
    begin();

    /** Notes the state of all files; a log that has no name of its own becomes
     * log_failed.txt. To be called when the log is closed. */
    void
    end();

    /** What to tell about a run that ended before begin(); empty if that was called. */
    std::string
    kept_results() const;

    /** What a user looks at after a run: one line a file that exists, saying what
     * it is. */
    std::string
    files_to_look_at() const;

    /** The same in one line: the folder and the names. */
    std::string
    files_in_short() const;

    /** files_in_short() after a study that wrote to @p directory. */
    static std::string
    study_files_in_short(const std::string &directory);

  private:
    ResultFolder folder;
    std::string  scene_name;
    std::string  parameters;
    std::string  log_name; ///< empty until log_path() is called
  };
} // namespace tetradapt::report

#endif
