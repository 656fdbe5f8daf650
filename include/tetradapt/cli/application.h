// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_cli_application_h
#define tetradapt_cli_application_h

#include <string>
#include <vector>

namespace tetradapt::cli
{
  /**
   * The whole program: reads the command line, and prints or runs what it asks
   * for. MPI is started for runs only, as starting it takes a while.
   * @param argc, argv the arguments of main(), as MPI wants them.
   * @return the exit code: 0 done, 1 numerical failure, 2 bad input; of several
   *         scenes the largest.
   */
  int
  run_application(int argc, char **argv);
} // namespace tetradapt::cli

#endif
