// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_recovery_stress_conditions_h
#define tetradapt_estimate_recovery_stress_conditions_h

#include "tetradapt/estimate/cell_stress.h"
#include "tetradapt/estimate/given_loads.h"
#include "tetradapt/estimate/recovery/patches.h"
#include "tetradapt/mesh/face_table.h"

namespace tetradapt::estimate
{
  /**
   * What a recovered stress should satisfy apart from being close to the computed one, as
   * squares to be added to those of a fit.
   *
   * At points x of a boundary face with normal n, weighted with boundary_weight:
   * sigma n = t in the components whose traction is known; and where a support holds
   * all components, the strain in the plane of the face is that of the prescribed
   * displacement, which u_h interpolates: (t_i t_j) : C^-1 (sigma - sigma_h) = 0 for two
   * tangents, times 2 mu, so that it is a stress. In each cell's centre, weighted with
   * inner_weight: div sigma + f = 0, times the size of the patch.
   *
   * Where the boundary is projected on a surface, that is the body's: points and normals of
   * sigma n = t are its own (mesh::TrueSurface). Facets differ from it by angles of the order
   * of their size; with their normals, of which a patch has several, the condition would be
   * wrong by that times the stress along the wall.
   *
   * The weights were measured by indices of effectivity of degree 2. Where the stress is
   * singular at the boundary, on a cantilever and on an L-shaped solid, a boundary weight of
   * 0 gives 0.67 on the first, 3 gives 0.95 and 1.12, 10 gives 1.07 and 1.29; smooth solutions
   * hardly depend on it. The inner weight, of little effect from 0.1 to 1, makes the
   * distribution better for Poisson ratios near 1/2.
   */
  struct StressConditions
  {
    static constexpr double boundary_weight = 3., inner_weight = 0.3;

    /** sum over the points x of (sigma(x) - s_x)^T matrix (sigma(x) - s_x), as it enters
     * normal equations. */
    struct Face
    {
      double       matrix[6][6];
      unsigned int local_face; ///< of its cell: the vertex that it lies opposite
      unsigned int n_points;
      /** The centre; or three points, each nearer to one of the vertices in
       * mesh::face_vertices; or one of these three, where each has a normal of its own. */
      Point<3> points[3];
      /** Which of the three it is, if it is one alone; else invalid_unsigned_int. */
      unsigned int corner;
      double       right[3][6]; ///< matrix s_x

      /** matrix s_x at any point of the face, continued from the points as a constant
       * or a linear function. */
      void
      right_at(const mesh::Barycentric &b, double *result) const;

      /** How much the condition counts at a point of the face: one, or a share of one
       * for one of three points. */
      double
      weight_at(const mesh::Barycentric &b) const
      {
        return corner == dealii::numbers::invalid_unsigned_int
                 ? 1.
                 : b[mesh::face_vertices[local_face][corner]];
      }
    };

    /** For the mesh that @p u_h lives on: one point a face for degree 1, three for
     * degree 2. */
    StressConditions(const mesh::NodalField &u_h,
                     const CellStress       &stress,
                     const RecoveryPatches  &patches,
                     const GivenLoads       &loads);

    std::vector<char>         on_boundary;    ///< per point of the mesh
    std::vector<char>         on_curved_wall; ///< per point: of a face that is projected
    std::vector<unsigned int> begin;          ///< of each cell in faces; one more entry
    std::vector<Face>         faces;          ///< sorted by cells
    std::vector<Tensor<1, 3>> forces;         ///< body force in the cells' centres; empty: none
  };
} // namespace tetradapt::estimate

#endif
