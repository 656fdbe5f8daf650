// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_body_complex_h
#define tetradapt_mesh_body_complex_h

#include "tetradapt/mesh/edges.h"
#include "tetradapt/mesh/plc.h"
#include "tetradapt/mesh/sizing.h"

namespace tetradapt::mesh
{
  /** A body to be meshed from scratch. */
  struct BodyComplex
  {
    PiecewiseLinearComplex plc; ///< some of its points lie inside, of no facet
    Sizing                 sizing;
  };

  /**
   * The body that a mesh fills, for meshing it from scratch with larger and smaller cells: its
   * boundary with the patches, the walls between regions, a point in every part of a
   * region, and of the mesh's points as many as the wanted sizes have room for, so that
   * TetGen knows the sizes wherever they change and begins with points at about the
   * right distances.
   *
   * Flat parts of a patch or a wall need only the corners of their outlines
   * (geometry::FlatParts): there the new mesh may be as coarse as it likes. Curved parts
   * keep the triangles that they have and can only become finer: coarser triangles would
   * make another body.
   *
   * Points are chosen in the order corners, straight lines, flat parts, inside: one stays if
   * none that stayed is nearer than 0.85 times the smaller size of the two (a
   * Poisson-disk sample). Wherever sizes fall, all stay.
   *
   * (TetGen's own background meshes, -m with bgmin, were measured: finding 22 000
   * new points in one of 69 000 tetrahedra took it 9 s of 11.)
   *
   * @param mesh must be finalized. @param sizes wanted edge lengths, one a point.
   * @throws core::NumericalError if rounding spoils the boundary.
   */
  BodyComplex
  body_complex(const TetMesh &mesh, const std::vector<double> &sizes, const EdgeTable &edges);
} // namespace tetradapt::mesh

#endif
