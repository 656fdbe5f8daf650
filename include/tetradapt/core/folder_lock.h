// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_folder_lock_h
#define tetradapt_core_folder_lock_h

#include <string>

namespace tetradapt::core
{
  /**
   * Keeps a folder for one process: a lock of the system (flock) on a file in it. The lock
   * ends with the process, however that ends, so that the file of a killed one is no
   * obstacle; it is removed when the object is destroyed.
   */
  class FolderLock
  {
  public:
    /** Name of the file in the folder. */
    static constexpr char file_name[] = ".tetradapt-lock";

    /**
     * Locks @p folder, which must exist.
     * @throws InputError if another process (or object) has locked it, naming that process,
     *         or if the file cannot be made.
     */
    explicit FolderLock(const std::string &folder);
    ~FolderLock();
    FolderLock(const FolderLock &) = delete;
    FolderLock &
    operator=(const FolderLock &)
      = delete;

    /** Why there is no lock although nobody else has one (a file system without locks);
     * empty if there is one. */
    const std::string &
    problem() const
    {
      return trouble;
    }

    /** Removes the file, for a process that ends without destroying the object. */
    void
    remove_file() const;

  private:
    bool
    is_current() const;
    void
    note_owner() const;

    std::string path;
    std::string trouble;
    int         descriptor = -1;
  };
} // namespace tetradapt::core

#endif
