// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_oscillation_h
#define tetradapt_estimate_equilibrated_oscillation_h

#include "cells.h"
#include "faces.h"

#include "tetradapt/mesh/edges.h"

namespace tetradapt::estimate
{
  /**
   * How much energy norm the part of the loads on one cell can cause that an
   * equilibrated stress of the space in use does not balance: the body force minus
   * its best quadratic approximation, f', and on its faces the traction minus its best
   * quadratic one, g'. For every displacement v,
   *   int_K f' . v + int_F g' . v <= (C_K |f'|_K + C_F |g'|_F) |eps(v)|_K,
   * and |eps(v)|_K <= sqrt(c) |||v|||_K with c the largest compliance.
   *
   * C_K bounds the distance (L2 norm in K) of v from quadratic functions, C_F that of
   * its trace from such functions, by the strain. On the regular tetrahedron with
   * unit edges they are 0.2066 and 0.93: the largest eigenvalues of these problems
   * among polynomials up to degree 8 are 0.2065 and 0.908 (0.2064 and 0.895 up to
   * degree 7), and the second approaches its limit like the third power of the
   * degree. 0.215 and 1 are used. For K = F * regular + shift, v = F^-T w maps
   * polynomials, rigid motions and strains (eps(v) = F^-T eps(w) F^-1) on each other,
   * hence with the largest and the smallest singular value of F
   *   C_K <= C smax^2 / smin,  C_F <= C' smax^2 / smin sqrt(|F| / |F'| / det F).
   *
   * @param faces norms of g' on the four faces of the cell.
   */
  double
  load_oscillation(const CellState             &state,
                   double                       largest_compliance,
                   const std::array<double, 4> &faces);

  /**
   * Energy norm of a displacement that is the difference between prescribed
   * displacements and those that @p u_h has on the supports, up to terms of higher
   * order: the next terms of its interpolation on the supports (quadratic
   * on the edges for degree 1; cubic on edges and faces for degree 2), continued into
   * the cells around. Zero if u_h has the prescribed values everywhere.
   *
   * @param edges of the mesh.
   */
  double
  support_oscillation(const mesh::NodalField       &u_h,
                      const mesh::EdgeTable        &edges,
                      const CellFaces              &faces,
                      const scene::Scene           &scene,
                      const mechanics::MaterialMap &materials);
} // namespace tetradapt::estimate

#endif
