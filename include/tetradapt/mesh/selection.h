// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_selection_h
#define tetradapt_mesh_selection_h

#include "tetradapt/mesh/tet_mesh.h"
#include "tetradapt/scene/model_parameters.h"

namespace tetradapt::mesh
{
  /** What one selector found. */
  struct SelectedFaces
  {
    std::string  name; ///< of the support or load
    unsigned int n_faces = 0;
    double       area    = 0.;
  };

  /**
   * Evaluates selectors on the boundary of @p mesh, a finalized one, and splits
   * its patches so that all faces of a patch are selected by the same ones. The
   * names of these are appended to Patch::selections, in the order of
   * @p selectors. New patches are sorted by the old patch, then by who selects
   * them; patches without faces are dropped.
   *
   * A face is selected if its boundary id or its group's name is listed (or no
   * list is given) and the expression, if there is one, holds at its three
   * corners and its centroid.
   *
   * @param selectors names, as they are to stand in Patch::selections, and what
   *        they select.
   * @return faces and area found by each selector, in their order.
   * @throws core::InputError if a selector selects nothing or names an id or a
   *         group that the boundary does not have, with what there is to choose
   *         from; as core::Expression does for the expressions.
   */
  std::vector<SelectedFaces>
  select_faces(TetMesh                                                    &mesh,
               const std::vector<std::pair<std::string, scene::Selector>> &selectors);
} // namespace tetradapt::mesh

#endif
