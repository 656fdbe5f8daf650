// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/atomic_file.h"

#include "tetradapt/core/exceptions.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace tetradapt::core
{
  namespace fs = std::filesystem;

  namespace
  {
    /** Creates an empty file that did not exist. The process number keeps two
     * programs apart, the attempt what a killed one has left. open() and not
     * mkstemp(), so that the user's umask decides on the permissions. */
    std::string
    create_temporary(const fs::path &target, const std::string &name)
    {
      const fs::path directory = target.has_parent_path() ? target.parent_path() : fs::path(".");
      for (unsigned int attempt = 0; attempt < 1000; ++attempt)
        {
          const std::string candidate
            = (directory
               / ("." + target.filename().string() + "." + std::to_string(::getpid()) + "."
                  + std::to_string(attempt) + ".tmp"))
                .string();
          const int descriptor
            = ::open(candidate.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
          if (descriptor >= 0)
            {
              ::close(descriptor);
              return candidate;
            }
          if (errno != EEXIST)
            throw InputError("Cannot write the file '" + name + "': " + std::strerror(errno)
                             + ". Make sure that the folder '" + directory.string()
                             + "' exists and may be written to.");
        }
      throw InputError("Cannot write the file '" + name
                       + "': the folder holds too many temporary files of it; remove '."
                       + target.filename().string() + ".*.tmp'.");
    }
  } // namespace

  AtomicFile::AtomicFile(const std::string &path) : name(path)
  {
    std::error_code error;
    const auto      status = fs::status(path, error);
    if (path.empty() || fs::is_directory(status))
      throw InputError("Cannot write the file '" + name
                       + "': " + (path.empty() ? "the name is empty." : "a folder has this name."));
    // Renaming over a device would replace it by a plain file.
    if (fs::exists(status) && !fs::is_regular_file(status))
      throw InputError("Cannot write the file '" + name
                       + "': it exists and is not a regular file.");

    target = fs::exists(status) ? fs::canonical(path, error).string() : path;
    if (error || target.empty())
      target = path;
    temporary = create_temporary(target, name);
    errno     = 0;
    out.open(temporary, std::ios::binary | std::ios::trunc);
    if (!out)
      {
        const int reason = errno;
        ::unlink(temporary.c_str());
        throw InputError("Cannot write the file '" + name + "': " + std::strerror(reason) + ".");
      }
  }

  AtomicFile::~AtomicFile()
  {
    if (!temporary.empty())
      {
        out.close();
        ::unlink(temporary.c_str());
      }
  }

  void
  AtomicFile::fail(const std::string &what, const int error_number)
  {
    out.close();
    ::unlink(temporary.c_str());
    temporary.clear();
    throw NumericalError("Cannot " + what + " the file '" + name + "': "
                         + (error_number != 0 ? std::strerror(error_number) : "a write failed")
                         + ". Make room on the disk or choose another output directory.");
  }

  void
  AtomicFile::commit(const bool sync)
  {
    if (temporary.empty())
      return;
    errno = 0;
    out.flush();
    if (!out)
      {
        // A write that failed earlier has left no reason behind: trying again
        // tells it (the stream itself refuses to once it has failed).
        int reason = errno;
        if (reason == 0)
          {
            out.clear();
            out.put('\n').flush();
            reason = errno;
          }
        fail("write", reason);
      }
    errno = 0;
    out.close();
    if (!out)
      fail("write", errno);
    if (sync)
      {
        const int descriptor = ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC);
        if (descriptor < 0 || ::fsync(descriptor) != 0)
          {
            const int reason = errno;
            if (descriptor >= 0)
              ::close(descriptor);
            fail("write", reason);
          }
        ::close(descriptor);
      }
    if (std::rename(temporary.c_str(), target.c_str()) != 0)
      fail("rename", errno);
    temporary.clear();
  }

  void
  write_file(const std::string &path, const std::string &content)
  {
    AtomicFile file(path);
    file.stream().write(content.data(), content.size());
    file.commit();
  }
} // namespace tetradapt::core
