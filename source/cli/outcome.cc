// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/cli/outcome.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/failure.h"
#include "tetradapt/core/printable.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <iostream>
#include <thread>
#include <utility>

namespace tetradapt::cli
{
  void
  print_error(const std::string &message)
  {
    std::cerr << "Error: " + core::printable(message) + "\n" << std::flush;
  }

  Outcome
  attempt(const std::function<void()> &action)
  {
    core::Failure failure = core::attempt(action);
    return {failure.kind == core::Failure::none    ? Outcome::done
            : failure.kind == core::Failure::input ? Outcome::bad_input
                                                   : Outcome::numerical_failure,
            std::move(failure.message)};
  }

  void
  require_written(std::ostream &stream)
  {
    stream.flush();
    if (stream)
      return;
    // The stream has forgotten the reason: trying again tells it.
    stream.clear();
    errno = 0;
    stream.put('\n').flush();
    const int reason = errno;
    stream.setstate(std::ios::badbit);
    throw core::NumericalError(
      "Cannot write to the standard output"
      + (reason == 0 ? "." : std::string(": ") + std::strerror(reason) + ".")
      + " With --quiet nothing is written there.");
  }

  int
  conclude(const Outcome &outcome, MPI_Comm communicator, const double patience)
  {
    int rank, n_ranks;
    MPI_Comm_rank(communicator, &rank);
    MPI_Comm_size(communicator, &n_ranks);
    if (n_ranks == 1)
      {
        if (outcome.code != Outcome::done)
          print_error(outcome.message);
        return outcome.code;
      }

    // The second number is largest for the first rank that failed.
    std::array<int, 2> mine{{outcome.code, outcome.code == Outcome::done ? 0 : n_ranks - rank}};
    std::array<int, 2> all{{0, 0}};
    MPI_Request        request;
    MPI_Iallreduce(mine.data(), all.data(), 2, MPI_INT, MPI_MAX, communicator, &request);
    if (outcome.code == Outcome::done)
      MPI_Wait(&request, MPI_STATUS_IGNORE);
    else
      {
        // Ranks lose patience one after the other, so that only one prints.
        const auto end
          = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience + 0.5 * rank);
        int arrived = 0;
        MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
        while (!arrived && std::chrono::steady_clock::now() < end)
          {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
          }
        if (!arrived)
          {
            print_error(outcome.message + " (on rank " + std::to_string(rank) + " of "
                        + std::to_string(n_ranks) + " only; all are ended)");
            MPI_Abort(MPI_COMM_WORLD, outcome.code);
          }
      }
    if (all[1] > 0 && all[1] == n_ranks - rank)
      print_error(outcome.message);
    return all[0];
  }
} // namespace tetradapt::cli
