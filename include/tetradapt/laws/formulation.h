// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_laws_formulation_h
#define tetradapt_laws_formulation_h

namespace tetradapt::laws
{
  /** The equations of a run: their unknowns, and how strain is measured. */
  enum class Formulation
  {
    displacement, ///< small strains; the displacement alone
    mixed,        ///< small strains; displacement and pressure: no locking up to incompressibility
    finite_strain ///< large deformation, total Lagrangian; the displacement alone
  };
} // namespace tetradapt::laws

#endif
