// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_selection_h
#define tetradapt_mesh_selection_h

#include "tetradapt/core/log.h"
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

    /** Faces through which the border of what is selected runs: they are selected or not as a
     * whole. */
    unsigned int n_straddled = 0;
    /** Of these, the area that is selected although the expression does not hold, or not
     * although it does; by sampling. */
    double uncertain_area = 0.;
    /** Selected area less that where the expression holds. */
    double excess_area = 0.;
  };

  /** When an expression counts as holding on a face. */
  enum class FaceRule
  {
    whole,   ///< it holds at the three corners and the centroid
    interior ///< it holds at the centroid: for surfaces into which its border was cut
  };

  /** @throws core::InputError if @p selector, of the support or load @p name, names a boundary id
   * or a group that no face of @p mesh has; with what there is to choose from. */
  void
  check_names(const TetMesh &mesh, const std::string &name, const scene::Selector &selector);

  /**
   * Evaluates selectors on the boundary of @p mesh, a finalized one, and splits
   * its patches so that all faces of a patch are selected by the same ones. The
   * names of these are appended to Patch::selections, in the order of
   * @p selectors. New patches are sorted by the old patch, then by who selects
   * them; patches without faces are dropped.
   *
   * A face is selected if its boundary id or its group's name is listed (or no
   * list is given) and the expression, if there is one, holds on it as @p rule says.
   * A comparison of affine functions counts as equality at a centroid that lies in its
   * plane up to rounding.
   *
   * For FaceRule::interior, cells and other points than those of the faces are not looked at.
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
               const std::vector<std::pair<std::string, scene::Selector>> &selectors,
               FaceRule                                                    rule = FaceRule::whole);

  /** Logs what of the selected areas is uncertain, with a warning from 1 % on. */
  void
  report_straddled(const std::vector<SelectedFaces> &found, const core::Log &log);

  /** The area of the faces that carry each selection. */
  std::map<std::string, double>
  selected_areas(const TetMesh &mesh);
} // namespace tetradapt::mesh

#endif
