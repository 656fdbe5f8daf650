// SPDX-License-Identifier: AGPL-3.0-or-later
// The list of files that the program wrote: only those are removed or replaced, and only
// when the new run has something to show.

#include "tetradapt/report/result_folder.h"

#include "tetradapt/core/exceptions.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>

using namespace tetradapt;
namespace fs = std::filesystem;

namespace
{
  const std::string folder = "result_folder_scratch";

  void
  put(const std::string &name, const std::string &text)
  {
    std::ofstream(folder + "/" + name) << text;
  }

  std::string
  content(const std::string &name)
  {
    std::ostringstream text;
    text << std::ifstream(folder + "/" + name).rdbuf();
    return text.str();
  }

  void
  print_files(const std::string &what)
  {
    std::set<std::string> names;
    for (const auto &entry : fs::recursive_directory_iterator(folder))
      if (entry.path().filename() != report::ResultFolder::list_name)
        names.insert(fs::relative(entry.path(), folder).string());
    std::cout << what << ':';
    for (const std::string &name : names)
      std::cout << ' ' << name;
    std::cout << std::endl;
  }

  template <typename Action>
  void
  expect_error(const Action &action)
  {
    try
      {
        action();
        std::cout << "no error" << std::endl;
      }
    catch (const core::InputError &e)
      {
        // Which process it is, differs.
        std::string       text    = e.what();
        const std::size_t process = text.find(" (process ");
        if (process != std::string::npos)
          text.erase(process, text.find(')', process) + 1 - process);
        std::cout << text << std::endl;
      }
  }

  bool
  is_own(const std::string &name)
  {
    return name == "a.csv" || name == "b.csv" || name == "plots/c.svg";
  }

  void
  start()
  {
    fs::remove_all(folder);
    fs::create_directory(folder);
    put("mine.txt", "mine");
    report::ResultFolder results(folder);
    results.begin();
    results.write("a.csv", "old a");
    results.write("a.csv", "old a, longer");
    results.write("b.csv", "old b");
    results.write("plots/c.svg", "old c");
  }

  void
  one_run_after_another()
  {
    start();
    print_files("first run");
    {
      // One that fails before it has something to show.
      report::ResultFolder results(folder);
      results.check_free(is_own);
      std::cout << "earlier:";
      for (const std::string &name : results.earlier_files())
        std::cout << ' ' << name;
      std::cout << std::endl;
      results.write("log.txt", "it failed");
      expect_error([] { report::ResultFolder second(folder); });
    }
    print_files("a failing run");
    std::cout << content("a.csv") << ", " << content("mine.txt") << std::endl;
    {
      report::ResultFolder results(folder);
      put("plots/mine.svg", "mine");
      results.begin();
      print_files("begun");
      results.write("a.csv", "new a");
      results.begin(); // once is enough
    }
    print_files("a later run");
    std::cout << content("a.csv") << std::endl;
  }

  void
  foreign_files()
  {
    start();
    put("a.csv", "changed by somebody");
    expect_error([] { report::ResultFolder(folder).check_free(is_own); });
    {
      report::ResultFolder results(folder);
      results.begin();
      std::cout << content("a.csv") << ", b: " << fs::exists(folder + "/b.csv") << std::endl;
      expect_error([&] { results.write("a.csv", "new"); });
    }
    std::cout << content("a.csv") << std::endl;

    start();
    fs::remove(folder + "/" + report::ResultFolder::list_name);
    expect_error([] { report::ResultFolder(folder).check_free(is_own); });

    start();
    fs::rename(folder + "/a.csv", folder + "/elsewhere");
    fs::create_symlink("elsewhere", folder + "/a.csv");
    expect_error([] { report::ResultFolder(folder).check_free(is_own); });
    report::ResultFolder(folder).begin();
    std::cout << "behind a link: " << content("elsewhere") << std::endl;

    start();
    fs::remove_all(folder + "/plots");
    fs::create_directory(folder + "/other");
    fs::create_symlink("other", folder + "/plots");
    expect_error([] { report::ResultFolder(folder).check_free(is_own); });
  }

  /** A list that somebody made, or damaged. */
  void
  foreign_lists()
  {
    start();
    put("../result_folder_victim", "kept");
    const std::string victim = fs::absolute("result_folder_victim").string();
    put(report::ResultFolder::list_name,
        "tetradapt files 1\n4 ../result_folder_victim\n4 " + victim
          + "\n4 plots/../../result_folder_victim\n4 .\n4 mine.txt/..\nfolder ..\n\n? \nfolder\n");
    {
      report::ResultFolder results(folder);
      std::cout << "taken: " << results.earlier_files().size() << ' '
                << results.earlier_folders().size() << std::endl;
      results.begin();
    }
    std::cout << "outside: " << content("../result_folder_victim") << std::endl;
    fs::remove(victim);
    put(report::ResultFolder::list_name, "something else\n");
    expect_error([] { report::ResultFolder results(folder); });
    fs::remove(folder + "/" + report::ResultFolder::list_name);
    fs::create_symlink("mine.txt", folder + "/" + report::ResultFolder::list_name);
    expect_error([] { report::ResultFolder results(folder); });
    std::cout << content("mine.txt") << std::endl;
  }

  void
  names_and_temporaries()
  {
    start();
    const std::string odd = "line\nend \\ and blank.pvd";
    report::ResultFolder(folder).write(odd, "old");
    // What a killed run leaves: a file of unknown size, and its temporary.
    put(report::ResultFolder::list_name, content(report::ResultFolder::list_name) + "? d.vtu\n");
    put(".d.vtu.4321.0.tmp", "half");
    put(".d.vtu.4321.tmp", "mine");
    put(".mine.txt.4321.0.tmp", "mine");
    put("d.vtu", "whole");
    {
      report::ResultFolder results(folder);
      results.begin();
      std::cout << "odd name: " << fs::exists(folder + "/" + odd) << std::endl;
      print_files("after a killed run");
      put("log_new", "log");
      expect_error([&] { results.prepare("mine.txt"); });
      std::ofstream(results.prepare("log_new2")) << "log";
      std::cout << "renamed: " << results.rename("log_new2", "mine.txt")
                << results.rename("log_new2", "log") << results.rename("log", "log") << ' '
                << content("log") << ", " << content("mine.txt") << std::endl;
    }
  }

  void
  folders()
  {
    start();
    {
      report::ResultFolder results(folder);
      for (const std::string name : {"01", "02", "03"})
        {
          results.add_folder(name);
          report::ResultFolder run(folder + "/" + name);
          run.begin();
          run.write("a.csv", name);
          run.write("plots/c.svg", name);
        }
    }
    put("02/mine.txt", "mine");
    fs::create_directory(folder + "/04");
    put("04/mine.txt", "mine");
    {
      report::ResultFolder results(folder);
      results.add_folder("03");
      results.begin();
      for (const std::string &name : results.earlier_folders())
        results.remove_folder(name);
    }
    print_files("runs of a study");
    report::ResultFolder results(folder), run(folder + "/03");
    expect_error([&] { results.remove_folder("03"); });
  }
} // namespace

int
main()
{
  one_run_after_another();
  foreign_files();
  foreign_lists();
  names_and_temporaries();
  folders();
  fs::remove_all(folder);
}
