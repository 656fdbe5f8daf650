// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/mesh_partition.h"

#include "tetradapt/mesh/space_curve.h"

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>

#include <algorithm>

namespace tetradapt::mechanics
{
  namespace
  {
    /** Cell numbers sorted by their centroids along a curve through space. */
    std::vector<unsigned int>
    order_in_space(const mesh::TetMesh &mesh)
    {
      std::vector<dealii::Point<3>> centroids(mesh.n_cells());
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (const unsigned int v : mesh.cells[c])
          centroids[c] += 0.25 * dealii::Tensor<1, 3>(mesh.points[v]);
      const auto box = mesh::bounding_box(mesh);
      return mesh::SpaceCurve(box.first, box.second).order(centroids);
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
    : tet_mesh(mesh), mpi_communicator(communicator), cell_order(order_in_space(mesh))
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
