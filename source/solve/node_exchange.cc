// SPDX-License-Identifier: AGPL-3.0-or-later
#include "node_exchange.h"

#include "messages.h"
#include "row_builder.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>

namespace tetradapt::solve
{
  namespace
  {
    constexpr int ghost_rows_tag = 4711, own_rows_tag = 4712;

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

    /** The rows from @p begin to @p end that are not empty, each after its number. */
    std::vector<double>
    pack_rows(const BlockRows<6, 6> &matrix, unsigned int begin, unsigned int end)
    {
      std::size_t size = 0;
      for (unsigned int row = begin; row < end; ++row)
        size += 2 + 37 * (matrix.begin[row + 1] - matrix.begin[row]);
      std::vector<double> packed;
      packed.reserve(size);
      for (unsigned int row = begin; row < end; ++row)
        if (matrix.begin[row] != matrix.begin[row + 1])
          {
            packed.push_back(row);
            pack_row(matrix, row, packed);
          }
      return packed;
    }

    /** What pack_rows() made; taken row by row. */
    struct PackedRows
    {
      const double *next, *end;
    };

    /** Adds a row to the present one of @p builder if it comes next. */
    void
    add_if_next(unsigned int row, PackedRows &packed, RowBuilder<6, 6> &builder)
    {
      if (packed.next == packed.end || static_cast<unsigned int>(*packed.next) != row)
        return;
      const std::size_t count = static_cast<std::size_t>(packed.next[1]);
      packed.next += 2;
      for (std::size_t k = 0; k < count; ++k, packed.next += 37)
        {
          auto &block = builder.block(static_cast<unsigned int>(*packed.next));
          for (unsigned int i = 0; i < 36; ++i)
            block[i] += packed.next[1 + i];
        }
    }

    template <typename T>
    std::vector<T>
    receive(int rank, int tag, MPI_Datatype type, MPI_Comm communicator)
    {
      MPI_Status status;
      int        size = 0;
      MPI_Probe(rank, tag, communicator, &status);
      MPI_Get_count(&status, type, &size);
      std::vector<T> received(size);
      MPI_Recv(received.data(), size, type, rank, tag, communicator, &status);
      return received;
    }
  } // namespace

  std::vector<unsigned int>
  first_numbers(unsigned int own_count, const Layout &layout)
  {
    std::vector<unsigned int> firsts(layout->n_mpi_processes() + 1, 0);
    if (layout->n_mpi_processes() == 1)
      firsts[1] = own_count;
    else
      MPI_Allgather(&own_count,
                    1,
                    MPI_UNSIGNED,
                    firsts.data() + 1,
                    1,
                    MPI_UNSIGNED,
                    layout->get_mpi_communicator());
    std::partial_sum(firsts.begin(), firsts.end(), firsts.begin());
    return firsts;
  }

  template <unsigned int n>
  LocalTentative<n>
  with_ghosts(const Aggregates                &aggregates,
              const std::vector<NodeModes<n>> &rows,
              unsigned int                     first,
              const Layout                    &layout)
  {
    const std::size_t n_owned = rows.size();
    const std::size_t n_local = n_owned + layout->n_ghost_indices() / n;
    LocalTentative<n> local{aggregates.of_node, rows};
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
        for (unsigned int c = 0; c < n; ++c)
          values.local_element(n * node + c) = get(node, c);
      values.update_ghost_values();
      for (std::size_t node = n_owned; node < n_local; ++node)
        for (unsigned int c = 0; c < n; ++c)
          set(node, c, values.local_element(n * node + c));
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

  template <unsigned int n>
  void
  append_ghost_rows(BlockRows<n, 6> &prolongation, const Layout &layout)
  {
    if (layout->n_mpi_processes() == 1)
      return;
    const MPI_Comm                   communicator = layout->get_mpi_communicator();
    std::vector<std::vector<double>> to_send(layout->import_targets().size());
    std::vector<MPI_Request>         requests(to_send.size());
    auto                             range = layout->import_indices().begin();
    for (unsigned int i = 0; i < to_send.size(); ++i)
      {
        const auto [rank, n_indices] = layout->import_targets()[i];
        for (unsigned int sent = 0; sent < n_indices; ++range)
          {
            for (unsigned int index = range->first; index < range->second; index += n)
              pack_row(prolongation, index / n, to_send[i]);
            sent += range->second - range->first;
          }
        MPI_Isend(to_send[i].data(),
                  static_cast<int>(to_send[i].size()),
                  MPI_DOUBLE,
                  static_cast<int>(rank),
                  ghost_rows_tag,
                  communicator,
                  &requests[i]);
      }
    for (const auto &[rank, n_indices] : layout->ghost_targets())
      {
        const auto received
          = receive<double>(static_cast<int>(rank), ghost_rows_tag, MPI_DOUBLE, communicator);
        const double *packed = received.data();
        for (unsigned int node = 0; node < n_indices / n; ++node)
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
    std::vector<int> begin;
    const auto all = all_gather_values(pack_rows(matrix, 0, matrix.n_rows()), communicator, &begin);
    std::vector<PackedRows> parts;
    for (unsigned int rank = 0; rank + 1 < begin.size(); ++rank)
      parts.push_back({all.data() + begin[rank], all.data() + begin[rank + 1]});
    BlockRows<6, 6>  sum;
    RowBuilder<6, 6> builder(sum, matrix.n_rows());
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      {
        for (PackedRows &part : parts)
          add_if_next(row, part, builder);
        builder.end_row();
      }
    return sum;
  }

  BlockRows<6, 6>
  sum_own_rows(const BlockRows<6, 6>           &matrix,
               const std::vector<unsigned int> &firsts,
               MPI_Comm                         communicator)
  {
    const int                        n_ranks = static_cast<int>(firsts.size()) - 1;
    const int                        own = dealii::Utilities::MPI::this_mpi_process(communicator);
    std::vector<int>                 sends(n_ranks, 0), receives(n_ranks, 0);
    std::vector<std::vector<double>> to_send(n_ranks), received;
    std::vector<MPI_Request>         requests;
    for (int rank = 0; rank < n_ranks; ++rank)
      if (rank != own)
        {
          to_send[rank] = pack_rows(matrix, firsts[rank], firsts[rank + 1]);
          sends[rank]   = to_send[rank].empty() ? 0 : 1;
        }
    MPI_Alltoall(sends.data(), 1, MPI_INT, receives.data(), 1, MPI_INT, communicator);
    for (int rank = 0; rank < n_ranks; ++rank)
      if (sends[rank] != 0)
        {
          requests.emplace_back();
          MPI_Isend(to_send[rank].data(),
                    static_cast<int>(to_send[rank].size()),
                    MPI_DOUBLE,
                    rank,
                    own_rows_tag,
                    communicator,
                    &requests.back());
        }
    for (int rank = 0; rank < n_ranks; ++rank)
      if (receives[rank] != 0)
        received.push_back(receive<double>(rank, own_rows_tag, MPI_DOUBLE, communicator));
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);

    std::vector<PackedRows> parts;
    for (const auto &part : received)
      parts.push_back({part.data(), part.data() + part.size()});
    BlockRows<6, 6>  sum;
    RowBuilder<6, 6> builder(sum, matrix.n_rows());
    const auto       n_blocks = matrix.begin[firsts[own + 1]] - matrix.begin[firsts[own]];
    sum.columns.reserve(n_blocks + n_blocks / 8);
    sum.blocks.reserve(n_blocks + n_blocks / 8);
    for (unsigned int row = firsts[own]; row < firsts[own + 1]; ++row)
      {
        for (std::size_t k = matrix.begin[row]; k < matrix.begin[row + 1]; ++k)
          builder.block(matrix.columns[k]) = matrix.blocks[k];
        for (PackedRows &part : parts)
          add_if_next(row, part, builder);
        builder.end_row();
      }
    return sum;
  }

  std::vector<NodeModes<6>>
  gather_modes(const std::vector<NodeModes<6>> &modes, MPI_Comm communicator)
  {
    return all_gather_values(modes, communicator);
  }

  template LocalTentative<3>
  with_ghosts(const Aggregates &, const std::vector<NodeModes<3>> &, unsigned int, const Layout &);
  template LocalTentative<6>
  with_ghosts(const Aggregates &, const std::vector<NodeModes<6>> &, unsigned int, const Layout &);
  template void
  append_ghost_rows(BlockRows<3, 6> &, const Layout &);
  template void
  append_ghost_rows(BlockRows<6, 6> &, const Layout &);
} // namespace tetradapt::solve
