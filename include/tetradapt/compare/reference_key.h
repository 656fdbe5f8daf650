// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_reference_key_h
#define tetradapt_compare_reference_key_h

#include "tetradapt/mesh/tet_mesh.h"
#include "tetradapt/scene/scene.h"

namespace tetradapt::compare
{
  /** The relative energy error that a reference on hexahedra may have: that of the
   * scene, else a tenth of what the scene adapts to, else 0.001. */
  double
  hexahedral_tolerance(const scene::Scene &scene);

  /**
   * A hash of everything that determines the scene's reference of type fine_mesh or
   * hexahedra, and of nothing else: materials, supports, loads, degree and mesh of the
   * reference, TetGen's parameters (not its limits), the solver's tolerance, the
   * initial mesh where it is refined (for hexahedra, its selections' areas), the bytes of the
   * reference's mesh file where there is one, and the versions of this code, of TetGen and of
   * deal.II. Two scenes with the same key have the same reference, to the last bit.
   *
   * @return 32 hexadecimal digits.
   * @throws InputError if the mesh file cannot be read.
   */
  std::string
  reference_key(const scene::Scene &scene, const mesh::TetMesh &initial_mesh);
} // namespace tetradapt::compare

#endif
