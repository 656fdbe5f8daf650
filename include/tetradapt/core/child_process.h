// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_child_process_h
#define tetradapt_core_child_process_h

#include <string>
#include <vector>

namespace tetradapt::core
{
  /** How a child process ended. */
  struct ChildResult
  {
    std::string output; ///< all that it wrote to its standard output
    std::string errors; ///< the last 4 to 8 kB that it wrote to its standard error
    bool        timed_out = false;
    /** As waitpid() gives it; -1 if a handler of SIGCHLD collected it first. */
    int status = -1;
  };

  /** What to run. */
  struct ChildProgram
  {
    std::string              name; ///< for messages, and what the program sees as its name
    std::string              path;
    std::vector<std::string> arguments;
    /** "NAME=value", added to this process's environment where the name is not set there. */
    std::vector<std::string> environment = {};
  };

  /**
   * Runs @p program, sends it @p input on its standard input
   * and collects what it writes until it closes both output streams; kills it
   * after @p time_limit seconds of wall time.
   *
   * posix_spawn() is used, not fork(), so that this is safe in MPI programs; the
   * child gets default signal handlers and no descriptor but the standard three.
   * A child that dies does not raise SIGPIPE here. No child survives an exception.
   *
   * @throws NumericalError if the child cannot be started.
   */
  ChildResult
  run_child(const ChildProgram &program, const std::string &input, double time_limit);
} // namespace tetradapt::core

#endif
