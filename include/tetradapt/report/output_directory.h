// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_output_directory_h
#define tetradapt_report_output_directory_h

#include "tetradapt/scene/scene.h"

#include <string>
#include <vector>

namespace tetradapt::report
{
  /**
   * The directory that a run writes to: made if it is missing, checked to be
   * writable, and free of what an earlier run of the scene left, so that the
   * files of two runs are never mixed. Only files that this program writes are
   * removed: cycle_NNN.vtu, <scene>.pvd, size_field.vtu, log.txt, the tables convergence,
   * study, results (.csv, .txt) and mesh.csv, temporary files that a killed run has left
   * of those, and the plots; parameters.prm is replaced.
   */
  class OutputDirectory
  {
  public:
    /**
     * Prepares the directory of @p scene: its Output directory, or output/<name>
     * below the working directory. To be made on MPI rank 0 only.
     *
     * @throws InputError if the directory cannot be made or written to, or if the
     *         scene reads one of the files that would be removed.
     */
    explicit OutputDirectory(const scene::Scene &scene);

    /** Where a run of @p scene writes to; touches no file. */
    static std::string
    path_of(const scene::Scene &scene);

    const std::string &
    path() const
    {
      return directory;
    }

    /** Path of the file @p name in the directory. */
    std::string
    file(const std::string &name) const
    {
      return directory + "/" + name;
    }

    /** Writes parameters.prm, the complete effective input, given as text. */
    void
    write_parameters(const std::string &content) const;

    /**
     * Removes what runs have left in folders of this one that no run of a study writes to
     * any more: folders with a number and a hyphen at the beginning of their name and with
     * parameters.prm and log.txt inside. Only the files of a run are removed, and the folder
     * if it is empty then.
     *
     * @param runs all runs of the study.
     * @throws InputError if one of them reads a file that would be removed.
     */
    void
    remove_other_runs(const std::vector<const scene::Scene *> &runs) const;

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
    std::string directory;
    std::string scene_name;
  };
} // namespace tetradapt::report

#endif
