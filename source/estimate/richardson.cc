// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/exceptions.h"
#include "tetradapt/estimate/effectivity.h"
#include "tetradapt/estimate/extrapolation.h"
#include "tetradapt/estimate/recovery/recovery.h"

#include <cmath>
#include <optional>

namespace tetradapt::estimate
{
  namespace
  {
    /** By how much the energy changes from the first level to the second and from there
     * to the third, over each other, if its error is N^-rate. Grows with the rate. */
    double
    ratio_of_changes(const double rate, const double n1, const double n2, const double n3)
    {
      // Relative to the second level, so that no power leaves the range of doubles.
      return (std::pow(n1 / n2, -rate) - 1.) / (1. - std::pow(n3 / n2, -rate));
    }

    /**
     * The rate that three levels show, between bounds that leave room for bent curves;
     * empty if there is none.
     */
    std::optional<double>
    observed_rate(const double       ratio,
                  const double       n1,
                  const double       n2,
                  const double       n3,
                  const unsigned int degree)
    {
      // Uniform meshes give N^(-2 lambda / 3) at singularities like r^lambda, so a third at a
      // crack; smooth solutions give N^(-2p/3), and twice that is met on meshes too coarse
      // for the rates of theory.
      double slow = 0.25, fast = 4. / 3. * degree;
      if (!(ratio > ratio_of_changes(slow, n1, n2, n3))
          || !(ratio < ratio_of_changes(fast, n1, n2, n3)))
        return std::nullopt;
      for (unsigned int step = 0; step < 60; ++step)
        {
          const double middle                                          = 0.5 * (slow + fast);
          (ratio_of_changes(middle, n1, n2, n3) < ratio ? slow : fast) = middle;
        }
      return 0.5 * (slow + fast);
    }

    /** Square of the energy norm of the last level's error, or nothing. */
    std::optional<double>
    extrapolated_square(const std::vector<EnergyLevel> &levels,
                        const Drive                     drive,
                        const unsigned int              degree)
    {
      if (levels.size() < 3)
        return std::nullopt;
      const EnergyLevel *last = &levels.back();
      const double       n1 = last[-2].n_dofs, n2 = last[-1].n_dofs, n3 = last[0].n_dofs;
      const double       sign   = drive == Drive::loads ? 1. : -1.;
      const double       first  = sign * (last[-1].energy - last[-2].energy);
      const double       second = sign * (last[0].energy - last[-1].energy);
      if (!(n1 < n2 && n2 < n3) || !(first > 0.) || !(second > 0.))
        return std::nullopt;
      const auto rate = observed_rate(first / second, n1, n2, n3, degree);
      if (!rate)
        return std::nullopt;
      return second / (std::pow(n2 / n3, -*rate) - 1.);
    }
  } // namespace

  EstimatorTraits
  Richardson::traits() const
  {
    EstimatorTraits traits;
    traits.name = "richardson";
    traits.documentation
      = "Richardson's extrapolation of the energy over the last three meshes, with "
        "the rate that they show. Nothing is told before the third mesh, nor "
        "where the energies show no rate. The distribution is that of spr.";
    return traits;
  }

  Estimate
  Richardson::estimate(const EstimateInput &input) const
  {
    const Drive drive = drive_of(input.scene);
    if (drive == Drive::both)
      throw core::InputError(
        "The estimator 'richardson' extrapolates the energy, which gives the error only if either "
        "loads or prescribed displacements deform the body; this scene has both. Choose another "
        "one in Adaptivity and Estimation, for example spr.");
    const mesh::NodalField &u_h      = input.comparison.displacement();
    auto                    recovery = recovery_estimate(u_h,
                                      input.comparison.material_map(),
                                      input.comparison.mpi_communicator(),
                                      &input.scene);
    Estimate                result;
    result.indicators = std::move(recovery.cell_energy);
    const auto square = extrapolated_square(input.levels, drive, u_h.degree());
    if (!square)
      {
        result.missing = true;
        return result;
      }
    result.global = std::sqrt(*square);
    if (recovery.global > 0.)
      for (double &indicator : result.indicators)
        indicator *= result.global / recovery.global;
    return result;
  }
} // namespace tetradapt::estimate
