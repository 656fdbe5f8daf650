// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_atomic_file_h
#define tetradapt_core_atomic_file_h

#include "tetradapt/core/descriptor_buffer.h"

#include <ostream>
#include <string>

namespace tetradapt::core
{
  /**
   * A file that appears whole or not at all: everything goes to a temporary file
   * in the same directory, which commit() renames. Whoever reads the name meanwhile
   * sees the earlier file or none. Destroyed without commit(), for example by an
   * exception, it leaves nothing behind.
   *
   * A name that is a symbolic link is replaced itself; what it points to stays as it is.
   */
  class AtomicFile
  {
  public:
    /**
     * Opens a temporary file next to @p path (binary mode).
     * @throws InputError with the path and the system's reason if the directory
     *         does not exist or may not be written to, or if @p path is a
     *         directory or a device; NumericalError if the disk is full.
     */
    explicit AtomicFile(const std::string &path);
    ~AtomicFile();

    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &
    operator=(const AtomicFile &)
      = delete;

    /** What to write to. Its state is checked by commit(): no need to after each
     * write. */
    std::ostream &
    stream()
    {
      return out;
    }

    /**
     * Closes the temporary file and gives it its name. A program that dies never
     * leaves half a file then.
     * @param sync also waits until the disk has it, so that a power failure does
     *        not leave half a file either; costs some milliseconds.
     * @throws NumericalError with the path and the system's reason if something
     *         could not be written (a full disk) or renamed.
     */
    void
    commit(bool sync = false);

    const std::string &
    path() const
    {
      return name;
    }

  private:
    void
    fail(const std::string &what, int error_number);

    std::string      name;
    std::string      temporary; ///< empty once renamed or removed
    DescriptorBuffer buffer;
    std::ostream     out;
  };

  /** Writes @p content to @p path by an AtomicFile. @throws as AtomicFile does. */
  void
  write_file(const std::string &path, const std::string &content);
} // namespace tetradapt::core

#endif
