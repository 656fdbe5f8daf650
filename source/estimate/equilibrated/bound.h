// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_bound_h
#define tetradapt_estimate_equilibrated_bound_h

#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mesh/nodal_field.h"
#include "tetradapt/scene/scene.h"

#include <mpi.h>

#include <vector>

namespace tetradapt::estimate
{
  /** A guaranteed bound of the energy norm of the error, and where it comes from. */
  struct EquilibratedBound
  {
    std::vector<double> cell_energy; ///< eta_K: energy norm of stress_eq - stress_h, one a cell
    /** Not below |||u - u_h|||. */
    double global = 0.;
    /** What data that are no polynomials of low degree add: global minus the root of
     * the sum of eta_K^2. */
    double oscillation = 0.;
  };

  /**
   * Bounds the error of a displacement u_h of degree 1 or 2 by a stress that is in
   * equilibrium with the loads of @p scene at every point.
   *
   * Prager and Synge (Quart. Appl. Math. 5, 1947): a symmetric stress s with div s + f
   * = 0 and s n = t where tractions are given satisfies, with the energy norms of
   * displacements and of stresses (int s : C^-1 : s),
   *   |||u - u_h|||^2 + ||stress - s||^2 = ||s - stress_h||^2.
   * No unknown constant enters, whatever the mesh, nu < 0.5 and the contrast of
   * materials. How the stress is made: FaceTractions (tractions in equilibrium on
   * each cell, from @p galerkin), TractionRelaxation (which lowers the energy to little above the
   * least), EquilibratedElement (the stress in a cell).
   *
   * Where the loads are not in the space (body forces beyond quadratic, tractions
   * beyond quadratic polynomials in a cell), load_oscillation() is added; for
   * prescribed displacements that u_h has only at nodes, see support_oscillation();
   * with w such a displacement, |||u - u_h|||^2 <= ||s - stress_h||^2 + |||w|||^2.
   *
   * On springs s n is the traction -K (v - u0) of @p galerkin, v. Then int (s - stress_h) : eps(w)
   * = int stress(u - u_h) : eps(w) + int (u - v) . K w for every w, and with w = u - u_h
   *   |||u - u_h|||^2 + |u - u_h|_K^2 <= ||s - stress_h||^2 + |v - u_h|_K^2,
   * where |w|_K^2 = int w . K w over the springs.
   *
   * Integrals of loads are those of the solution, by quadrature. The error of an
   * iterative solver is not included: the class Equilibrated adds it.
   *
   * Collective. Takes one to three times as long as a solution of degree 2, and 21 kB a cell,
   * for at most TractionRelaxation::most_cells cells at a time.
   *
   * @param galerkin the solution of the discrete equations that the stress is made from: u_h
   *        itself, or one of a higher degree on the same mesh, whose stress is nearer
   *        to the exact one.
   * @param near a bound that is sharp enough: with a smaller one relaxation is left out.
   * @throws core::InputError if a force passes between parts of the body that touch in
   *         a point or along an edge only: there is no such stress then.
   */
  EquilibratedBound
  equilibrated_bound(const mesh::NodalField       &u_h,
                     const mesh::NodalField       &galerkin,
                     const scene::Scene           &scene,
                     const mechanics::MaterialMap &materials,
                     MPI_Comm                      communicator,
                     double                        near = 0.);
} // namespace tetradapt::estimate

#endif
