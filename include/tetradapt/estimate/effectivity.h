// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_effectivity_h
#define tetradapt_estimate_effectivity_h

#include "tetradapt/scene/scene.h"

#include <optional>
#include <string>

namespace tetradapt::estimate
{
  /** What drives a deformation; it decides what a known energy tells. */
  enum class Drive
  {
    loads,        ///< loads only; every prescribed displacement is zero
    displacement, ///< prescribed displacements only, no loads
    both
  };

  /** @throws core::InputError if an expression of a support does not compile. */
  Drive
  drive_of(const scene::Scene &scene);

  /** A true error, if it can be told, and what the user should be told if not. */
  struct KnownEnergyError
  {
    std::optional<double> error;          ///< |||u - u_h|||, energy norm
    std::optional<double> relative_error; ///< over sqrt(E)
    std::string           warning;        ///< empty, or one sentence
  };

  /**
   * The energy norm of the error of a Galerkin solution from the known energy
   * E = a(u,u) and E_h = a(u_h,u_h), without any other mesh.
   *
   * With loads only, E - E_h = |||u - u_h|||^2, for a(u, u_h) = F(u_h) = E_h. With
   * prescribed displacements only (that the mesh represents exactly),
   * E_h - E = |||u - u_h|||^2, for E is the minimum of a(v,v). With both, neither
   * holds and nothing can be told. A difference of the wrong sign within 1e-6 of
   * E (known energies have about seven digits) counts as rounding and gives the
   * root of its size; beyond, the known energy contradicts the solution: no
   * error, but a warning.
   *
   * @param known_energy E > 0.
   */
  KnownEnergyError
  error_from_known_energy(double known_energy, double energy, Drive drive);

  /** How the strain energies of meshes lie to the true one. */
  enum class EnergySide
  {
    below,  ///< mechanical loads act alone: the body is stiffer on a mesh
    above,  ///< no mechanical load acts: the true strain energy is the least possible
    unknown ///< mechanical loads with prescribed displacements or temperatures
  };

  /** @throws core::InputError if an expression of a support does not compile. */
  EnergySide
  strain_energy_side(const scene::Scene &scene);

  /**
   * The same from strain energies W = 1/2 int (eps - eps_th) : C : (eps - eps_th), which
   * differ from the true one by half the square of the error's energy norm. relative_error
   * is over sqrt(2 W).
   *
   * @param known_energy W > 0. @param energy of a Galerkin solution.
   */
  KnownEnergyError
  error_from_strain_energy(double known_energy, double energy, EnergySide side);

  /** Estimated over true error; empty if either is unknown or the true one zero. */
  std::optional<double>
  effectivity(const std::optional<double> &estimate, const std::optional<double> &true_error);
} // namespace tetradapt::estimate

#endif
