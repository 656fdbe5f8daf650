// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_solve_messages_h
#define tetradapt_source_solve_messages_h

#include "tetradapt/core/exceptions.h"

#include <mpi.h>

#include <limits>
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

  /**
   * How many values each rank has, and where they begin in a list of all, rank by rank.
   * deal.II's functions for lists of different lengths compress what they send; these do not.
   */
  struct Shares
  {
    /** Collective. @throws core::NumericalError for more values than MPI counts. */
    Shares(const std::size_t own, const MPI_Comm communicator)
    {
      int n_ranks = 1;
      MPI_Comm_size(communicator, &n_ranks);
      const unsigned long        mine = own;
      std::vector<unsigned long> all(n_ranks);
      MPI_Allgather(&mine, 1, MPI_UNSIGNED_LONG, all.data(), 1, MPI_UNSIGNED_LONG, communicator);
      unsigned long next = 0;
      for (const unsigned long size : all)
        {
          begins.push_back(static_cast<int>(next));
          next += size;
          if (next > static_cast<unsigned long>(std::numeric_limits<int>::max()))
            throw core::NumericalError("The system has more values than MPI can send at once. Use "
                                       "a coarser mesh.");
          sizes.push_back(static_cast<int>(size));
        }
      begins.push_back(static_cast<int>(next));
    }

    std::vector<int> sizes, begins; ///< the latter has one more entry than there are ranks
  };

  /** The values of all ranks, rank by rank, on the first rank; nothing on the others.
   * Collective. @param shares of the ranks' values. */
  template <typename T>
  std::vector<T>
  gather_values(const std::vector<T> &own, const Shares &shares, const MPI_Comm communicator)
  {
    int rank = 0;
    MPI_Comm_rank(communicator, &rank);
    std::vector<T>       all(rank == 0 ? shares.begins.back() : 0);
    const MessageType<T> message;
    MPI_Gatherv(own.data(),
                shares.sizes[rank],
                message.type,
                all.data(),
                shares.sizes.data(),
                shares.begins.data(),
                message.type,
                0,
                communicator);
    return all;
  }

  /** The values of all ranks, rank by rank, on every rank; of rank r from
   * (*begin)[r] on. Collective. */
  template <typename T>
  std::vector<T>
  all_gather_values(const std::vector<T> &own,
                    MPI_Comm              communicator,
                    std::vector<int>     *begin = nullptr)
  {
    const Shares         shares(own.size(), communicator);
    std::vector<T>       all(shares.begins.back());
    const MessageType<T> message;
    MPI_Allgatherv(own.data(),
                   static_cast<int>(own.size()),
                   message.type,
                   all.data(),
                   shares.sizes.data(),
                   shares.begins.data(),
                   message.type,
                   communicator);
    if (begin != nullptr)
      *begin = shares.begins;
    return all;
  }
} // namespace tetradapt::solve

#endif
