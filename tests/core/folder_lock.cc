// SPDX-License-Identifier: AGPL-3.0-or-later
// One process a folder, whatever became of the one before.

#include "tetradapt/core/folder_lock.h"

#include "tetradapt/core/exceptions.h"

#include <sys/file.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>

using namespace tetradapt;
namespace fs = std::filesystem;

namespace
{
  const std::string folder = "folder_lock_scratch";

  /** What the file system answers instead of locking, if not 0. */
  int answer = 0;
} // namespace

/** In front of the C library's. */
extern "C" int
flock(const int descriptor, const int operation) noexcept
{
  if (answer == 0)
    return static_cast<int>(::syscall(SYS_flock, descriptor, operation));
  errno = answer;
  return -1;
}

namespace
{
  bool
  is_free()
  {
    try
      {
        const core::FolderLock lock(folder);
        return true;
      }
    catch (const core::InputError &error)
      {
        const std::string text = error.what();
        std::cout << "  refused: " << text.substr(0, text.find('(')) << "(...)"
                  << text.substr(text.find(')') + 1) << ", names itself: "
                  << (text.find("process " + std::to_string(::getpid())) != std::string::npos)
                  << std::endl;
        return false;
      }
  }

  /** A child that has the lock and waits; the pipe says when. */
  pid_t
  start_owner()
  {
    int ends[2];
    if (::pipe(ends) != 0)
      return -1;
    const pid_t child = ::fork();
    if (child == 0)
      {
        const core::FolderLock lock(folder);
        if (::write(ends[1], "x", 1) == 1)
          ::pause();
        ::_exit(0);
      }
    char       c;
    const bool is_ready = ::read(ends[0], &c, 1) == 1;
    ::close(ends[0]);
    ::close(ends[1]);
    return is_ready ? child : -1;
  }
} // namespace

int
main()
{
  fs::remove_all(folder);
  fs::create_directory(folder);
  {
    const core::FolderLock lock(folder);
    std::cout << "locked twice: " << is_free() << std::endl;
  }
  std::cout << "later: " << is_free() << ", empty: " << fs::is_empty(folder) << std::endl;

  const pid_t child = start_owner();
  ::kill(child, SIGSTOP); // one that sleeps has it still
  try
    {
      const core::FolderLock lock(folder);
    }
  catch (const core::InputError &error)
    {
      std::cout << "another process is named: "
                << (std::string(error.what()).find("process " + std::to_string(child))
                    != std::string::npos)
                << std::endl;
    }
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  std::cout << "killed: left " << fs::exists(folder + "/" + core::FolderLock::file_name)
            << ", free " << is_free() << ", left " << !fs::is_empty(folder) << std::endl;

  // What a crash or another program left is no lock.
  std::ofstream(folder + "/" + core::FolderLock::file_name) << "process 1 on moon\n";
  std::cout << "a file only: " << is_free() << std::endl;

  // File systems without locks.
  for (const int error : {ENOLCK, EOPNOTSUPP, ENOSYS})
    {
      answer = error;
      const core::FolderLock lock(folder), another(folder);
      std::cout << "no locks: " << lock.problem() << std::endl;
    }
  answer = 0;

  // No file is written through a link.
  std::ofstream(folder + "/victim") << "text";
  fs::create_symlink("victim", folder + "/" + core::FolderLock::file_name);
  try
    {
      const core::FolderLock lock(folder);
    }
  catch (const core::InputError &error)
    {
      std::cout << error.what() << ' ' << fs::file_size(folder + "/victim") << std::endl;
    }
  try
    {
      const core::FolderLock lock(folder + "/missing");
    }
  catch (const core::InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
  fs::remove_all(folder);
}
