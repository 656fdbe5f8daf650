// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_energies_h
#define tetradapt_solve_energies_h

#include "tetradapt/fem/field.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mesh/hexahedral_field.h"

#include <mpi.h>

namespace tetradapt::solve
{
  struct Energies
  {
    double energy = 0.; ///< int eps:C:eps = a(u,u)
    double stored = 0.; ///< 1/2 int (eps - eps_th):C:(eps - eps_th)
    /** int 2 mu |grad u|^2: the scale of the terms that cancel in the others where a body turns
     * or expands freely. */
    double scale = 0.;
  };

  /** Energies of a displacement; exact for a constant temperature. Collective. */
  Energies
  compute_energies(const fem::Field &displacement, const mechanics::MaterialMap &materials);

  /** The same on hexahedra, in displacement form. Collective: the cells are shared out over the
   * ranks. */
  Energies
  compute_energies(const mesh::HexahedralField  &displacement,
                   const mechanics::MaterialMap &materials,
                   MPI_Comm                      communicator);
} // namespace tetradapt::solve

#endif
