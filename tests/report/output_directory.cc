// SPDX-License-Identifier: AGPL-3.0-or-later
// The output directory, the log's sinks and the stage timer.

#include "tetradapt/report/output_directory.h"

#include "tetradapt/core/atomic_file.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/stage_timer.h"
#include "tetradapt/report/log_sinks.h"

#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <set>
#include <sstream>
#include <thread>

using namespace tetradapt;
namespace fs = std::filesystem;

const std::string folder = "output_directory_scratch";

void
print_files(const std::string &what)
{
  std::set<std::string> names;
  for (const auto &entry : fs::recursive_directory_iterator(folder + "/run"))
    if (entry.path().filename() != report::ResultFolder::list_name && !entry.is_directory())
      names.insert(fs::relative(entry.path(), folder + "/run").string());
  std::cout << what << ':';
  for (const std::string &name : names)
    std::cout << ' ' << name;
  std::cout << std::endl;
}

std::string
content(const std::string &name)
{
  std::ostringstream text;
  text << std::ifstream(folder + "/run/" + name).rdbuf();
  return text.str();
}

/** A run that writes a log and, if it comes so far, results. */
void
run(const scene::Scene &scene, const std::string &number, const bool has_cycle)
{
  report::OutputDirectory directory(scene, "parameters " + number);
  std::ofstream           log(directory.log_path());
  log << "log " << number << std::flush;
  if (has_cycle)
    {
      directory.begin();
      directory.files().write("cycle_000.vtu", number);
      directory.files().write("plots/ren.svg", number);
    }
  std::cout << "  " << directory.kept_results() << std::endl;
  log << " end" << std::flush;
  directory.end();
}

void
test_runs(const scene::Scene &scene)
{
  run(scene, "1", false);
  print_files("failed");
  run(scene, "2", true);
  print_files("done");
  core::write_file(folder + "/run/notes.txt", "mine");
  core::write_file(folder + "/run/cycle_1.vtu.bak", "mine");
  run(scene, "3", false);
  print_files("failed");
  run(scene, "4", false);
  print_files("failed again");
  std::cout << content("log.txt") << ", " << content("log_failed.txt") << ", "
            << content("parameters.prm") << ", " << content("cycle_000.vtu") << std::endl;
  run(scene, "5", true);
  print_files("done again");
  std::cout << content("log.txt") << ", " << content("parameters.prm") << ", "
            << content("cycle_000.vtu") << std::endl;
}

void
test_directory()
{
  scene::Scene scene;
  scene.name = "beam";
  scene.file = "prm/beam.prm";
  std::cout << "default: " << report::OutputDirectory::path_of(scene) << std::endl;
  scene.output.directory = folder + "/run";
  test_runs(scene);

  const auto expect_error = [&] {
    try
      {
        const report::OutputDirectory directory(scene, "");
        std::cout << "no error" << std::endl;
      }
    catch (const core::InputError &e)
      {
        std::cout << e.what() << std::endl;
      }
  };
  // Results that the scene itself reads are not thrown away.
  scene.reference.type = scene::ReferenceParameters::Type::run;
  scene.reference.file = folder + "/./run/cycle_000.vtu";
  expect_error();
  scene.reference.type = scene::ReferenceParameters::Type::none;
  scene.mesh.source    = scene::MeshSource::file;
  scene.mesh.files     = {folder + "/run/cycle_000.vtu"};
  expect_error();
  scene.mesh.files.clear();

  // Neither are files that a run would write, but did not.
  for (const std::string name : {"convergence.csv", "cycle_0123.vtu", "beam.pvd", "plots/ren.gp"})
    {
      core::write_file(folder + "/run/" + name, "mine");
      expect_error();
      fs::remove(folder + "/run/" + name);
    }
  for (const std::string name : {"cycle_.vtu", "my_cycle_000.vtu", "plate.pvd", "plots/my.svg"})
    core::write_file(folder + "/run/" + name, "mine");
  expect_error();

  // Nor are those of a study's run that this study still has.
  scene::Scene first = scene, second = scene;
  first.output.directory  = folder + "/run/01";
  second.output.directory = folder + "/run/02";
  {
    report::OutputDirectory study(scene, "study", {&first, &second});
    study.begin();
    run(first, "6", true);
    run(second, "7", true);
    study.files().write("study.csv", "old");
    study.end();
    std::cout << study.files_to_look_at() << std::endl;
  }
  first.reference.type = scene::ReferenceParameters::Type::run;
  first.reference.file = folder + "/run/02/cycle_000.vtu";
  {
    report::OutputDirectory study(scene, "study", {&first, &second});
  }
  try
    {
      report::OutputDirectory study(scene, "study", {&first});
    }
  catch (const core::InputError &e)
    {
      std::cout << e.what() << std::endl;
    }
  first.reference.type = scene::ReferenceParameters::Type::none;
  {
    report::OutputDirectory study(scene, "study", {&first});
    print_files("a study that has not begun");
    study.begin();
    print_files("a study that has");
  }

  scene.output.directory = folder + "/run/notes.txt";
  expect_error();
  scene.output.directory = folder + "/run/notes.txt/below";
  expect_error();
  scene.output.directory = folder + "/" + std::string(300, 'x');
  expect_error();
  fs::create_symlink("loop", folder + "/loop");
  scene.output.directory = folder + "/loop";
  expect_error();
}

/** Text with control characters made visible. */
std::string
visible(const std::string &text)
{
  std::string result;
  for (const char c : text)
    if (c == '\r')
      result += "<CR>";
    else if (c == '\033')
      result += "<ESC>";
    else
      result += c;
  return result;
}

std::string
terminal_output(const bool is_terminal, const bool quiet, const double min_interval)
{
  core::Log                     log;
  std::ostringstream            stream;
  report::TerminalSink::Options options;
  options.is_terminal  = is_terminal;
  options.quiet        = quiet;
  options.width        = 12;
  options.min_interval = min_interval;
  {
    const report::TerminalSink sink(log, stream, options);
    log.progress("step 1e-1 of 20");
    log.progress("step 2.5 of 20\nmore");
    log.progress("another stage");
    const core::Log in_cycle = log.with_progress_prefix("c 3: ");
    in_cycle.progress("step 3");
    in_cycle.info("as it is");
    log.info("info");
    log.progress("");
    log.progress("12345678 \xc3\xa9t\xc3\xa9"); // cut in the middle of the last letter
    log.warning("warning");
    log.error("error");
    log.progress("last");
  }
  log.info("nobody hears this");
  return visible(stream.str());
}

void
test_sinks()
{
  std::cout << "terminal:\n" << terminal_output(true, false, 0.) << "|\n";
  std::cout << "terminal, progress at most once an hour:\n"
            << terminal_output(true, false, 3600.) << "|\n";
  std::cout << "terminal, quiet:\n" << terminal_output(true, true, 0.) << "|\n";
  std::cout << "file:\n" << terminal_output(false, false, 0.) << "|" << std::endl;

  // log.txt: as it comes, and also while an exception passes.
  const std::string path = folder + "/log.txt";
  core::Log         log;
  log.info("before");
  try
    {
      report::LogFile file(log, path);
      log.info("two\nlines");
      log.progress("not in a file");
      std::cout << "as it comes: " << std::ifstream(path).ignore(1000, '\n').good() << std::endl;
      log.error("it failed");
      throw std::runtime_error("stop");
    }
  catch (const std::runtime_error &)
    {
    }
  log.info("after");
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);)
    {
      // The time differs; its form does not.
      const bool timed = line.size() > 15 && line[0] == '[' && line.substr(11, 4) == " s] "
                         && std::abs(std::strtod(line.c_str() + 1, nullptr)) < 10.;
      std::cout << (timed ? "[time] " : "       ") << line.substr(15) << std::endl;
    }
}

/** Closed by another thread, and on a disk that is full. */
void
test_log_ends()
{
  core::Log         log;
  const std::string path = folder + "/ended.txt";
  {
    report::LogFile file(log, path);
    log.info("first");
    file.close_with("ended");
    log.info("late");
  }
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);)
    std::cout << line.substr(15) << std::endl;
  const auto expect_error = [&](const auto &action) {
    try
      {
        action();
        std::cout << "no error" << std::endl;
      }
    catch (const std::exception &e)
      {
        std::cout << (dynamic_cast<const core::InputError *>(&e) != nullptr ? "InputError: "
                                                                            : "NumericalError: ")
                  << e.what() << std::endl;
      }
  };
  expect_error([&] { report::LogFile file(log, path); });
  fs::create_symlink("ended.txt", folder + "/link.txt");
  expect_error([&] { report::LogFile file(log, folder + "/link.txt"); });
  log.info("no sink is left");

  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  limit.rlim_cur = 100;
  setrlimit(RLIMIT_FSIZE, &limit);
  report::LogFile file(log, folder + "/full.txt");
  log.info("short");
  file.check();
  log.info(std::string(200, 'x'));
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_FSIZE, &limit);
  expect_error([&] { file.check(); });
  expect_error([&] { file.close(); });
}

/** Uses @p seconds of CPU time, and at least as much wall time. */
void
work(const double seconds)
{
  const std::clock_t start = std::clock();
  while (double(std::clock() - start) / CLOCKS_PER_SEC < seconds)
    ;
}

void
test_timer()
{
  using Clock             = std::chrono::steady_clock;
  const auto       before = Clock::now();
  core::StageTimer timer;
  const auto       after = Clock::now();
  {
    const auto solve = timer.scope("solve");
    work(.02);
    {
      const auto assemble = timer.scope("assemble");
      std::this_thread::sleep_for(std::chrono::milliseconds(60));
    }
    work(.02);
  }
  work(.01);
  for (unsigned int i = 0; i < 2; ++i)
    {
      const auto solve = timer.scope("solve");
    }

  for (const auto &row : timer.rows())
    std::cout << row.stage << ' ' << row.calls << std::endl;
  // Every moment once: the rows sum to what another clock says.
  const auto   end_before = Clock::now();
  const double total      = timer.total_wall();
  const auto   end_after  = Clock::now();
  std::cout << "rows sum to the total: "
            << (total >= std::chrono::duration<double>(end_before - after).count() - 1e-9) << ' '
            << (total <= std::chrono::duration<double>(end_after - before).count() + 1e-9)
            << std::endl;
  std::cout << "nested time counted once: " << (timer.cpu("solve") >= .038) << ' '
            << (timer.cpu("solve") < .3) << ' ' << (timer.wall("assemble") >= .06) << ' '
            << (timer.cpu("assemble") < .03) << ' ' << (timer.cpu("other") >= .009) << std::endl;
  std::cout << "unknown stage: " << timer.wall("mesh") << ' ' << timer.cpu("mesh") << std::endl;

  // A stage that runs is counted until now.
  core::StageTimer running;
  const auto       scope = running.scope("mesh");
  work(.01);
  std::cout << "running: " << (running.cpu("mesh") >= .009) << ' ' << (running.cpu("other") < .009)
            << std::endl;

  std::istringstream table(timer.table());
  unsigned int       n_lines = 0;
  double             share   = 0.;
  for (std::string line; std::getline(table, line); ++n_lines)
    if (n_lines == 0)
      std::cout << line << std::endl;
    else
      {
        std::cout << line.substr(0, line.find_first_of(" \n")) << std::endl;
        share += std::strtod(line.c_str() + line.rfind(' '), nullptr);
      }
  std::cout << "shares sum to 200 %: " << (std::abs(share - 200.) < .25) << std::endl;
}

int
main()
{
  fs::remove_all(folder);
  test_directory();
  test_sinks();
  test_log_ends();
  test_timer();
  fs::remove_all(folder);
}
