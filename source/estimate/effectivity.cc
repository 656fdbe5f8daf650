// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/effectivity.h"

#include "tetradapt/scene/moved_supports.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::estimate
{
  Drive
  drive_of(const scene::Scene &scene)
  {
    if (!scene::moves_supports(scene))
      return Drive::loads;
    return scene.loads.empty() && !scene::loads_supports(scene) ? Drive::displacement : Drive::both;
  }



  KnownEnergyError
  error_from_known_energy(const double known_energy, const double energy, const Drive drive)
  {
    return error_from_strain_energy(0.5 * known_energy,
                                    0.5 * energy,
                                    drive == Drive::loads          ? EnergySide::below
                                    : drive == Drive::displacement ? EnergySide::above
                                                                   : EnergySide::unknown);
  }



  EnergySide
  strain_energy_side(const scene::Scene &scene)
  {
    const auto is_temperature
      = [](const scene::LoadParameters &load) { return load.type == scene::LoadType::temperature; };
    if (std::all_of(scene.loads.begin(), scene.loads.end(), is_temperature)
        && !scene::loads_supports(scene))
      return EnergySide::above;
    return scene::moves_supports(scene)
               || std::any_of(scene.loads.begin(), scene.loads.end(), is_temperature)
             ? EnergySide::unknown
             : EnergySide::below;
  }



  KnownEnergyError
  error_from_strain_energy(const double known_energy, const double energy, const EnergySide side)
  {
    KnownEnergyError result;
    if (side == EnergySide::unknown)
      {
        result.warning = "A known strain energy does not give the error where mechanical loads act "
                         "together with prescribed displacements or temperatures; the scene's "
                         "known strain energy is not used.";
        return result;
      }
    const double gap = side == EnergySide::below ? known_energy - energy : energy - known_energy;
    if (!(gap >= -1e-6 * known_energy))
      {
        std::ostringstream text;
        text.precision(9);
        text << "The known strain energy " << known_energy << " contradicts the computed one, "
             << energy << ", which must be " << (side == EnergySide::below ? "below" : "above")
             << " it: check the known strain energy (half the integral of strain : C : strain), "
                "the loads and the material.";
        result.warning = text.str();
        return result;
      }
    result.error          = std::sqrt(2. * std::abs(gap));
    result.relative_error = *result.error / std::sqrt(2. * known_energy);
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
