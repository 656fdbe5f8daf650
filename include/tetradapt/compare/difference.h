// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_difference_h
#define tetradapt_compare_difference_h

#include "tetradapt/compare/reference_sampling.h"
#include "tetradapt/scene/model_parameters.h"

namespace tetradapt::compare
{
  /** Norms of u_h minus a better solution u. Energies are int eps:C:eps; that of u itself is
   * of the strain without what temperatures cause, see mechanics::EnergyNorm. */
  struct Difference
  {
    double              l2 = 0., h1 = 0., energy = 0.; ///< norms of u - u_h; h1: seminorm |grad|
    double              l2_norm = 0., h1_norm = 0., energy_norm = 0.; ///< the same norms of u
    double              energy_noise = 0.;                            ///< EnergyNorm::noise of u
    std::vector<double> cell_energy; ///< energy norm of the difference, one a cell of u_h's mesh
    double              largest_distance = 0.; ///< farthest quadrature point outside u_h's mesh
    /** Cells of u_h's mesh without any quadrature point of the reference's: where
     * the reference is not finer than u_h. */
    unsigned int n_unsampled_cells = 0;
  };

  /**
   * Difference to a solution on another mesh. Integrals are taken over the
   * reference's cells by their 4-point rule (exact for products of gradients of
   * degree 2 where u_h has no kink in a reference cell), with the material of the
   * reference's cell; each point's energy is gathered in the cell of u_h that
   * holds it. Points outside u_h's mesh count for the nearest cell.
   *
   * A cell of u_h that no point falls into would seem to be exact. For the
   * indicator cell_energy such cells are integrated on their own, by the same
   * rule and with the reference found by its locator; this part does not enter
   * the global norms. Collective.
   *
   * Cells of u_h and of the reference in the sampling's ExcludedRegion count nowhere.
   *
   * @p sampling is of a reference on tetrahedra; see difference_to_hexahedra().
   */
  Difference
  difference_to_reference(const mesh::NodalField  &u_h,
                          const PointLocator      &locator, ///< of u_h's mesh
                          const ReferenceSampling &sampling);

  /**
   * Difference to a solution on hexahedra. Integrals are taken over the cells of u_h,
   * cut into eight until they are not much larger than the hexahedra that they touch,
   * by a rule of degree 2; a whole cell of degree 2 by one of degree 5. The material is
   * that of u_h's cell. Collective.
   */
  Difference
  difference_to_hexahedra(const mesh::NodalField &u_h, const ReferenceSampling &sampling);

  /** The same for one comparison only. */
  Difference
  difference_to_reference(const mesh::NodalField       &u_h,
                          const PointLocator           &locator, ///< of u_h's mesh
                          const mesh::NodalField       &reference,
                          const mechanics::MaterialMap &materials,
                          MPI_Comm                      communicator);

  /**
   * Difference to an exact solution given as expressions, integrated on u_h's own
   * cells: 14 points (exact to degree 5) for degree 1, 24 points (degree 6) for
   * degree 2. A gradient that is not given is computed by central differences of
   * order six, whose points stay in the cell: expressions are never evaluated
   * outside the body. Give it where you can: it saves 45 of 57 evaluations a
   * point. Collective.
   *
   * @param excluded cells of it count nowhere, and nothing is evaluated there.
   * @throws InputError if an expression does not parse or is not finite in a cell.
   */
  Difference
  difference_to_exact(const mesh::NodalField               &u_h,
                      const scene::ExactSolutionParameters &exact_solution,
                      const mechanics::MaterialMap         &materials,
                      MPI_Comm                              communicator,
                      const ExcludedRegion                 &excluded = {});

  /**
   * The 2015 report's relative error norm of a node, REN = |P-Q'| / |P0-Q'|: P0
   * rest position, P simulated position, Q' reference position interpolated at P0.
   * Zero when either distance is zero.
   *
   * |P-Q'| = |u_h-u| and |P0-Q'| = |u| are formed from the displacements, which
   * loses no digits when these are small against the model. A distance is zero
   * if it does not exceed zero_distance times the largest |u| at the nodes: what
   * is left by rounding, for example at a support, is no displacement. Nodes in an
   * ExcludedRegion have zero and count in no mean.
   */
  struct NodalRen
  {
    static constexpr double zero_distance = 1e-13;

    std::vector<double> values;                ///< one a node of u_h
    double              mean = 0., max = 0.;   ///< over all nodes (vertices and mid-edge nodes)
    double              mean_of_points = 0.;   ///< over the points of the mesh only
    std::vector<double> cell_sums;             ///< sum over a cell's nodes
    double              largest_distance = 0.; ///< farthest node outside the reference mesh
  };

  /** Collective. */
  NodalRen
  nodal_ren(const mesh::NodalField &u_h,
            const PointLocator     &reference_locator,
            const mesh::NodalField &reference,
            MPI_Comm                communicator);

  /** The same with a reference of either kind. Collective. */
  NodalRen
  nodal_ren(const mesh::NodalField &u_h, const ReferenceSampling &sampling);

  /** The same with the reference positions from an exact displacement. Collective.
   * @throws InputError as difference_to_exact(). */
  NodalRen
  nodal_ren(const mesh::NodalField               &u_h,
            const scene::ExactSolutionParameters &exact_solution,
            MPI_Comm                              communicator,
            const ExcludedRegion                 &excluded = {});
} // namespace tetradapt::compare

#endif
