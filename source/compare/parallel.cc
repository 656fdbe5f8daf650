// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/parallel.h"

#include <algorithm>
#include <cstdint>

namespace tetradapt::compare
{
  namespace
  {
    /** MPI counts are ints: longer lists are sent in parts of this length. */
    constexpr std::size_t longest_message = std::size_t(1) << 28;

    bool
    mpi_runs()
    {
      int initialized = 0, finalized = 0;
      MPI_Initialized(&initialized);
      MPI_Finalized(&finalized);
      return initialized != 0 && finalized == 0;
    }
  } // namespace

  unsigned int
  this_rank(MPI_Comm communicator)
  {
    int rank = 0;
    if (mpi_runs())
      MPI_Comm_rank(communicator, &rank);
    return rank;
  }

  unsigned int
  n_ranks(MPI_Comm communicator)
  {
    int n = 1;
    if (mpi_runs())
      MPI_Comm_size(communicator, &n);
    return n;
  }

  namespace
  {
    Slice
    slice_of(const unsigned int n, const unsigned int rank, const unsigned int ranks)
    {
      return {static_cast<unsigned int>(std::uint64_t(n) * rank / ranks),
              static_cast<unsigned int>(std::uint64_t(n) * (rank + 1) / ranks)};
    }
  } // namespace

  Slice
  own_slice(const unsigned int n, MPI_Comm communicator)
  {
    return slice_of(n, this_rank(communicator), n_ranks(communicator));
  }

  void
  sum_over_ranks(std::vector<double> &values, MPI_Comm communicator)
  {
    sum_over_ranks(values.data(), values.size(), communicator);
  }

  void
  sum_over_ranks(double *values, const std::size_t n, MPI_Comm communicator)
  {
    if (n_ranks(communicator) == 1)
      return;
    for (std::size_t i = 0; i < n; i += longest_message)
      MPI_Allreduce(MPI_IN_PLACE,
                    values + i,
                    static_cast<int>(std::min(longest_message, n - i)),
                    MPI_DOUBLE,
                    MPI_SUM,
                    communicator);
  }

  double
  max_over_ranks(double value, MPI_Comm communicator)
  {
    if (n_ranks(communicator) > 1)
      MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, communicator);
    return value;
  }

  void
  gather_slices(std::vector<double> &values,
                const unsigned int   n,
                const unsigned int   size,
                MPI_Comm             communicator)
  {
    const unsigned int ranks = n_ranks(communicator);
    if (ranks == 1)
      return;
    // One item is one element of the message, so that counts stay small.
    MPI_Datatype item;
    MPI_Type_contiguous(static_cast<int>(size), MPI_DOUBLE, &item);
    MPI_Type_commit(&item);
    std::vector<int> counts(ranks), starts(ranks);
    for (unsigned int r = 0; r < ranks; ++r)
      {
        const Slice slice = slice_of(n, r, ranks);
        counts[r]         = static_cast<int>(slice.end - slice.begin);
        starts[r]         = static_cast<int>(slice.begin);
      }
    MPI_Allgatherv(MPI_IN_PLACE,
                   0,
                   MPI_DATATYPE_NULL,
                   values.data(),
                   counts.data(),
                   starts.data(),
                   item,
                   communicator);
    MPI_Type_free(&item);
  }
} // namespace tetradapt::compare
