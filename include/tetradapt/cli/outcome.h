// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_cli_outcome_h
#define tetradapt_cli_outcome_h

#include <mpi.h>

#include <functional>
#include <iosfwd>
#include <string>

namespace tetradapt::cli
{
  /** How something ended: the program's exit code for it, and why. */
  struct Outcome
  {
    static constexpr int done = 0, numerical_failure = 1, bad_input = 2;

    int         code = done;
    std::string message;
  };

  /** Calls @p action; whatever it throws becomes an outcome. InputError is bad
   * input; every other exception, also of libraries and for want of memory, is a
   * numerical failure. */
  Outcome
  attempt(const std::function<void()> &action);

  /** Prints @p message as "Error: ..." to stderr, made printable. */
  void
  print_error(const std::string &message);

  /** @throws core::NumericalError if something could not be written to @p stream, which is
   * the standard output: it is closed, or a file on a full disk. */
  void
  require_written(std::ostream &stream);

  /**
   * Makes all ranks agree on how a collective action ended, and prints the error
   * of the first rank that has one as "Error: ..." to stderr. Collective.
   *
   * A rank that failed alone leaves the others waiting in some collective call;
   * if they do not come here within @p patience seconds, its error is printed and
   * all ranks are ended by MPI_Abort with the code.
   * @return the largest code.
   */
  int
  conclude(const Outcome &outcome, MPI_Comm communicator, double patience = 10.);
} // namespace tetradapt::cli

#endif
