// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/on_first_rank.h"

#include "tetradapt/core/failure.h"

#include <algorithm>

namespace tetradapt::core
{
  void
  on_first_rank(MPI_Comm communicator, const std::function<void()> &work)
  {
    int rank = 0;
    if (!is_alone(communicator))
      MPI_Comm_rank(communicator, &rank);
    together(
      communicator, rank == 0 ? work : [] {});
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
