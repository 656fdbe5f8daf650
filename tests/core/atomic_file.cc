// SPDX-License-Identifier: AGPL-3.0-or-later
// Files appear whole or not at all, and what cannot be written says why.

#include "tetradapt/core/atomic_file.h"

#include "tetradapt/core/exceptions.h"

#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

using namespace tetradapt;
namespace fs = std::filesystem;

const std::string folder = "atomic_file_scratch";

std::string
content(const std::string &path)
{
  std::ifstream      in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return in ? text.str() : "(none)";
}

unsigned int
n_files()
{
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
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
      std::cout << "InputError: " << e.what() << std::endl;
    }
  catch (const core::NumericalError &e)
    {
      std::cout << "NumericalError: " << e.what() << std::endl;
    }
}

int
main()
{
  fs::remove_all(folder);
  fs::create_directory(folder);
  const std::string path = folder + "/a.txt";

  {
    core::AtomicFile file(path);
    file.stream() << "first" << std::flush;
    std::cout << "before commit: " << fs::exists(path) << ", files " << n_files() << std::endl;
    file.commit();
    std::cout << "after commit: " << content(path) << ", files " << n_files() << std::endl;
    file.commit(); // a second one does nothing
  }
  {
    core::AtomicFile file(path);
    file.stream() << "second" << std::flush;
    std::cout << "while writing: " << content(path) << ", files " << n_files() << std::endl;
  }
  std::cout << "not committed: " << content(path) << ", files " << n_files() << std::endl;

  try
    {
      core::AtomicFile file(path);
      file.stream() << "third";
      throw std::runtime_error("stop");
    }
  catch (const std::runtime_error &)
    {
      std::cout << "exception: " << content(path) << ", files " << n_files() << std::endl;
    }

  {
    // Two at once do not disturb each other; the last to commit stays.
    core::AtomicFile one(path), two(path);
    one.stream() << "one";
    two.stream() << "two";
    two.commit(true);
    one.commit();
    std::cout << "two writers: " << content(path) << ", files " << n_files() << std::endl;
  }

  const std::string binary("a\0b\r\n\xff", 6);
  core::write_file(path, binary);
  std::cout << "bytes kept: " << (content(path) == binary) << std::endl;

  fs::create_symlink("a.txt", folder + "/link");
  core::write_file(folder + "/link", "not through the link");
  std::cout << "link kept: " << fs::is_symlink(folder + "/link")
            << ", its target is: " << (content(path) == binary)
            << ", file: " << content(folder + "/link") << std::endl;

  expect_error([] { core::write_file(folder + "/missing/a.txt", ""); });
  expect_error([] { core::write_file(folder, ""); });
  expect_error([] { core::write_file("", ""); });
  expect_error([] { core::write_file("/dev/null", ""); });
  std::cout << "/dev/null still a device: " << fs::is_character_file("/dev/null") << std::endl;

  // The same reason, however small the writes were, and whoever asks first.
  expect_error([] {
    core::AtomicFile file(folder + "/b.txt");
    file.stream() << std::string(70000, 'x');
    file.stream().setstate(std::ios::badbit);
    file.commit();
  });
  {
    core::AtomicFile  file(folder + "/b.txt");
    const std::string long_text(200000, 'y');
    file.stream() << "start" << long_text << 'z' << std::flush << long_text
                  << std::string(65536, 'w');
    file.commit(true);
    std::cout << "all of it: "
              << (content(folder + "/b.txt")
                  == "start" + long_text + "z" + long_text + std::string(65536, 'w'))
              << std::endl;
    fs::remove(folder + "/b.txt");
    fs::remove(folder + "/link");
    core::write_file(path, "as before");
  }

  // A disk that is full: no file may grow beyond 4096 bytes.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  limit.rlim_cur = 4096;
  setrlimit(RLIMIT_FSIZE, &limit);
  expect_error([&] { core::write_file(path, std::string(100000, 'x')); });
  expect_error([&] {
    // Many small writes fail long before the commit.
    core::AtomicFile file(path);
    for (unsigned int i = 0; i < 100000; ++i)
      file.stream() << "line\n";
    file.commit();
  });
  std::cout << "full disk: " << content(path) << ", files " << n_files() << std::endl;
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_FSIZE, &limit);

  fs::remove_all(folder);
}
