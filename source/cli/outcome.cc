// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/cli/outcome.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/printable.h"

#include <deal.II/base/exceptions.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <new>
#include <sstream>
#include <thread>

namespace tetradapt::cli
{
  void
  print_error(const std::string &message)
  {
    std::cerr << "Error: " + core::printable(message) + "\n" << std::flush;
  }

  namespace
  {
    /** The sentence of a deal.II exception, without its frame and stack. */
    std::string
    text_of(const dealii::ExceptionBase &error)
    {
      std::ostringstream info;
      error.print_info(info);
      std::istringstream words(info.str());
      std::string        text, word;
      while (words >> word)
        text += (text.empty() ? "" : " ") + word;
      return std::string(error.get_exc_name()) + (text.empty() ? "" : ": " + text);
    }
  } // namespace

  Outcome
  attempt(const std::function<void()> &action)
  {
    const int failure = Outcome::numerical_failure;
    try
      {
        action();
        return {};
      }
    catch (const core::InputError &error)
      {
        return {Outcome::bad_input, error.what()};
      }
    catch (const core::NumericalError &error)
      {
        return {failure, error.what()};
      }
    catch (const std::filesystem::filesystem_error &error)
      {
        // Names that are too long, links in a circle, folders that may not be read.
        const bool is_trouble = error.code() == std::errc::no_space_on_device
                                || error.code() == std::errc::io_error
                                || error.code() == std::errc::too_many_files_open;
        return {is_trouble ? failure : Outcome::bad_input,
                "'" + error.path1().string() + "': " + error.code().message() + "."};
      }
    catch (const std::bad_alloc &)
      {
        return {failure,
                "there is not enough memory. Use a smaller mesh: see Mesh, Reference and "
                "Adaptivity/Maximum tetrahedra."};
      }
    catch (const dealii::ExceptionBase &error)
      {
        return {failure, "unexpected failure in deal.II: " + text_of(error)};
      }
    catch (const std::exception &error)
      {
        return {failure, std::string("unexpected failure: ") + error.what()};
      }
    catch (const int number) // as Trilinos throws them
      {
        return {failure, "unexpected failure, number " + std::to_string(number)};
      }
    catch (...)
      {
        return {failure, "unexpected failure of an unknown kind"};
      }
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
