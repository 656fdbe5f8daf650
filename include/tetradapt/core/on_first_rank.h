// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_core_on_first_rank_h
#define tetradapt_core_on_first_rank_h

#include <mpi.h>

#include <functional>
#include <vector>

namespace tetradapt::core
{
  /**
   * Runs @p work on the first rank of @p communicator while the others wait. If it
   * throws, every rank throws: an InputError or NumericalError with the same
   * message, so that no rank is left waiting. Collective.
   */
  void
  on_first_rank(MPI_Comm communicator, const std::function<void()> &work);

  /** Whether the communicator has a single rank. */
  bool
  is_alone(MPI_Comm communicator);

  /** Gives @p bytes of memory at @p data from the first rank to all. Collective. */
  void
  broadcast_bytes(void *data, std::size_t bytes, MPI_Comm communicator);

  /** Gives a vector of plain values from the first rank to all. Collective. */
  template <typename T>
  void
  broadcast(std::vector<T> &values, MPI_Comm communicator)
  {
    static_assert(std::is_trivially_destructible<T>::value, "plain values only");
    std::size_t n = values.size();
    broadcast_bytes(&n, sizeof(n), communicator);
    values.resize(n);
    broadcast_bytes(values.data(), n * sizeof(T), communicator);
  }
} // namespace tetradapt::core

#endif
