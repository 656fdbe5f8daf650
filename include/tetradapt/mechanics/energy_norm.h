// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_energy_norm_h
#define tetradapt_mechanics_energy_norm_h

#include <optional>

namespace tetradapt::mechanics
{
  /**
   * What relative errors in the energy norm are relative to: the root of the stress energy
   * int sigma : C^-1 : sigma of a solution, sigma its stress. Without temperatures this is
   * int eps : C : eps; with them it is that of the mechanical strain eps - eps_thermal, for
   * strain that a temperature causes freely is no stress.
   */
  struct EnergyNorm
  {
    /** Part of the scale that rounding leaves: more than the unit roundoff, since exact
     * gradients may come from numerical differentiation. */
    static constexpr double rounding = 1e-10;

    double value = 0.;
    /** What counts as zero: rounding times the root of int 2 mu |grad u|^2, the terms
     * that cancel where a body only moves, turns or expands freely, and what an iterative
     * solver left. */
    double noise = 0.;

    /** @p error over the norm; 0 where both are noise; nothing where only the norm is, for a
     * relative error to no stress has no meaning. */
    std::optional<double>
    relative(const double error) const
    {
      if (value > noise)
        return error / value;
      return error <= noise ? std::optional<double>(0.) : std::nullopt;
    }
  };
} // namespace tetradapt::mechanics

#endif
