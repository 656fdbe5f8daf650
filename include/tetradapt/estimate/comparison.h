// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_comparison_h
#define tetradapt_estimate_comparison_h

#include "tetradapt/compare/difference.h"
#include "tetradapt/compare/excluded_region.h"
#include "tetradapt/compare/reference_sampling.h"
#include "tetradapt/fem/field.h"

#include <memory>
#include <optional>

namespace tetradapt::estimate
{
  /**
   * Everything that one solution can be compared with, each comparison made when
   * it is first asked for and then kept: the estimator that drives and the table
   * share what both need, and what neither needs is never computed.
   *
   * Whatever may compute is collective over the communicator, so every rank must
   * ask for the same things in the same order. Comparisons work on displacements that every
   * rank holds whole: the copy is made when the first of them asks for it.
   */
  class Comparison
  {
  public:
    /**
     * Keeps references to @p materials and @p exact_solution.
     *
     * @param sampling of the reference, made once a run; null if there is none.
     * @param excluded what every comparison leaves out, the same as in @p sampling.
     */
    Comparison(std::shared_ptr<const fem::Field>                 displacement,
               const mechanics::MaterialMap                     &materials,
               const scene::ExactSolutionParameters             &exact_solution,
               std::shared_ptr<const compare::ReferenceSampling> sampling,
               MPI_Comm                                          communicator,
               compare::ExcludedRegion                           excluded = {});

    bool
    has_reference() const
    {
      return sampling != nullptr;
    }
    bool
    has_exact_displacement() const
    {
      return exact_solution.has_displacement();
    }
    /** The displacement on every rank. */
    const mesh::NodalField &
    displacement();

    const mesh::TetMesh &
    mesh() const
    {
      return *body;
    }
    const std::shared_ptr<const mesh::TetMesh> &
    shared_mesh() const
    {
      return body;
    }
    /** Of the displacement's nodes; null for degree 1. */
    const mesh::EdgeTable *
    edges() const
    {
      return edge_table.get();
    }
    const mechanics::MaterialMap &
    material_map() const
    {
      return materials;
    }
    MPI_Comm
    mpi_communicator() const
    {
      return communicator;
    }
    /** What errors and estimates leave out. */
    const compare::ExcludedRegion &
    excluded_region() const
    {
      return excluded;
    }

    /** Difference to the reference. @throws core::InputError if there is none. */
    const compare::Difference &
    to_reference();

    /** Difference to the exact displacement. @throws core::InputError if the
     * scene gives none. */
    const compare::Difference &
    to_exact_solution();

    /** Nodal relative error norms, against the exact displacement where there is
     * one, else the reference. @throws core::InputError if there is neither. */
    const compare::NodalRen &
    ren();

    /** Nodal relative error norms against the reference, whatever else is known.
     * @throws core::InputError if there is none. */
    const compare::NodalRen &
    ren_to_reference();

    /** Locator in the mesh of the displacement. */
    const compare::PointLocator &
    locator();

    /** Gives up all but displacement(), to save memory; what is asked for later is made again. No
     * longer shares the distributed displacement with its space. */
    void
    reduce_to_displacement();

  private:
    void
    require_reference() const;

    std::shared_ptr<const fem::Field>                 distributed; ///< null once it is given up
    std::shared_ptr<const mesh::NodalField>           replicated;  ///< null: not asked for yet
    std::shared_ptr<const mesh::TetMesh>              body;
    std::shared_ptr<const mesh::EdgeTable>            edge_table;
    const mechanics::MaterialMap                     &materials;
    const scene::ExactSolutionParameters             &exact_solution;
    std::shared_ptr<const compare::ReferenceSampling> sampling;
    MPI_Comm                                          communicator;
    compare::ExcludedRegion                           excluded;

    std::unique_ptr<compare::PointLocator> own_locator;
    std::optional<compare::Difference>     reference_difference, true_difference;
    std::optional<compare::NodalRen>       reference_ren, true_ren;
  };
} // namespace tetradapt::estimate

#endif
