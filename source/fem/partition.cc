// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/fem/partition.h"

#include "tetradapt/mesh/space_curve.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace tetradapt::fem
{
  namespace
  {
    using dealii::Point;
    using Cells = std::vector<unsigned int>::iterator;

    std::vector<Point<3>>
    cell_centroids(const mesh::TetMesh &mesh)
    {
      std::vector<Point<3>> centroids(mesh.n_cells());
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (const unsigned int v : mesh.cells[c])
          centroids[c] += 0.25 * dealii::Tensor<1, 3>(mesh.points[v]);
      return centroids;
    }

    unsigned int
    longest_extent(const std::vector<Point<3>> &centroids, Cells begin, Cells end)
    {
      Point<3> lower = centroids[*begin], upper = lower;
      for (Cells cell = begin; cell != end; ++cell)
        for (unsigned int d = 0; d < 3; ++d)
          {
            lower[d] = std::min(lower[d], centroids[*cell][d]);
            upper[d] = std::max(upper[d], centroids[*cell][d]);
          }
      unsigned int longest = 0;
      for (unsigned int d = 1; d < 3; ++d)
        if (upper[d] - lower[d] > upper[longest] - lower[longest])
          longest = d;
      return longest;
    }

    /** Shares the cells from @p begin to @p end out among @p n_ranks ranks from
     * @p first_rank on. */
    void
    bisect(const std::vector<Point<3>> &centroids,
           Cells                        begin,
           Cells                        end,
           unsigned int                 first_rank,
           unsigned int                 n_ranks,
           std::vector<unsigned int>   &owners)
    {
      if (n_ranks == 1 || begin == end)
        {
          for (Cells cell = begin; cell != end; ++cell)
            owners[*cell] = first_rank;
          return;
        }
      const unsigned int  d     = longest_extent(centroids, begin, end);
      const unsigned int  lower = n_ranks / 2;
      const std::uint64_t share = static_cast<std::uint64_t>(end - begin) * lower / n_ranks;
      const Cells         cut   = begin + share;
      std::nth_element(begin, cut, end, [&](unsigned int i, unsigned int j) {
        return centroids[i][d] != centroids[j][d] ? centroids[i][d] < centroids[j][d] : i < j;
      });
      bisect(centroids, begin, cut, first_rank, lower, owners);
      bisect(centroids, cut, end, first_rank + lower, n_ranks - lower, owners);
    }
  } // namespace

  Partition::Partition(std::shared_ptr<const mesh::TetMesh> mesh_pointer, MPI_Comm communicator)
    : tet_mesh(std::move(mesh_pointer)), mpi_communicator(communicator),
      rank_count(dealii::Utilities::MPI::n_mpi_processes(communicator))
  {
    const auto centroids = cell_centroids(*tet_mesh);
    const auto box       = mesh::bounding_box(*tet_mesh);
    cell_order           = mesh::SpaceCurve(box.first, box.second).order(centroids);
    firsts               = {0, tet_mesh->n_cells()};
    if (rank_count == 1)
      return;
    std::vector<unsigned int> cells = cell_order, owners(cells.size());
    bisect(centroids, cells.begin(), cells.end(), 0, rank_count, owners);
    firsts.assign(rank_count + 1, 0);
    for (const unsigned int owner : owners)
      ++firsts[owner + 1];
    std::partial_sum(firsts.begin(), firsts.end(), firsts.begin());
    auto next = firsts;
    for (const unsigned int cell : cell_order)
      cells[next[owners[cell]]++] = cell;
    cell_order = std::move(cells);
  }
} // namespace tetradapt::fem
