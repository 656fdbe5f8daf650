// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_hexahedral_system_h
#define tetradapt_solve_hexahedral_system_h

#include "tetradapt/core/log.h"
#include "tetradapt/mesh/hexahedral_field.h"
#include "tetradapt/solve/hexahedral_multigrid.h"

namespace tetradapt::solve
{
  /** A static equilibrium on one mesh of hexahedra. */
  struct HexahedralSolution
  {
    std::shared_ptr<mesh::HexahedralField> displacement; ///< every rank holds all of it
    Vector       nodal;           ///< the same on the system's unknowns, hanging nodes included
    unsigned int iterations = 0;  ///< of conjugate gradients
    double       energy     = 0.; ///< a(u_h,u_h); where gain_sign is not 0, that times gain
    double       gain       = 0.; ///< 2 F(u_h) - a(u_h,u_h)
    /** 1 if the energy is the gain, for only loads act; -1 if it is that with the other sign, for
     * only displacements are prescribed; else 0. What conjugate gradients left changes the gain in
     * second order only. */
    int    gain_sign = 0;
    double norm      = 0.; ///< what relative errors are of, see mechanics::EnergyNorm
  };

  /** The system of a static problem on one mesh of hexahedra, and what solves it: conjugate
   * gradients with p-multigrid. Collective over the forest's communicator. */
  class HexahedralSystem
  {
  public:
    /** Numbers, and makes the stiffness and the constraints. Keeps references to all. */
    HexahedralSystem(const scene::Scene           &scene,
                     const mechanics::MaterialMap &materials,
                     const HexahedralForest       &forest,
                     unsigned int                  degree);

    const HexahedralSpace &
    space() const
    {
      return levels.fine.space;
    }

    /**
     * The displacement under the scene's supports and loads, as they act on @p mesh.
     *
     * @param mesh the scene's first.
     * @param start first iterate, on a mesh of the same body; null: none.
     * @param algebraic_error energy norm that the iterate's own error may have; 0: a small
     *        part of that of the first iterate, without one of what is solved for.
     * @throws core::NumericalError if the forces are not finite or the solver fails.
     */
    HexahedralSolution
    solve(const mesh::TetMesh         &mesh,
          const mesh::HexahedralField *start,
          double                       algebraic_error,
          const core::Log             &log) const;

  private:
    const scene::Scene           &scene;
    const mechanics::MaterialMap &materials;
    HexahedralLevels              levels;
  };
} // namespace tetradapt::solve

#endif
