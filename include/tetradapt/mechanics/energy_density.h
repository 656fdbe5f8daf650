// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_energy_density_h
#define tetradapt_mechanics_energy_density_h

#include "tetradapt/mechanics/material_map.h"

namespace tetradapt::mechanics
{
  /**
   * The density of the energy norm's square of solutions in one region: eps : C : eps in
   * displacement form. In mixed form it is s : C^-1 : s with the stress s of
   * PressureForm, which is the same where the pressure fits and stays finite where lambda does not.
   * There a pressure alone has no energy.
   */
  class EnergyDensity
  {
  public:
    /** Keeps a reference. */
    EnergyDensity(const MaterialMap &materials, int region) : law(materials.linear_law(region))
    {
      if (materials.is_mixed())
        form = materials.pressure_form(region);
    }

    /** Of a solution or a difference of two, with its gradient and pressure. */
    double
    operator()(const Tensor<2, 3> &gradient, double pressure) const
    {
      return form ? law.complementary_density(form->stress(gradient, pressure))
                  : law.energy_density(symmetrize(gradient));
    }

    /** Of the difference between an exact displacement, whose stress follows from its
     * gradient, and a solution. Thermal strain must have been taken off both. */
    double
    of_error(const Tensor<2, 3> &exact_gradient,
             const Tensor<2, 3> &gradient,
             double              pressure) const
    {
      return form ? law.complementary_density(law.stress(exact_gradient)
                                              - form->stress(gradient, pressure))
                  : law.energy_density(symmetrize(exact_gradient - gradient));
    }

  private:
    const LinearLaw            &law;
    std::optional<PressureForm> form;
  };
} // namespace tetradapt::mechanics

#endif
