// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_comparison_h
#define tetradapt_estimate_comparison_h

#include "tetradapt/compare/difference.h"
#include "tetradapt/compare/excluded_region.h"
#include "tetradapt/compare/reference_sampling.h"

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
   * ask for the same things in the same order.
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
    Comparison(std::shared_ptr<const mesh::NodalField>           displacement,
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
    const mesh::NodalField &
    displacement() const
    {
      return *u_h;
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

  private:
    void
    require_reference() const;

    std::shared_ptr<const mesh::NodalField>           u_h;
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
