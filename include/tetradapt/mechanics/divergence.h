// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_divergence_h
#define tetradapt_mechanics_divergence_h

#include "tetradapt/fem/fixed_unknowns.h"
#include "tetradapt/fem/pressure_space.h"

namespace tetradapt::mechanics
{
  using fem::PressureSpace;
  using fem::Vector;

  /**
   * The form -int q div u of pressures q of degree 1 and displacements u of degree 2, in both
   * directions, without a matrix: the divergence is linear in a cell and computed at its
   * vertices, and the integral of a product of two linear functions has a closed form.
   */
  class Divergence
  {
  public:
    /** Keeps no reference. */
    Divergence(const PressureSpace &space, const fem::FixedUnknowns &fixed_unknowns);

    /** q_i = -int q_i div u; prescribed displacements in @p u count. Collective. */
    void
    vmult(Vector &q, const Vector &u) const;

    /** u_j = u_j - int q div u_j where no support prescribes the displacement. Collective. */
    void
    add_transposed(Vector &u, const Vector &q) const;

    /** The largest |int q div u_j| over all free displacements, each relative to the size of the
     * cells' contributions: zero up to rounding if the pressure q moves nothing. Collective. */
    double
    relative_force(const Vector &q) const;

  private:
    struct Cell
    {
      std::array<unsigned int, 10>         displacements; ///< local nodes
      std::array<unsigned int, 4>          pressures;     ///< local nodes
      std::array<std::array<double, 3>, 4> gradients;     ///< of barycentric coordinates
      double                               volume;
    };
    /** Subtracts |cell| times the mean of q grad u_j from ten local nodes. */
    template <typename Add>
    void
    transposed_cell(const Cell &cell, const double *q, const Add &add) const;

    unsigned int               n_displacements, n_pressures; ///< owned nodes
    std::vector<Cell>          cells;
    std::vector<unsigned char> fixed; ///< components of owned displacement nodes
  };
} // namespace tetradapt::mechanics

#endif
