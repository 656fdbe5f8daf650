// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_fem_triangulation_h
#define tetradapt_fem_triangulation_h

#include "tetradapt/fem/partition.h"

#include <deal.II/distributed/tria_base.h>

namespace tetradapt::fem
{
  /**
   * deal.II's triangulation of a tetrahedral mesh, distributed over the MPI ranks.
   *
   * A rank has the cells that the partition gives it and, as ghosts, all cells that share a
   * point with these, in the order of the partition: along a curve through space, which makes
   * the unknowns of neighbours lie close together in memory. A rank without cells has one
   * artificial cell. The mesh's regions are material ids. Patch p of the mesh is boundary id
   * p + 1; boundary id 0, which deal.II gives to outer faces of ghost cells that are not on the
   * mesh's boundary, is left to these.
   *
   * Derived from the base class of deal.II's own distributed triangulations, since
   * parallel::fullydistributed::Triangulation is made from a description of the mesh, which
   * takes about twice the time. The mesh is neither refined nor written by
   * deal.II: TetGen makes the next one.
   */
  class Triangulation : public dealii::parallel::DistributedTriangulationBase<3>
  {
  public:
    /** Collective. Every rank passes the same mesh, which is shared. */
    Triangulation(std::shared_ptr<const mesh::TetMesh> mesh, MPI_Comm communicator);

    const Partition &
    partition() const
    {
      return cell_partition;
    }
    const mesh::TetMesh &
    tet_mesh() const
    {
      return cell_partition.mesh();
    }
    const std::shared_ptr<const mesh::TetMesh> &
    shared_mesh() const
    {
      return cell_partition.shared_mesh();
    }
    /** The number in the mesh of the cell with this index(). */
    unsigned int
    mesh_cell(const unsigned int index) const
    {
      return cell_partition.order()[positions[index]];
    }

    /** False: there is one level only. */
    bool
    is_multilevel_hierarchy_constructed() const override;

    /** @throws dealii::ExcNotImplemented: a mesh is kept by the mesh's writers. */
    void
    save(const std::string &file) const override;
    /** @throws dealii::ExcNotImplemented, as save(). */
    void
    load(const std::string &file) override;
#if !DEAL_II_VERSION_GTE(9, 7, 0)
    /** @throws dealii::ExcNotImplemented, as save(). */
    void
    load(const std::string &file, bool partition_again) override;
#endif
#if !DEAL_II_VERSION_GTE(9, 6, 0)
    /** Nothing to do: cells do not move between ranks. */
    void
    update_cell_relations() override;
#endif

    /** The position of a local cell in the partition's order is its id on all ranks. */
    dealii::types::coarse_cell_id
    coarse_cell_index_to_coarse_cell_id(unsigned int index) const override;
    /** numbers::invalid_unsigned_int for a cell that is not on this rank. */
    unsigned int
    coarse_cell_id_to_coarse_cell_index(dealii::types::coarse_cell_id id) const override;

  private:
    /** Finds the cells of this rank and their ghosts. */
    void
    choose_cells();
    void
    create();
    void
    set_boundary_ids();

    Partition                 cell_partition;
    std::vector<unsigned int> positions; ///< of local cells in the partition's order, ascending
  };
} // namespace tetradapt::fem

#endif
