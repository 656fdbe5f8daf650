// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_failure_h
#define tetradapt_core_failure_h

#include <mpi.h>

#include <functional>
#include <string>

namespace tetradapt::core
{
  /** What an exception amounts to, as plain data that can be sent to other ranks. */
  struct Failure
  {
    enum Kind : int
    {
      none,
      numerical, ///< a NumericalError, and whatever else is thrown
      input      ///< an InputError, or a file that cannot be used
    };

    Kind        kind = none;
    std::string message;

    /** Throws it as NumericalError or InputError; does nothing where there is none. */
    void
    rethrow() const;
  };

  /** Runs @p work; whatever it throws, also exceptions of deal.II, numbers as Trilinos throws
   * them and std::bad_alloc, becomes a failure. */
  Failure
  attempt(const std::function<void()> &work);

  /**
   * Runs @p work on every rank and lets what it throws on any of them be thrown on all: the
   * failure of the lowest such rank, as InputError or NumericalError. Without this, the other
   * ranks would wait for the one that failed. On a single rank exceptions pass as they are.
   * Collective, while @p work must not be.
   */
  void
  together(MPI_Comm communicator, const std::function<void()> &work);
} // namespace tetradapt::core

#endif
