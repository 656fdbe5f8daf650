// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_tet_quadrature_h
#define tetradapt_compare_tet_quadrature_h

#include "tetradapt/mesh/nodal_field.h"

namespace tetradapt::compare
{
  /** Points and weights for integrals over a tetrahedron; the weights are
   * positive and sum to one: multiply by the volume. */
  struct TetQuadrature
  {
    std::vector<mesh::Barycentric> points;
    std::vector<double>            weights;
  };

  /**
   * A rule that integrates polynomials of degree @p degree exactly: 1 point for
   * degree 1, 4 for 2, 14 for up to 5, 24 for 6.
   *
   * Sources: Hammer, Marlowe, Stroud, Math. Tables Aids Comp. 10 (1956) for 4
   * points; Walkington, "Quadrature on simplices of arbitrary dimension" (2000),
   * for 14; Keast, Comp. Meth. Appl. Mech. Eng. 55 (1986) for 24.
   *
   * @throws std::logic_error for a higher degree.
   */
  const TetQuadrature &
  tet_quadrature(unsigned int degree);
} // namespace tetradapt::compare

#endif
