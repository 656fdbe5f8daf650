// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_stress_h
#define tetradapt_estimate_equilibrated_stress_h

#include "cells.h"
#include "faces.h"
#include "loads.h"

#include "tetradapt/mesh/edges.h"

#include <mpi.h>

namespace tetradapt::estimate
{
  /** A stress in equilibrium with the loads of a scene, near that of a displacement;
   * equilibrated_bound() says how near and what for. */
  class EquilibratedStress
  {
  public:
    /** Makes the stress; see equilibrated_bound(). The arguments must outlive this
     * object. Collective.
     * @param near energy norm of a distance to u_h's stress that is near enough; what is
     *        farther is relaxed. */
    EquilibratedStress(const mesh::NodalField       &u_h,
                       const mesh::NodalField       &galerkin,
                       const scene::Scene           &scene,
                       const mechanics::MaterialMap &materials,
                       MPI_Comm                      communicator,
                       double                        near = 0.);

    /** Energies of its distance from the solution's stress, without what
     * CellState::thermal_oscillation is about, for the cells from @p first to
     * before @p last: squares of the norm. */
    std::vector<double>
    energies(unsigned int first, unsigned int last) const;

    /**
     * The stress at points of a cell (for tests and output; slower than energies()).
     * Quadratic on each part of Alfeld's split; where the body force is more than
     * linear, without the stress that balances the rest of it.
     * @param part of the cell in which the points are: the one at face @p part.
     * @param points barycentric coordinates in the cell.
     */
    std::vector<SymmetricTensor<2, 3>>
    values(unsigned int                          cell,
           unsigned int                          part,
           const std::vector<mesh::Barycentric> &points) const;

    CellStates                             states;
    CellFaces                              faces;
    std::vector<FaceLoad>                  loads; ///< of the listed faces
    std::shared_ptr<const mesh::EdgeTable> edges;
    std::vector<double>                    moments; ///< see FaceTractions

  private:
    bool
    is_within(double distance, MPI_Comm communicator);

    const mesh::TetMesh &mesh;
  };
} // namespace tetradapt::estimate

#endif
