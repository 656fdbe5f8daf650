// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/result_folder.h"

#include "result_names.h"

#include "tetradapt/core/atomic_file.h"
#include "tetradapt/core/exceptions.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace tetradapt::report
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr char first_line[] = "tetradapt files 1";
  } // namespace

  ResultFolder::ResultFolder(const std::string &path)
    : directory(made_folder(path)), lock(directory)
  {
    if (lock_problem().empty())
      remove_temporaries_of(list_name, 0); // of a run that was killed
    read_list();
    // Also a test whether files can be made here.
    write_list();
  }

  ResultFolder::~ResultFolder()
  {
    try
      {
        finish();
      }
    catch (const std::exception &)
      {
        // A destructor has nobody to tell; finish() is for those who ask.
      }
  }

  void
  ResultFolder::read_list()
  {
    const std::string path = file(list_name);
    struct stat       status;
    if (::lstat(path.c_str(), &status) != 0)
      return;
    std::ifstream stream(path, std::ios::binary);
    std::string   line;
    if (!S_ISREG(status.st_mode) || !std::getline(stream, line) || line != first_line)
      throw core::InputError("The file '" + path
                             + "', in which the program lists the files that it wrote, is "
                               "damaged. Move the files of this folder away, or choose another "
                               "one in Output.");
    while (std::getline(stream, line))
      {
        const std::size_t blank = line.find(' ');
        if (blank == std::string::npos)
          continue;
        const std::string what = line.substr(0, blank);
        Entry             entry{unescaped(line.substr(blank + 1))};
        entry.is_folder = what == "folder";
        std::from_chars(what.data(), what.data() + what.size(), entry.size);
        if (is_inside(entry.name) && find(entry.name) == nullptr)
          entries.push_back(entry);
      }
  }

  void
  ResultFolder::write_list() const
  {
    std::string text = std::string(first_line) + "\n";
    for (const Entry &entry : entries)
      text += (entry.is_folder  ? "folder"
               : entry.size < 0 ? "?"
                                : std::to_string(entry.size))
              + " " + escaped(entry.name) + "\n";
    core::write_file(file(list_name), text);
  }

  ResultFolder::Entry *
  ResultFolder::find(const std::string &name)
  {
    const auto found = std::find_if(entries.begin(), entries.end(), [&](const Entry &entry) {
      return entry.name == name;
    });
    return found == entries.end() ? nullptr : &*found;
  }

  std::vector<std::string>
  ResultFolder::earlier_files() const
  {
    std::vector<std::string> names;
    for (const Entry &entry : entries)
      if (entry.is_earlier && !entry.is_folder)
        names.push_back(entry.name);
    return names;
  }

  std::vector<std::string>
  ResultFolder::earlier_folders() const
  {
    std::vector<std::string> names;
    for (const Entry &entry : entries)
      if (entry.is_earlier && entry.is_folder)
        names.push_back(entry.name);
    return names;
  }

  /** A file that is missing is unchanged: there is nothing to lose. */
  bool
  ResultFolder::is_unchanged(const Entry &entry) const
  {
    struct stat status;
    if (::lstat(file(entry.name).c_str(), &status) != 0)
      return true;
    return S_ISREG(status.st_mode) && (entry.size < 0 || entry.size == status.st_size);
  }

  void
  ResultFolder::check_free(const std::function<bool(const std::string &)> &is_own) const
  {
    std::string              changed, foreign;
    unsigned int             n_foreign = 0;
    std::vector<std::string> folders{""};
    std::vector<std::string> listed;
    for (const Entry &entry : entries)
      {
        listed.push_back(entry.name);
        if (!entry.is_folder && changed.empty() && !is_unchanged(entry))
          changed = entry.name;
        const std::string folder = fs::path(entry.name).parent_path().string();
        if (std::find(folders.begin(), folders.end(), folder) == folders.end())
          folders.push_back(folder);
      }
    if (std::find(folders.begin(), folders.end(), "plots") == folders.end())
      folders.push_back("plots");
    for (const std::string &folder : folders)
      {
        std::error_code error;
        const fs::path  where = folder.empty() ? directory : directory + "/" + folder;
        if (!folder.empty() && fs::is_symlink(fs::symlink_status(where, error)))
          throw core::InputError("'" + where.string()
                                 + "' is a symbolic link: the program would write to another "
                                   "folder. Remove it, or choose another directory in Output.");
        for (fs::directory_iterator it(where, error), end; !error && it != end; it.increment(error))
          {
            const std::string leaf = it->path().filename().string();
            const std::string name = folder.empty() ? leaf : folder + "/" + leaf;
            if (!is_own(name) || std::find(listed.begin(), listed.end(), name) != listed.end())
              continue;
            if (n_foreign++ == 0 || name < foreign)
              foreign = name;
          }
      }
    const std::string advice = " Move it away, or choose another directory in Output.";
    if (!changed.empty())
      throw core::InputError("The file '" + file(changed)
                             + "' was changed since the program wrote it, and this run would "
                               "remove it."
                             + advice);
    if (n_foreign > 0)
      throw core::InputError("The file '" + file(foreign) + "'"
                             + (n_foreign > 1
                                  ? " and " + std::to_string(n_foreign - 1) + " more were"
                                  : std::string(" was"))
                             + " not written by this program as far as the list '" + list_name
                             + "' in that folder tells, and this run would replace "
                             + (n_foreign > 1 ? "them." : "it.") + advice);
  }

  void
  ResultFolder::remove_temporaries_of(const std::string &name, const long pid) const
  {
    const fs::path        path = file(name);
    std::error_code       error;
    std::vector<fs::path> found;
    const std::string     leaf = path.filename().string();
    for (fs::directory_iterator it(path.parent_path(), error), end; !error && it != end;
         it.increment(error))
      {
        const std::string process = process_of_temporary(it->path().filename().string(), leaf);
        if (!process.empty() && (pid == 0 || process == std::to_string(pid)))
          found.push_back(it->path());
      }
    for (const fs::path &temporary : found)
      ::unlink(temporary.c_str());
  }

  void
  ResultFolder::remove_entry(const Entry &entry) const
  {
    if (entry.is_folder)
      return;
    if (is_unchanged(entry))
      ::unlink(file(entry.name).c_str());
    const fs::path folder = fs::path(entry.name).parent_path();
    if (!folder.empty())
      ::rmdir(file(folder.string()).c_str()); // fails, as it should, where files are left
  }

  void
  ResultFolder::begin()
  {
    if (begun)
      return;
    begun = true;
    std::vector<Entry> kept;
    for (const Entry &entry : entries)
      if (!entry.is_earlier || entry.is_folder)
        kept.push_back(entry);
      else
        {
          if (entry.size < 0 && lock_problem().empty()) // its run was killed while it wrote
            remove_temporaries_of(entry.name, 0);
          remove_entry(entry);
        }
    entries = kept;
    write_list();
  }

  std::string
  ResultFolder::prepare(const std::string &name)
  {
    Entry *entry = find(name);
    if (entry == nullptr || entry->is_earlier)
      {
        struct stat status;
        if (entry == nullptr && ::lstat(file(name).c_str(), &status) == 0)
          throw core::InputError("The file '" + file(name)
                                 + "' was not written by this program and is not replaced. Move "
                                   "it away, or choose another directory in Output.");
        if (entry != nullptr && !is_unchanged(*entry))
          throw core::InputError("The file '" + file(name)
                                 + "' was changed since the program wrote it and is not replaced. "
                                   "Move it away, or choose another directory in Output.");
        if (entry == nullptr)
          {
            entries.emplace_back();
            entry = &entries.back();
          }
        entry->name       = name;
        entry->is_earlier = false;
        entry->size       = -1;
        write_list();
      }
    if (const fs::path folder = fs::path(name).parent_path(); !folder.empty())
      made_folder(file(folder.string()));
    return file(name);
  }

  void
  ResultFolder::write(const std::string &name, const std::string &content)
  {
    core::write_file(prepare(name), content);
  }

  bool
  ResultFolder::rename(const std::string &from, const std::string &to)
  {
    struct stat status;
    Entry      *old = find(to);
    if (from == to)
      return true;
    if ((old == nullptr || !is_unchanged(*old)) && ::lstat(file(to).c_str(), &status) == 0)
      return false;
    prepare(to);
    if (::rename(file(from).c_str(), file(to).c_str()) != 0)
      return false;
    entries.erase(std::remove_if(entries.begin(),
                                 entries.end(),
                                 [&](const Entry &entry) { return entry.name == from; }),
                  entries.end());
    write_list();
    return true;
  }

  void
  ResultFolder::discard(const std::string &name)
  {
    if (const Entry *entry = find(name))
      remove_entry(*entry);
  }

  void
  ResultFolder::add_folder(const std::string &name)
  {
    Entry *entry = find(name);
    if (entry == nullptr)
      {
        entries.emplace_back();
        entry = &entries.back();
      }
    entry->name       = name;
    entry->is_folder  = true;
    entry->is_earlier = false;
    write_list();
  }

  void
  ResultFolder::remove_folder(const std::string &name)
  {
    const std::string path = file(name);
    struct stat       status;
    if (::lstat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)
        && fs::exists(path + "/" + list_name))
      {
        {
          ResultFolder folder(path);
          folder.begin();
          if (folder.entries.empty())
            ::unlink(folder.file(list_name).c_str());
        }
        ::rmdir(path.c_str());
      }
    entries.erase(std::remove_if(entries.begin(),
                                 entries.end(),
                                 [&](const Entry &entry) {
                                   return entry.is_folder && entry.name == name;
                                 }),
                  entries.end());
    write_list();
  }

  void
  ResultFolder::finish()
  {
    bool is_new = false;
    for (Entry &entry : entries)
      if (!entry.is_folder && !entry.is_earlier)
        {
          struct stat status;
          if (::lstat(file(entry.name).c_str(), &status) != 0 || entry.size == status.st_size)
            continue;
          entry.size = status.st_size;
          is_new     = true;
        }
    if (is_new)
      write_list();
  }

  void
  ResultFolder::end_at_once()
  {
    for (const Entry &entry : entries)
      if (!entry.is_earlier && !entry.is_folder)
        remove_temporaries_of(entry.name, ::getpid());
    finish();
    lock.remove_file();
  }
} // namespace tetradapt::report
