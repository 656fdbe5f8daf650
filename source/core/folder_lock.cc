// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/folder_lock.h"

#include "tetradapt/core/exceptions.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>

namespace tetradapt::core
{
  namespace
  {
    std::string
    host_name()
    {
      char name[256] = "";
      ::gethostname(name, sizeof name - 1);
      return name;
    }

    /** What the owner of the lock wrote in the file, if it did. */
    std::string
    owner(const int descriptor)
    {
      char          bytes[300];
      const ssize_t n = ::pread(descriptor, bytes, sizeof bytes, 0);
      std::string   text(bytes, std::max<ssize_t>(n, 0));
      text.resize(std::min(text.find('\n'), text.size()));
      for (char &c : text)
        c = std::isprint(static_cast<unsigned char>(c)) ? c : '?';
      return text.empty() ? "" : " (" + text + ")";
    }

    [[noreturn]] void
    fail(const std::string &path, const int error)
    {
      const std::string text
        = "Cannot open the lock '" + path + "': " + std::strerror(error) + ". ";
      if (error == ENOSPC || error == EDQUOT || error == EIO || error == EMFILE || error == ENFILE)
        throw NumericalError(text + "Make room there, or choose another folder in Output.");
      throw InputError(text
                       + "Make sure that its folder may be written to, or choose another "
                         "one in Output.");
    }
  } // namespace

  FolderLock::FolderLock(const std::string &folder) : path(folder + "/" + file_name)
  {
    // Who opened the file before its last owner removed it holds a lock on nothing, and
    // tries again.
    do
      {
        if (descriptor >= 0)
          ::close(descriptor);
        descriptor
          = ::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK, 0666);
        if (descriptor < 0)
          fail(path, errno);
        int result;
        do
          result = ::flock(descriptor, LOCK_EX | LOCK_NB);
        while (result != 0 && errno == EINTR);
        if (result != 0 && errno == EWOULDBLOCK)
          {
            const std::string who = owner(descriptor);
            ::close(descriptor);
            throw InputError("Another run" + who + " is writing to the folder '" + folder
                             + "'. Wait until it is done, or choose another folder in Output.");
          }
        if (result != 0)
          trouble = std::strerror(errno);
    } while (trouble.empty() && !is_current());
    note_owner();
  }

  FolderLock::~FolderLock()
  {
    remove_file();
    ::close(descriptor);
  }

  void
  FolderLock::remove_file() const
  {
    // While the lock is held: nobody else can have made a file of this name.
    if (is_current())
      ::unlink(path.c_str());
  }

  /** Whether the open file is the one that the name stands for. */
  bool
  FolderLock::is_current() const
  {
    struct stat open_file, named_file;
    return ::fstat(descriptor, &open_file) == 0 && ::lstat(path.c_str(), &named_file) == 0
           && open_file.st_dev == named_file.st_dev && open_file.st_ino == named_file.st_ino;
  }

  void
  FolderLock::note_owner() const
  {
    const std::string text = "process " + std::to_string(::getpid()) + " on " + host_name() + "\n";
    // For messages only: a disk that is full is no obstacle here.
    if (::ftruncate(descriptor, 0) == 0 && ::pwrite(descriptor, text.data(), text.size(), 0) < 0)
      return;
  }
} // namespace tetradapt::core
