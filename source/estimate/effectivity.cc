// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/effectivity.h"

#include "tetradapt/scene/moved_supports.h"

#include <cmath>
#include <sstream>

namespace tetradapt::estimate
{
  Drive
  drive_of(const scene::Scene &scene)
  {
    if (!scene::moves_supports(scene))
      return Drive::loads;
    return scene.loads.empty() ? Drive::displacement : Drive::both;
  }



  KnownEnergyError
  error_from_known_energy(const double known_energy, const double energy, const Drive drive)
  {
    KnownEnergyError result;
    if (drive == Drive::both)
      {
        result.warning = "The true energy error cannot be told from a known energy when both loads "
                         "and prescribed displacements act; the scene's known energy is not used.";
        return result;
      }
    const double squared = drive == Drive::loads ? known_energy - energy : energy - known_energy;
    if (!(squared >= -1e-6 * known_energy))
      {
        std::ostringstream text;
        text.precision(9);
        text << "The known energy " << known_energy << " contradicts the computed one, " << energy
             << ", which must be " << (drive == Drive::loads ? "below" : "above")
             << " it: check the known energy (a(u,u), the integral of strain : C : strain), the "
                "loads and the "
             << "material.";
        result.warning = text.str();
        return result;
      }
    result.error          = std::sqrt(std::abs(squared));
    result.relative_error = *result.error / std::sqrt(known_energy);
    return result;
  }



  std::optional<double>
  effectivity(const std::optional<double> &estimate, const std::optional<double> &true_error)
  {
    if (!estimate || !true_error || *true_error == 0. || !std::isfinite(*true_error))
      return std::nullopt;
    return *estimate / *true_error;
  }
} // namespace tetradapt::estimate
