// SPDX-License-Identifier: AGPL-3.0-or-later
// The output directory, the log's sinks and the stage timer.

#include "tetradapt/report/output_directory.h"

#include "tetradapt/core/atomic_file.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/stage_timer.h"
#include "tetradapt/report/log_sinks.h"

#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
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
  for (const auto &entry : fs::directory_iterator(folder + "/run"))
    names.insert(entry.path().filename().string());
  std::cout << what << ':';
  for (const std::string &name : names)
    std::cout << ' ' << name;
  std::cout << std::endl;
}

void
test_directory()
{
  scene::Scene scene;
  scene.name = "beam";
  scene.file = "prm/beam.prm";
  std::cout << "default: " << report::OutputDirectory::path_of(scene) << std::endl;
  scene.output.directory = folder + "/run";

  const report::OutputDirectory first(scene);
  print_files("new");

  // Removed: what a run of this scene writes. Kept: everything else.
  for (const std::string name : {"cycle_000.vtu",
                                 "cycle_1234.vtu",
                                 "beam.pvd",
                                 "convergence.csv",
                                 "convergence.txt",
                                 "results.csv",
                                 "study.txt",
                                 "mesh.csv",
                                 "size_field.vtu",
                                 "log.txt",
                                 ".log.txt.4321.0.tmp",
                                 ".cycle_007.vtu.4321.12.tmp",
                                 "parameters.prm",
                                 "cycle_.vtu",
                                 "cycle_00a.vtu",
                                 "cycle_000.vtu.bak",
                                 "my_cycle_000.vtu",
                                 "plate.pvd",
                                 ".notes.txt.4321.0.tmp",
                                 ".log.txt.tmp",
                                 "notes.txt"})
    core::write_file(first.file(name), "old");
  fs::create_directory(first.file("plots"));
  for (const std::string name : {"ren.svg", "ren.gp", "mine.svg"})
    core::write_file(first.file("plots/" + name), "old");
  fs::create_directory(first.file("cycle_001.vtu"));
  const report::OutputDirectory second(scene);
  print_files("cleared");
  std::cout << "plots: ren " << fs::exists(first.file("plots/ren.svg"))
            << fs::exists(first.file("plots/ren.gp")) << ", mine "
            << fs::exists(first.file("plots/mine.svg")) << std::endl;

  second.write_parameters("set Degree = 2\n");
  core::write_file(second.file("convergence.csv"), "");
  std::cout << second.files_to_look_at() << std::endl;

  const auto expect_error = [&] {
    try
      {
        const report::OutputDirectory directory(scene);
        std::cout << "no error" << std::endl;
      }
    catch (const core::InputError &e)
      {
        std::cout << e.what() << std::endl;
      }
  };
  // Results that the scene itself reads are not thrown away.
  core::write_file(second.file("cycle_002.vtu"), "");
  scene.reference.type = scene::ReferenceParameters::Type::run;
  scene.reference.file = folder + "/./run/cycle_002.vtu";
  expect_error();
  scene.reference.type = scene::ReferenceParameters::Type::none;
  scene.mesh.source    = scene::MeshSource::file;
  scene.mesh.files     = {folder + "/run/cycle_002.vtu"};
  expect_error();
  std::cout << "kept: " << fs::exists(second.file("cycle_002.vtu")) << std::endl;
  scene.mesh.files.clear();

  scene.output.directory = folder + "/run/notes.txt";
  expect_error();
  scene.output.directory = folder + "/run/notes.txt/below";
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

  // log.txt: while an exception passes, and only when it is over.
  const std::string path = folder + "/log.txt";
  core::Log         log;
  log.info("before");
  try
    {
      report::LogFile file(log, path);
      log.info("two\nlines");
      log.progress("not in a file");
      std::cout << "appears early: " << fs::exists(path) << std::endl;
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
  test_timer();
  fs::remove_all(folder);
}
