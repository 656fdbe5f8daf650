// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_solve_messages_h
#define tetradapt_source_solve_messages_h

#include <mpi.h>

#include <numeric>
#include <type_traits>
#include <vector>

namespace tetradapt::solve
{
  /** A type for messages of plain data. */
  template <typename T>
  class MessageType
  {
  public:
    static_assert(std::is_trivially_copyable<T>::value, "Only bytes are sent.");

    MessageType()
    {
      MPI_Type_contiguous(sizeof(T), MPI_BYTE, &type);
      MPI_Type_commit(&type);
    }
    ~MessageType()
    {
      MPI_Type_free(&type);
    }
    MessageType(const MessageType &) = delete;
    MessageType &
    operator=(const MessageType &)
      = delete;

    MPI_Datatype type;
  };

  /** The values of all ranks, rank by rank, on every rank; of rank r from
   * (*begin)[r] on. Collective. (deal.II's functions compress what they send.) */
  template <typename T>
  std::vector<T>
  all_gather_values(const std::vector<T> &own,
                    MPI_Comm              communicator,
                    std::vector<int>     *begin = nullptr)
  {
    int n_ranks = 1;
    MPI_Comm_size(communicator, &n_ranks);
    const int        size = static_cast<int>(own.size());
    std::vector<int> sizes(n_ranks), first(n_ranks + 1, 0);
    MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, communicator);
    std::partial_sum(sizes.begin(), sizes.end(), first.begin() + 1);
    std::vector<T>       all(first.back());
    const MessageType<T> message;
    MPI_Allgatherv(own.data(),
                   size,
                   message.type,
                   all.data(),
                   sizes.data(),
                   first.data(),
                   message.type,
                   communicator);
    if (begin != nullptr)
      *begin = first;
    return all;
  }
} // namespace tetradapt::solve

#endif
