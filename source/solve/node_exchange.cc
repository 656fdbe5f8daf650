// SPDX-License-Identifier: AGPL-3.0-or-later
#include "node_exchange.h"

#include "messages.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>

namespace tetradapt::solve
{
  namespace
  {
    /** Rows of blocks as a list of numbers: how many blocks, then column and entries of
     * each. */
    template <unsigned int n>
    void
    pack_row(const BlockRows<n, 6> &rows, unsigned int row, std::vector<double> &packed)
    {
      packed.push_back(rows.begin[row + 1] - rows.begin[row]);
      for (std::size_t k = rows.begin[row]; k < rows.begin[row + 1]; ++k)
        {
          packed.push_back(rows.columns[k]);
          packed.insert(packed.end(), rows.blocks[k].begin(), rows.blocks[k].end());
        }
    }

    template <unsigned int n>
    const double *
    unpack_row(const double *packed, BlockRows<n, 6> &rows)
    {
      const std::size_t count = static_cast<std::size_t>(*packed++);
      for (std::size_t k = 0; k < count; ++k)
        {
          rows.columns.push_back(static_cast<unsigned int>(*packed++));
          rows.blocks.emplace_back();
          std::copy(packed, packed + 6 * n, rows.blocks.back().begin());
          packed += 6 * n;
        }
      return packed;
    }
  } // namespace

  LocalTentative<3>
  with_ghosts(const Aggregates                &aggregates,
              const std::vector<NodeModes<3>> &rows,
              unsigned int                     first,
              const Layout                    &layout)
  {
    const std::size_t n_owned = rows.size();
    const std::size_t n_local = n_owned + layout->n_ghost_indices() / 3;
    LocalTentative<3> local{aggregates.of_node, rows};
    for (unsigned int &aggregate : local.aggregates)
      if (aggregate != no_aggregate)
        aggregate += first;
    local.aggregates.resize(n_local, no_aggregate);
    local.rows.resize(n_local);
    if (layout->n_mpi_processes() == 1)
      return local;

    // Numbers travel as values; they are whole, so that doubles hold them exactly.
    mechanics::VectorOf<double> values(layout);
    const auto                  transfer = [&](const auto &get, const auto &set) {
      for (std::size_t node = 0; node < n_owned; ++node)
        for (unsigned int c = 0; c < 3; ++c)
          values.local_element(3 * node + c) = get(node, c);
      values.update_ghost_values();
      for (std::size_t node = n_owned; node < n_local; ++node)
        for (unsigned int c = 0; c < 3; ++c)
          set(node, c, values.local_element(3 * node + c));
      values.zero_out_ghost_values();
    };
    transfer([&](std::size_t node, unsigned int) { return double(local.aggregates[node]); },
             [&](std::size_t node, unsigned int, double value) {
               local.aggregates[node] = static_cast<unsigned int>(value);
             });
    for (unsigned int k = 0; k < 6; ++k)
      transfer([&](std::size_t node, unsigned int c) { return local.rows[node][6 * c + k]; },
               [&](std::size_t node, unsigned int c, double value) {
                 local.rows[node][6 * c + k] = value;
               });
    return local;
  }

  void
  append_ghost_rows(BlockRows<3, 6> &prolongation, const Layout &layout)
  {
    if (layout->n_mpi_processes() == 1)
      return;
    const MPI_Comm                   communicator = layout->get_mpi_communicator();
    constexpr int                    tag          = 4711;
    std::vector<std::vector<double>> to_send(layout->import_targets().size());
    std::vector<MPI_Request>         requests(to_send.size());
    auto                             range = layout->import_indices().begin();
    for (unsigned int i = 0; i < to_send.size(); ++i)
      {
        const auto [rank, n_indices] = layout->import_targets()[i];
        for (unsigned int sent = 0; sent < n_indices; ++range)
          {
            for (unsigned int index = range->first; index < range->second; index += 3)
              pack_row(prolongation, index / 3, to_send[i]);
            sent += range->second - range->first;
          }
        MPI_Isend(to_send[i].data(),
                  static_cast<int>(to_send[i].size()),
                  MPI_DOUBLE,
                  static_cast<int>(rank),
                  tag,
                  communicator,
                  &requests[i]);
      }
    for (const auto &[rank, n_indices] : layout->ghost_targets())
      {
        MPI_Status status;
        int        size = 0;
        MPI_Probe(static_cast<int>(rank), tag, communicator, &status);
        MPI_Get_count(&status, MPI_DOUBLE, &size);
        std::vector<double> received(size);
        MPI_Recv(
          received.data(), size, MPI_DOUBLE, static_cast<int>(rank), tag, communicator, &status);
        const double *packed = received.data();
        for (unsigned int node = 0; node < n_indices / 3; ++node)
          {
            packed = unpack_row(packed, prolongation);
            prolongation.begin.push_back(prolongation.columns.size());
          }
      }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  }

  BlockRows<6, 6>
  sum_over_ranks(const BlockRows<6, 6> &matrix, MPI_Comm communicator)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      return matrix;
    std::vector<double> packed;
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      pack_row(matrix, row, packed);
    std::vector<int>            begin;
    const auto                  all = all_gather_values(packed, communicator, &begin);
    std::vector<const double *> next;
    for (unsigned int rank = 0; rank + 1 < begin.size(); ++rank)
      next.push_back(all.data() + begin[rank]);
    BlockRows<6, 6> sum;
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      {
        const std::size_t first = sum.columns.size();
        for (const double *&position : next)
          {
            BlockRows<6, 6> part;
            position = unpack_row(position, part);
            for (std::size_t k = 0; k < part.columns.size(); ++k)
              {
                const auto found
                  = std::find(sum.columns.begin() + first, sum.columns.end(), part.columns[k]);
                if (found == sum.columns.end())
                  {
                    sum.columns.push_back(part.columns[k]);
                    sum.blocks.push_back(part.blocks[k]);
                  }
                else
                  for (unsigned int i = 0; i < 36; ++i)
                    sum.blocks[found - sum.columns.begin()][i] += part.blocks[k][i];
              }
          }
        sum.begin.push_back(sum.columns.size());
      }
    return sum;
  }

  std::vector<NodeModes<6>>
  gather_modes(const std::vector<NodeModes<6>> &modes, MPI_Comm communicator)
  {
    return all_gather_values(modes, communicator);
  }
} // namespace tetradapt::solve
