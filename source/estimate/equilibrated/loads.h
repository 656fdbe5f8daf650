// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_loads_h
#define tetradapt_estimate_equilibrated_loads_h

#include "tetradapt/mesh/nodal_field.h"
#include "tetradapt/scene/scene.h"

namespace tetradapt::estimate
{
  using dealii::Tensor;

  /** What acts on a face of the boundary. */
  struct FaceLoad
  {
    unsigned char held = 0; ///< bit c is set: component c is supported, its traction unknown
    /** Integrals of the given traction times l_0, l_1, l_2, 4 l_0 l_1, 4 l_1 l_2,
     * 4 l_2 l_0 of the face's corners. */
    std::array<Tensor<1, 3>, 6> moments;
    /** L2 norm of what is left of the traction when the polynomial of degree 2
     * with these moments is subtracted. */
    double oscillation = 0.;
  };

  /** The loads and supports of all listed faces of a mesh, from the names on their
   * patches; integrated as in mechanics::assemble_loads(). Springs count as the traction that they
   * have at @p displacement, integrated as in the matrix. */
  std::vector<FaceLoad>
  face_loads(const scene::Scene &scene, const mesh::NodalField &displacement);
} // namespace tetradapt::estimate

#endif
