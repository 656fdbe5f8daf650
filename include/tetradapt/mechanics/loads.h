// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_loads_h
#define tetradapt_mechanics_loads_h

#include "tetradapt/fem/field.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/mechanics/resultant.h"

namespace tetradapt::mechanics
{
  /** What one load of the scene amounts to on a mesh. */
  struct LoadTotal
  {
    Resultant resultant;
    double    magnitude = 0.; ///< int |density|, or of all temperatures int |alpha T|; else 0
    /** What quadrature may have left out of integrals of the density, a force: the sum over
     * faces or cells of what DensitySampler expects there. */
    double remainder = 0.;
    /** Empty, or a sentence about how the load was looked at. */
    std::string remark;
    /** Empty, or a sentence about what a total force needed; see ResultantTraction::note(). */
    std::string note;

    /** Whether the load is known well enough for a bound to be called guaranteed: zero or far
     * below what any error is measured to. */
    bool
    is_converged() const
    {
      return remainder <= 1e-4 * magnitude;
    }
  };

  /** The loads of a scene on the nodes of a mesh. */
  struct NodalLoads
  {
    fem::Vector            forces; ///< on the nodes
    std::vector<LoadTotal> totals; ///< one a load of the scene, the same on every rank
  };

  /**
   * Consistent nodal forces of the scene's loads: integrals of
   * the shape functions times tractions and pressures over the patches that
   * carry a load's name, body forces, weight, and int B^T C eps_thermal.
   *
   * Densities are sampled as SurfaceLoads and VolumeDensity say: constants are integrated
   * exactly, other expressions adaptively, on every mesh alike.
   *
   * LoadType::nodal_force is no integral: its value acts at every point of the mesh on
   * the chosen faces (with degree 2 at the vertices only). The total grows with the number
   * of these points, so that another mesh is another problem, whose energies cannot be
   * compared.
   *
   * @param deformation of the body, a field of @p space, at whose deformed positions the forces
   * act: for their moments. Null: those at rest.
   *
   * Collective.
   */
  NodalLoads
  assemble_loads(const scene::Scene &scene,
                 const MaterialMap  &materials,
                 const fem::Space   &space,
                 const fem::Field   *deformation = nullptr);
} // namespace tetradapt::mechanics

#endif
