// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_kept_places_h
#define tetradapt_mesh_kept_places_h

#include "tetradapt/core/log.h"
#include "tetradapt/mesh/plc.h"
#include "tetradapt/scene/scene.h"

namespace tetradapt::mesh
{
  class BoundaryProjection;

  /** Where the scene's supports at points or on lines and its point forces act, as the scene says
   * it. */
  std::vector<KeptPlace>
  kept_places(const scene::Scene &scene);

  /**
   * Puts @p places into a body that is to be meshed: points and lines on its facets become
   * points and edges of these, others points inside and PiecewiseLinearComplex::segments. Ends
   * as near as 1e-6 of the body's largest extent to a point or an edge are moved there.
   *
   * @param projection of the boundary, which has assigned the patches; null for none. Near a point
   *        on the true surface the nearest facet is cut, and its new corner put at the point. A
   *        line must lie on facets and surface both.
   * Warns of points inside that are nearer to the surface than 1e-2 of the body's largest
   * extent: they may have been meant to lie on it.
   *
   * @throws core::InputError for a point outside of the body, or a line that leaves it, with the
   *         coordinates; core::NumericalError if rounding spoils the facets.
   */
  PiecewiseLinearComplex
  with_kept_places(const PiecewiseLinearComplex &plc,
                   const std::vector<KeptPlace> &places,
                   const BoundaryProjection     *projection = nullptr,
                   const core::Log              &log        = core::Log());

  /**
   * Finds @p places on the vertices and edges of a mesh that may not change: the nearest vertex,
   * if it lies within 1e-6 of the body's largest extent, and for lines edges all the way.
   * @return them, with the vertices as ends.
   * @throws core::InputError that says which vertex is nearest and how far it is.
   */
  std::vector<KeptPlace>
  places_on_vertices(const TetMesh &mesh, const std::vector<KeptPlace> &places);

  /**
   * The vertices of a kept place: one for a point, for a line all along it in order from
   * the first end, so that each two in a row are the ends of an edge.
   * @throws core::NumericalError if the mesh does not have them.
   */
  std::vector<unsigned int>
  vertices_of(const TetMesh &mesh, const KeptPlace &place);

  /** The place of TetMesh::kept with a name; null if there is none. */
  const KeptPlace *
  find_place(const TetMesh &mesh, const std::string &name);

  /** @throws core::NumericalError, saying that TetGen lost it, if vertices_of() does for a kept
   * place of @p mesh. */
  void
  check_kept_places(const TetMesh &mesh);
} // namespace tetradapt::mesh

#endif
