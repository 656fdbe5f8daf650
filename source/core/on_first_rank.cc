// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/on_first_rank.h"

#include "tetradapt/core/exceptions.h"

#include <algorithm>
#include <filesystem>
#include <string>

namespace tetradapt::core
{
  namespace
  {
    enum Outcome : int
    {
      success,
      input_error,
      numerical_error
    };

    /** Runs the work and catches what it throws. */
    Outcome
    attempt(const std::function<void()> &work, std::string &message)
    {
      try
        {
          work();
          return success;
        }
      catch (const InputError &error)
        {
          message = error.what();
          return input_error;
        }
      catch (const std::filesystem::filesystem_error &error)
        {
          // As where there is one rank only.
          message = "'" + error.path1().string() + "': " + error.code().message() + ".";
          return error.code() == std::errc::no_space_on_device ? numerical_error : input_error;
        }
      catch (const std::bad_alloc &)
        {
          message = "There is not enough memory.";
          return numerical_error;
        }
      catch (const std::exception &error)
        {
          message = error.what();
          return numerical_error;
        }
    }
  } // namespace

  void
  on_first_rank(MPI_Comm communicator, const std::function<void()> &work)
  {
    if (is_alone(communicator))
      {
        work();
        return;
      }
    int rank = 0;
    MPI_Comm_rank(communicator, &rank);
    std::string message;
    int         outcome = rank == 0 ? attempt(work, message) : success;
    broadcast_bytes(&outcome, sizeof(outcome), communicator);
    if (outcome == success)
      return;
    std::vector<char> text(message.begin(), message.end());
    broadcast(text, communicator);
    message.assign(text.begin(), text.end());
    if (outcome == input_error)
      throw InputError(message);
    throw NumericalError(message);
  }

  bool
  is_alone(MPI_Comm communicator)
  {
    int initialized = 0;
    MPI_Initialized(&initialized);
    if (initialized == 0)
      return true;
    int n_ranks = 1;
    MPI_Comm_size(communicator, &n_ranks);
    return n_ranks == 1;
  }

  void
  broadcast_bytes(void *data, std::size_t bytes, MPI_Comm communicator)
  {
    if (is_alone(communicator))
      return;
    // MPI counts with int.
    constexpr std::size_t largest = 1u << 30;
    for (std::size_t begin = 0; begin < bytes; begin += largest)
      MPI_Bcast(static_cast<char *>(data) + begin,
                static_cast<int>(std::min(largest, bytes - begin)),
                MPI_BYTE,
                0,
                communicator);
  }
} // namespace tetradapt::core
