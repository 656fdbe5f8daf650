// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/atomic_file.h"

#include "tetradapt/core/exceptions.h"

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
    [[noreturn]] void
    fail_to_create(const std::string &name, const std::string &directory, const int error)
    {
      const std::string text = "Cannot write the file '" + name + "': " + std::strerror(error);
      if (error == ENOSPC || error == EDQUOT || error == EIO || error == EMFILE || error == ENFILE)
        throw NumericalError(text + ". Make room on the disk or choose another output directory.");
      throw InputError(text + ". Make sure that the folder '" + directory
                       + "' exists and may be written to.");
    }

    /** Creates an empty file that did not exist and returns its name. The process number
     * keeps two programs apart, the attempt what a killed one has left. */
    std::string
    create_temporary(DescriptorBuffer &buffer, const std::string &name)
    {
      const fs::path target(name);
      const fs::path directory = target.has_parent_path() ? target.parent_path() : fs::path(".");
      for (unsigned int attempt = 0; attempt < 1000; ++attempt)
        {
          const std::string candidate
            = (directory
               / ("." + target.filename().string() + "." + std::to_string(::getpid()) + "."
                  + std::to_string(attempt) + ".tmp"))
                .string();
          const int error = buffer.create(candidate);
          if (error == 0)
            return candidate;
          if (error != EEXIST)
            fail_to_create(name, directory.string(), error);
        }
      throw InputError("Cannot write the file '" + name
                       + "': the folder holds too many temporary files of it; remove '."
                       + target.filename().string() + ".*.tmp'.");
    }
  } // namespace

  AtomicFile::AtomicFile(const std::string &path) : name(path), out(&buffer)
  {
    std::error_code error;
    const auto      status = fs::symlink_status(path, error);
    if (path.empty() || fs::is_directory(status))
      throw InputError("Cannot write the file '" + name
                       + "': " + (path.empty() ? "the name is empty." : "a folder has this name."));
    // Renaming over a device would replace it by a plain file.
    if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_symlink(status))
      throw InputError("Cannot write the file '" + name
                       + "': it exists and is not a regular file.");
    temporary = create_temporary(buffer, name);
  }

  AtomicFile::~AtomicFile()
  {
    if (!temporary.empty())
      {
        buffer.close();
        ::unlink(temporary.c_str());
      }
  }

  void
  AtomicFile::fail(const std::string &what, const int error_number)
  {
    buffer.close();
    ::unlink(temporary.c_str());
    temporary.clear();
    throw NumericalError("Cannot " + what + " the file '" + name
                         + "': " + std::strerror(error_number)
                         + ". Make room on the disk or choose another output directory.");
  }

  void
  AtomicFile::commit(const bool sync)
  {
    if (temporary.empty())
      return;
    if (sync && buffer.sync_to_disk() != 0)
      fail("write", buffer.error());
    if (buffer.close() != 0)
      fail("write", buffer.error());
    if (!out) // somebody set the stream's state
      fail("write", EIO);
    if (std::rename(temporary.c_str(), name.c_str()) != 0)
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
