// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_parallel_h
#define tetradapt_compare_parallel_h

#include <mpi.h>

#include <vector>

namespace tetradapt::compare
{
  /** Part of a list of work: from begin to end, without end. */
  struct Slice
  {
    unsigned int begin = 0, end = 0;
  };

  /** This process' number, and how many there are; 0 and 1 before MPI_Init. */
  unsigned int
  this_rank(MPI_Comm communicator);
  unsigned int
  n_ranks(MPI_Comm communicator);

  /** This rank's contiguous share of @p n items; the sizes differ by one at most. */
  Slice
  own_slice(unsigned int n, MPI_Comm communicator);

  /** Sums (or takes the largest) over the ranks, entry by entry. Collective. */
  void
  sum_over_ranks(std::vector<double> &values, MPI_Comm communicator);
  void
  sum_over_ranks(double *values, std::size_t n, MPI_Comm communicator);
  double
  max_over_ranks(double value, MPI_Comm communicator);

  /**
   * Completes a list of @p n items of @p size numbers each, of which each rank
   * has filled its own_slice(). Collective.
   */
  void
  gather_slices(std::vector<double> &values,
                unsigned int         n,
                unsigned int         size,
                MPI_Comm             communicator);
} // namespace tetradapt::compare

#endif
