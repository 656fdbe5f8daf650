// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_residual_directions_h
#define tetradapt_solve_residual_directions_h

#include "tetradapt/solve/preconditioners.h"

#include <array>
#include <vector>

namespace tetradapt::solve
{
  /** A pair of a displacement and a pressure, or of their residuals. */
  struct MixedVector
  {
    Vector u, p;
  };

  /**
   * A direction d of an iteration for K x = b that minimises (r, D r) with a symmetric positive
   * D: d itself, the force K d, by which a step along it changes the residual, and D K d.
   */
  struct ResidualDirection
  {
    MixedVector direction, force, preconditioned_force;
    double      square = 0.; ///< (K d, D K d)
  };

  /**
   * The last few directions of an iteration of minimal residuals (truncated generalised
   * conjugate residuals, "Orthomin": Eisenstat, Elman and Schultz, SIAM J. Numer. Anal. 20,
   * 1983). Nothing is copied: slots are used in turns.
   */
  class ResidualDirections
  {
  public:
    /** Against how many directions the next one is made orthogonal. */
    static constexpr unsigned int n_kept = 4;

    /** The slot of the next direction, with vectors of the layout of @p like. Overwrites the
     * oldest. */
    ResidualDirection &
    next(const MixedVector &like);

    /** Takes off the latest direction, which next() gave and the caller has filled, its parts
     * along the others, so that (K d, D K d_j) = 0, and computes its square. Collective. */
    void
    orthogonalise();

    /** Forgets all. */
    void
    clear()
    {
      n_valid = 0;
    }

  private:
    std::vector<ResidualDirection> slots;
    unsigned int                   latest = 0, n_valid = 0;
  };
} // namespace tetradapt::solve

#endif
