// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_hexahedral_reference_h
#define tetradapt_adapt_hexahedral_reference_h

#include "tetradapt/compare/reference.h"
#include "tetradapt/core/log.h"

namespace tetradapt::adapt
{
  /**
   * Solves a scene, whose body is made of boxes, with functions of degree
   * ReferenceParameters::degree on hexahedra, refining these where the error is until the
   * estimated error in the energy norm, relative to the solution's, is below
   * compare::hexahedral_tolerance(), or the next system would have more unknowns than
   * ReferenceParameters::max_dofs, which is a warning. Supports and loads act as on @p mesh, the
   * scene's first. Collective.
   *
   * The error is estimate::calibrated_error() and a margin for what it was found to lack on
   * singular edges, half of it for degree 2, 30 % for degree 3. The known energy is without the
   * margin; there is none where loads and prescribed displacements act together.
   *
   * @throws core::InputError for what hexahedra cannot do (see solve::make_hexahedral_grid()),
   *         core::NumericalError if the solver fails.
   */
  compare::Reference
  make_hexahedral_reference(const scene::Scene           &scene,
                            const mechanics::MaterialMap &materials,
                            const mesh::TetMesh          &mesh,
                            MPI_Comm                      communicator,
                            const core::Log              &log);
} // namespace tetradapt::adapt

#endif
