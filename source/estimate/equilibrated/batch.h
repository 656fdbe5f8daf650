// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_batch_h
#define tetradapt_estimate_equilibrated_batch_h

#include "element.h"

#include "tetradapt/core/lanes.h"

namespace tetradapt::estimate
{
  using core::Lanes;

  /**
   * Eight cells whose energies int s : C^-1 : s are minimised over the stresses s
   * that equilibrate given loads, at once; see EquilibratedElement.
   */
  struct CellBatch
  {
    static constexpr unsigned int size = 8;
    using Element                      = EquilibratedElement;

    /** Energy density of a stress of the unit tetrahedron, times det F: its
     * coefficients for components p <= q, in the order 00, 01, .., 05, 11, .. */
    Lanes shape[21];
    Lanes inverse[9];              ///< F^-1, row by row
    Lanes loads[Element::n_loads]; ///< of the unit tetrahedron

    /** Coefficients of a quadratic body force in addition; see quadratic_forces(). */
    Lanes quadratic[Element::n_quadratic];
    bool  has_quadratic; ///< whether they count

    Lanes energy; ///< the minimum
    /** Half its derivatives by the moments of the tractions of the real cell. */
    Lanes gradient[Element::n_moments];
    /** Half its second derivatives, for functions m <= n: 3 x 3 components each,
     * n the row. */
    Lanes flexibility[9 * 300];
  };

  /** Computes the energy. */
  void
  minimise_energy(CellBatch &batch);

  /** Computes the energy, and the stress with this energy: n_stress coefficients,
   * without those of polynomials of degree 3. */
  void
  minimal_stress(CellBatch &batch, Lanes *stress);

  /** Computes the energy, its gradient and the flexibility. */
  void
  differentiate_energy(CellBatch &batch);
} // namespace tetradapt::estimate

#endif
