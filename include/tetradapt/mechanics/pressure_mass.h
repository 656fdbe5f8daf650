// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_pressure_mass_h
#define tetradapt_mechanics_pressure_mass_h

#include "tetradapt/fem/pressure_space.h"
#include "tetradapt/mechanics/material_map.h"

namespace tetradapt::mechanics
{
  using fem::PressureSpace;
  using fem::Vector;

  /**
   * The mass matrix of the pressures, int q p, whose rows belong to one region each, and what
   * materials weight it with.
   */
  class PressureMass
  {
  public:
    /** Keeps no reference. @throws core::InputError for a material without mixed form. */
    PressureMass(const PressureSpace &space, const MaterialMap &materials);

    /** q = M p. Collective. */
    void
    vmult(Vector &q, const Vector &p) const;

    /** q = 1/(lambda - gamma) M p, see PressureForm. Collective. */
    void
    vmult_compliance(Vector &q, const Vector &p) const;

    /** p = a fixed symmetric approximation of the inverse of (1/(mu + gamma) + 1/(lambda - gamma))
     * M times q: Chebyshev's iteration with the diagonal, on the eigenvalues from 1/2 to 5/2 that M
     * has with its diagonal on tetrahedra of any shape (A. Wathen, IMA J. Numer. Anal. 7, 1987).
     * Collective. */
    void
    precondition(Vector &p, const Vector &q) const;

  private:
    std::vector<std::size_t>  row_starts;
    std::vector<unsigned int> columns;
    std::vector<double>       values;
    std::vector<double>       diagonal, compliance, weight; ///< one an owned node
    mutable Vector            residual, direction, product;
  };

  /** -int q tr eps_thermal for the pressures q of the owned nodes: the right-hand side of
   * -int q (div u + p/(lambda - gamma)) for the thermal strain. */
  Vector
  thermal_volume_load(const PressureSpace &space, const MaterialMap &materials);
} // namespace tetradapt::mechanics

#endif
