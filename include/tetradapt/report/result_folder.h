// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_result_folder_h
#define tetradapt_report_result_folder_h

#include "tetradapt/core/folder_lock.h"

#include <functional>
#include <string>
#include <vector>

namespace tetradapt::report
{
  /**
   * A folder of results that knows which of its files the program wrote: it keeps a list of
   * them in the folder, and never removes or replaces a file that is not on it, or that was
   * changed since (its size is not the one on the list, or it has become a link). One
   * process at a time: see core::FolderLock.
   *
   * What an earlier run left stays until begin(). All files are written through write() or
   * to the path that prepare() returns.
   */
  class ResultFolder
  {
  public:
    /** Name of the list. */
    static constexpr char list_name[] = ".tetradapt-files";

    /**
     * Opens @p path, which is made if it is missing.
     * @throws InputError if it cannot be made or written to, if another run writes to it,
     *         or if its list is damaged.
     */
    explicit ResultFolder(const std::string &path);

    /** Calls finish(); what fails then is not told. */
    ~ResultFolder();
    ResultFolder(const ResultFolder &) = delete;
    ResultFolder &
    operator=(const ResultFolder &)
      = delete;

    const std::string &
    path() const
    {
      return directory;
    }

    /** Path of the file @p name in the folder. */
    std::string
    file(const std::string &name) const
    {
      return directory + "/" + name;
    }

    /** Why the folder is not locked; empty if it is. */
    const std::string &
    lock_problem() const
    {
      return lock.problem();
    }

    /** Names of the files that earlier runs left, and that begin() removes. */
    std::vector<std::string>
    earlier_files() const;

    /** Names of the folders in this one that earlier runs have added. */
    std::vector<std::string>
    earlier_folders() const;

    /**
     * @throws InputError naming a file that a run would replace or remove (an earlier file,
     *         or a name for which @p is_own) though the program did not write it, or not as
     *         it is now.
     */
    void
    check_free(const std::function<bool(const std::string &)> &is_own) const;

    /** Removes what earlier runs left: from now on there are results of this one. Only the
     * first call does something. */
    void
    begin();

    bool
    has_begun() const
    {
      return begun;
    }

    /**
     * Puts @p name ("results.csv", "plots/ren.svg") on the list before it is written, and
     * makes the folder that it lies in.
     * @return the path to write to.
     * @throws InputError if a file of this name is there that is not on the list, or that
     * was changed since an earlier run wrote it.
     */
    std::string
    prepare(const std::string &name);

    /** Writes a file as core::write_file() does. */
    void
    write(const std::string &name, const std::string &content);

    /** Gives a file of this run another name, if no foreign file has that. Returns whether
     * it has it now. */
    bool
    rename(const std::string &from, const std::string &to);

    /** Removes the file @p name if it is on the list. */
    void
    discard(const std::string &name);

    /** Puts the folder @p name in this one on the list. */
    void
    add_folder(const std::string &name);

    /** Removes what runs wrote to the folder @p name in this one, and the folder if it is
     * empty then. @throws InputError if another run writes to it. */
    void
    remove_folder(const std::string &name);

    /** Notes the sizes of all files, by which a change of one will be noticed. */
    void
    finish();

    /** For a process that ends at once: finish(), and removes the temporary files that it is
     * writing and the lock. */
    void
    end_at_once();

  private:
    struct Entry
    {
      std::string name;
      bool        is_folder  = false;
      bool        is_earlier = true;
      long long   size       = -1; ///< bytes, or -1: being written, or was when its run died
    };

    void
    read_list();
    void
    write_list() const;
    Entry *
    find(const std::string &name);
    bool
    is_unchanged(const Entry &entry) const;
    void
    remove_entry(const Entry &entry) const;
    /** Temporary files of @p name; of process @p pid only if it is not 0. */
    void
    remove_temporaries_of(const std::string &name, long pid) const;

    std::string        directory;
    core::FolderLock   lock;
    std::vector<Entry> entries;
    bool               begun = false;
  };
} // namespace tetradapt::report

#endif
