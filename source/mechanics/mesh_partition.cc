// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/mesh_partition.h"

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace tetradapt::mechanics
{
  namespace
  {
    /** Spreads the lower 21 bits of @p v to every third bit. */
    std::uint64_t
    spread_bits(std::uint64_t v)
    {
      v &= 0x1fffff;
      v = (v | v << 32) & 0x1f00000000ffffULL;
      v = (v | v << 16) & 0x1f0000ff0000ffULL;
      v = (v | v << 8) & 0x100f00f00f00f00fULL;
      v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
      v = (v | v << 2) & 0x1249249249249249ULL;
      return v;
    }

    /** Cell numbers sorted by the Morton code of the centroids. */
    std::vector<unsigned int>
    morton_order(const mesh::TetMesh &mesh)
    {
      const auto box    = mesh::bounding_box(mesh);
      double     extent = 0.;
      for (unsigned int d = 0; d < 3; ++d)
        extent = std::max(extent, box.second[d] - box.first[d]);
      const double scale = extent > 0. ? ((1 << 21) - 1) / (4. * extent) : 0.;

      std::vector<std::pair<std::uint64_t, unsigned int>> keys(mesh.n_cells());
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        {
          std::uint64_t key = 0;
          for (unsigned int d = 0; d < 3; ++d)
            {
              double sum = 0.;
              for (const unsigned int v : mesh.cells[c])
                sum += mesh.points[v][d] - box.first[d];
              key |= spread_bits(static_cast<std::uint64_t>(std::max(0., sum * scale))) << d;
            }
          keys[c] = {key, c};
        }
      std::sort(keys.begin(), keys.end());
      std::vector<unsigned int> order(mesh.n_cells());
      for (unsigned int i = 0; i < order.size(); ++i)
        order[i] = keys[i].second;
      return order;
    }

    void
    build_serial(const mesh::TetMesh             &mesh,
                 const std::vector<unsigned int> &order,
                 dealii::Triangulation<3>        &tria)
    {
      std::vector<dealii::CellData<3>> cells(mesh.n_cells(), dealii::CellData<3>(4));
      for (unsigned int i = 0; i < cells.size(); ++i)
        {
          const auto &vertices = mesh.cells[order[i]];
          std::copy(vertices.begin(), vertices.end(), cells[i].vertices.begin());
        }
      tria.create_triangulation(mesh.points, cells, dealii::SubCellData());
    }
  } // namespace

  MeshPartition::MeshPartition(const mesh::TetMesh &mesh, MPI_Comm communicator)
    : tet_mesh(mesh), mpi_communicator(communicator), cell_order(morton_order(mesh))
  {
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    if (n_ranks == 1)
      {
        tria = std::make_unique<dealii::Triangulation<3>>();
        build_serial(mesh, cell_order, *tria);
        return;
      }
    auto distributed
      = std::make_unique<dealii::parallel::fullydistributed::Triangulation<3>>(communicator);
    const auto description = dealii::TriangulationDescription::Utilities::
      create_description_from_triangulation_in_groups<3, 3>(
        [&](dealii::Triangulation<3> &serial) { build_serial(mesh, cell_order, serial); },
        [n_ranks](dealii::Triangulation<3> &serial, const MPI_Comm, const unsigned int) {
          dealii::GridTools::partition_triangulation(n_ranks, serial);
        },
        communicator,
        n_ranks);
    distributed->create_triangulation(description);
    tria = std::move(distributed);
  }

  unsigned int
  MeshPartition::mesh_cell(const dealii::Triangulation<3>::active_cell_iterator &cell) const
  {
    return cell_order[cell->id().get_coarse_cell_id()];
  }
} // namespace tetradapt::mechanics
