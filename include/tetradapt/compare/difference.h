// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_difference_h
#define tetradapt_compare_difference_h

#include "tetradapt/compare/point_locator.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/scene/model_parameters.h"

#include <mpi.h>

namespace tetradapt::compare
{
  /** Norms of u_h minus a better solution u. Energies are int eps:C:eps. */
  struct Difference
  {
    double              l2 = 0., h1 = 0., energy = 0.; ///< norms of u - u_h; h1: seminorm |grad|
    double              l2_norm = 0., h1_norm = 0., energy_norm = 0.; ///< the same norms of u
    std::vector<double> cell_energy; ///< energy norm of the difference, one a cell of u_h's mesh
    double              largest_distance = 0.; ///< farthest quadrature point outside u_h's mesh
  };

  /** Difference to a solution on another mesh, integrated with the quadrature
   * points of the reference's mesh and gathered per cell of u_h's. Collective. */
  Difference difference_to_reference(const mesh::NodalField       &u_h,
                                     const PointLocator           &locator, ///< of u_h's mesh
                                     const mesh::NodalField       &reference,
                                     const mechanics::MaterialMap &materials,
                                     MPI_Comm                      communicator);

  /** Difference to an exact solution given as expressions, integrated on u_h's
   * own cells. Collective. */
  Difference difference_to_exact(const mesh::NodalField       &u_h,
                                 const scene::TruthParameters &truth,
                                 const mechanics::MaterialMap &materials,
                                 MPI_Comm                      communicator);

  /**
   * The 2015 report's relative error norm of a node, REN = |P-Q'| / |P0-Q'|: P0
   * rest position, P simulated position, Q' reference position interpolated at P0.
   * Zero when either distance is zero.
   */
  struct NodalRen
  {
    std::vector<double> values; ///< one a node of u_h
    double              mean = 0., max = 0.;
    std::vector<double> cell_sums;             ///< sum over a cell's nodes
    double              largest_distance = 0.; ///< farthest node outside the reference mesh
  };

  NodalRen nodal_ren(const mesh::NodalField &u_h,
                     const PointLocator     &reference_locator,
                     const mesh::NodalField &reference,
                     MPI_Comm                communicator);

  /** The same with the reference positions from an exact displacement. */
  NodalRen nodal_ren(const mesh::NodalField       &u_h,
                     const scene::TruthParameters &truth,
                     MPI_Comm                      communicator);
} // namespace tetradapt::compare

#endif
