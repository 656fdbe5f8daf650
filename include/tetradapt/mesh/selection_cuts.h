// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_selection_cuts_h
#define tetradapt_mesh_selection_cuts_h

#include "tetradapt/core/log.h"
#include "tetradapt/mesh/plc.h"
#include "tetradapt/scene/mesh_parameters.h"
#include "tetradapt/scene/model_parameters.h"

#include <functional>

namespace tetradapt::mesh
{
  /** Whether the body is made from a surface into which borders can be cut: a box, blocks, a
   * surface file. */
  bool
  borders_are_cut(const scene::MeshParameters &parameters);

  /**
   * Cuts the borders of selections into the facets of a body that is to be meshed
   * (geometry::cut_surface()) and splits its patches by who selects them, as
   * select_faces() does with those of a mesh: meshes made from it follow the borders, and
   * so do all that are made from those. Facets through which no border runs stay as they are.
   *
   * Warns where a border forces the mesh to resolve less than a hundredth of the local
   * size, and, if rounding spoils the cuts, of facets that are selected as a whole.
   *
   * @param local_size wanted edge length at a point.
   * @throws core::InputError as select_faces() does.
   */
  PiecewiseLinearComplex
  with_selections(const PiecewiseLinearComplex                               &plc,
                  const std::vector<std::pair<std::string, scene::Selector>> &selectors,
                  const std::function<double(const Point<3> &)>              &local_size,
                  const core::Log                                            &log);

  /** Splits the patches as @p split does those of a mesh that has the facets as its faces, a
   * polygon as its largest triangle, and no cells. */
  PiecewiseLinearComplex
  with_split_patches(const PiecewiseLinearComplex         &plc,
                     const std::function<void(TetMesh &)> &split);
} // namespace tetradapt::mesh

#endif
