// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Nothing is lost: runs that are interrupted, that fail or that cannot write leave what was
// there and what they have finished, and say so.

#include "program.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <thread>

using namespace program;

namespace
{
  const std::string start = loaded_block("0; 1; -2") + "subsection Output\n set Plots = no\nend\n",
                    mesh  = bricks_section("3x2x2");

  /** The program in a process of its own. */
  pid_t
  launch(const std::vector<std::string> &arguments)
  {
    const pid_t child = fork();
    if (child == 0)
      {
        const int file = open("err.txt", O_WRONLY | O_CREAT | O_TRUNC, 0666);
        dup2(file, 2);
        dup2(file, 1);
        std::vector<char *> names;
        for (const std::string &argument : arguments)
          names.push_back(const_cast<char *>(argument.c_str()));
        names.push_back(nullptr);
        execvp(names[0], names.data());
        _exit(127);
      }
    return child;
  }

  /** Waits until @p holds, at most half a minute. */
  template <typename Condition>
  bool
  wait_for(const Condition &holds)
  {
    for (unsigned int i = 0; i < 3000; ++i)
      {
        if (holds())
          return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
    return false;
  }

  /** The exit code, or 1000 + the signal that killed it. */
  int
  code_of(const pid_t child)
  {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }

  unsigned int
  n_temporaries(const std::string &folder)
  {
    unsigned int n = 0;
    if (!fs::exists(folder))
      return 1000;
    for (const auto &entry : fs::recursive_directory_iterator(folder))
      n += entry.path().extension() == ".tmp";
    return n;
  }

  std::string
  last_line(const std::string &text)
  {
    const auto end = text.find_last_not_of('\n') + 1;
    return text.substr(0, end).substr(text.rfind('\n', end - 1) + 1);
  }

  /** A run that would go on for minutes: many cycles of its own, short ones. */
  void
  write_long()
  {
    write("long.prm",
          start + mesh
            + "subsection Adaptivity\n set Strategy = adaptive\n set Refinement indicator = spr\n "
              "set Maximum cycles = 400\n set "
              "Maximum tetrahedra = 100000000\n set Safeguard = no\nend\n");
  }

  void
  signals()
  {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
      {
        fresh("out");
        const pid_t child = launch({binary(), "--output-directory", "out", "long.prm"});
        const bool  ready = wait_for([] { return Table("out").n_rows() >= 2; });
        check("two cycles are there", ready);
        check("the log is written as the run goes",
              contains(read("out/log.txt"), "Cycle 0")
                && contains(read("out/log.txt"), "long.prm"));
        kill(child, signal);
        const auto begin = std::chrono::steady_clock::now();
        std::cout << "exit code " << code_of(child) << std::endl;
        check("  at once", std::chrono::steady_clock::now() - begin < std::chrono::seconds(2));
        const std::string end = last_line(read("out/log.txt"));
        check("  the log has its end",
              contains(end, "Error: Ended by SIG") && contains(end, " cycles. "));
        check("  the terminal, too", contains(last_line(read("err.txt")), "Error: Ended by SIG"));
        const unsigned int n = Table("out").n_rows();
        check("  finished cycles stay",
              n >= 2 && fs::exists("out/cycle_00" + std::to_string((n - 1) % 10) + ".vtu")
                && fs::exists("out/long.pvd"));
        check("  nothing is half", n_temporaries("out") == 0);
        check("  no lock", !fs::exists("out/.tetradapt-lock"));
      }
    const int ignoring = code_of(launch({"sh",
                                         "-c",
                                         "trap '' INT; '" + binary()
                                           + "' --quiet --output-directory ign bar.prm & "
                                             "kill -INT $!; wait $!"}));
    std::cout << "what is ignored stays so: " << ignoring << std::endl;
  }

  /** Before the first cycle, while TetGen works: earlier results stay. */
  void
  while_tetgen_works()
  {
    fresh("out");
    run("--quiet --output-directory out bar.prm");
    const std::string before = read("out/convergence.csv");
    write("tetgen.prm",
          start
            + "subsection Mesh\n set Type = box\n set Cells = 1x1x1\n set Volume bound = 1e-7\n"
              "end\n");
    write("worker",
          "#!/bin/sh\necho $$ > worker.pid\nexec '"
            + std::string(std::getenv("TETRADAPT_TETGEN_WORKER")) + "'\n");
    fs::permissions("worker", fs::perms::owner_all);
    fs::remove("worker.pid");
    setenv("TETRADAPT_TETGEN_WORKER", "./worker", 1);
    const auto worker = [] { return std::atoi(read("worker.pid").c_str()); };
    for (const int signal : {SIGTERM, SIGKILL})
      {
        fs::remove("worker.pid");
        const pid_t child = launch({binary(), "--output-directory", "out", "tetgen.prm"});
        wait_for([&] { return worker() > 0; });
        kill(child, signal);
        std::cout << "while TetGen works: " << code_of(child) << std::endl;
        const pid_t other = worker();
        check("  TetGen has ended", wait_for([&] { return kill(other, 0) != 0; }));
        check("  the old results stay",
              before == read("out/convergence.csv") && fs::exists("out/cycle_000.vtu")
                && contains(read("out/log.txt"), "bar.prm"));
      }
    check("the log of the first has a name",
          contains(last_line(read("out/log_failed.txt")), "after 0 cycles"));
    check("what was killed left its log",
          contains(read("out/log_new.txt"), "tetgen.prm") && fs::exists("out/.tetradapt-lock"));
    // A terminal's Ctrl-C is for the whole group.
    fs::remove("worker.pid");
    const pid_t group = launch(
      {"setsid", "sh", "-c", "exec '" + binary() + "' --quiet --output-directory out tetgen.prm"});
    wait_for([&] { return worker() > 0; });
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    kill(-group, SIGINT);
    std::cout << "the whole group: " << code_of(group) << ", "
              << contains(read("err.txt"), "Ended by SIGINT") << std::endl;
    unsetenv("TETRADAPT_TETGEN_WORKER");
    std::cout << "a run after all that: " << run("--quiet --output-directory out bar.prm").code
              << ' ' << files("out") << std::endl;
  }

  void
  with_ranks()
  {
    fresh("out");
    const pid_t child
      = launch({"mpirun", "-np", "2", binary(), "--output-directory", "out", "long.prm"});
    wait_for([] { return Table("out").n_rows() >= 1; });
    kill(child, SIGTERM);
    const int code = code_of(child);
    check("mpirun fails", code != 0);
    check("  the log has its end", contains(last_line(read("out/log.txt")), "Ended by SIGTERM"));
    check("  nothing is half", n_temporaries("out") == 0);
  }

  void
  failing_runs()
  {
    fresh("out");
    run("--quiet --output-directory out bar.prm");
    const std::string before = read("out/convergence.csv");
    const auto        wrong  = run("--output-directory out --set Loads/l/Groups=nix bar.prm");
    std::cout << "a group that is not there: " << wrong.code << ' ' << files("out") << std::endl;
    check("  the old results stay",
          before == read("out/convergence.csv") && contains(wrong.err, "are kept"));
    check("  the log tells", contains(read("out/log_failed.txt"), "nix"));
    const auto solver = run(
      "--quiet --output-directory out --set Solver/Type=cg --set 'Solver/Maximum iterations=1' "
      "--set Mesh/Cells=8x8x8 bar.prm");
    check("a solver that fails, too",
          solver.code == 1 && before == read("out/convergence.csv")
            && contains(read("out/log_failed.txt"), "converge"));
    std::cout << "done: "
              << run("--quiet --output-directory out --set 'Loads/l/Value=0; 0; 1' bar.prm").code
              << ' ' << files("out") << std::endl;
    check("  other results", before != read("out/convergence.csv"));

    // Files of somebody else.
    fresh("mine");
    fs::create_directory("mine");
    write("mine/convergence.csv", "mine");
    const auto foreign = run("--quiet --output-directory mine bar.prm");
    std::cout << "not the program's: " << foreign.code << ' ' << foreign.err << files("mine") << ' '
              << read("mine/convergence.csv") << std::endl;
    fs::remove("mine/convergence.csv");
    write("victim", "mine");
    fs::create_symlink("../victim", "mine/parameters.prm");
    std::cout << "through a link: " << run("--quiet --output-directory mine bar.prm").code << ' '
              << read("victim") << std::endl;

    // Two at a time.
    const pid_t child = launch({binary(), "--output-directory", "long", "long.prm"});
    wait_for([] { return Table("long").n_rows() >= 1; });
    const auto second = run("--quiet --output-directory long bar.prm");
    check("another run in the folder",
          second.code == 2
            && contains(second.err, "Another run (process " + std::to_string(child)));
    kill(child, SIGKILL);
    code_of(child);
    std::cout << "when that was killed: " << run("--quiet --output-directory long bar.prm").code
              << ' ' << files("long") << std::endl;
    write("..prm", start + mesh);
    write("...prm", start + mesh);
    for (const std::string name : {"..prm", "...prm"})
      {
        const auto dots = run("--quiet " + name);
        std::cout << name << ": " << dots.code << ' ' << dots.err;
      }
  }

  /** What @p command in a shell ends with; $P is the program. */
  void
  shell(const std::string &what, const std::string &command)
  {
    const std::string text = "P='" + binary() + "'; " + command;
    const int         code = code_of(launch({"bash", "-c", text}));
    std::string       said = read("err.txt");
    said                   = said.substr(0, said.find(" With"));
    std::cout << what << ": " << code << ' ' << last_line(portable(said)) << std::endl;
  }

  void
  failing_writes()
  {
    const std::string run_it = "$P --output-directory out bar.prm ";
    fresh("out");
    shell("standard output is full", run_it + ">/dev/full");
    shell("the results are whole", "ls out | tr '\\n' ' '");
    shell("standard output is closed", run_it + ">&-");
    shell("nobody reads it", run_it + "2>err2.txt | true; echo ${PIPESTATUS[0]}");
    shell("quiet, nobody reads it",
          "$P --quiet --output-directory out bar.prm | true; echo "
          "${PIPESTATUS[0]}");
    shell("all three are closed",
          "$P --quiet --output-directory out bar.prm <&- >&- 2>&-; echo $?; head -c 4 "
          "out/convergence.csv");
    shell("help to a full disk", "$P --help >/dev/full");
    shell("help to a closed pipe",
          "(sleep 0.5; $P --print-parameters=json 2>err2.txt; echo $? >code.txt) | true; "
          "cat code.txt");
    // The limit is not for what shows the messages.
    shell("files may have 2 KiB",
          "(ulimit -f 2; " + run_it + "2>&1; exit $?) | cat; exit ${PIPESTATUS[0]}");
    shell("files may have 0 KiB",
          "(ulimit -f 0; " + run_it + "2>&1; exit $?) | cat; exit ${PIPESTATUS[0]}");
  }
} // namespace

int
main()
{
  write("bar.prm", start + mesh);
  write_long();
  failing_runs();
  failing_writes();
  signals();
  while_tetgen_works();
  with_ranks();
}
