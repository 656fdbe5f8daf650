// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_reference_h
#define tetradapt_compare_reference_h

#include "tetradapt/compare/reference_sampling.h"
#include "tetradapt/core/log.h"
#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/scene/scene.h"

#include <mpi.h>

#include <functional>
#include <optional>

namespace tetradapt::compare
{
  /** A fine solution, and how wrong it is itself. Every rank holds all of it. */
  struct Reference
  {
    ReferenceField displacement;
    double         energy = 0.; ///< a(u_ref,u_ref)
    /** Of the reference itself, energy norm, absolute: by CellErrors on tetrahedra, by what
     * refinement gained on hexahedra. */
    double estimated_error = 0.;
    /** a(u,u) of the solution itself, extrapolated over the meshes of hexahedra: a known
     * energy, whose error is a part of the square of estimated_error. */
    std::optional<double> known_energy;
    bool                  from_cache = false;
    std::string           description;  ///< for the log: where it came from, its size
    double                seconds = 0.; ///< what it took to obtain
  };

  /** Estimates the error of a solution on tetrahedra without a better one: its energy norm, one a
   * cell. The scene is what was solved; null: unknown. Collective. */
  using CellErrors = std::function<std::vector<double>(const mesh::NodalField       &solution,
                                                       const mechanics::MaterialMap &materials,
                                                       MPI_Comm                      communicator,
                                                       const scene::Scene           *scene)>;

  /**
   * Solves, or reads from the cache, or reads from an earlier run's .vtu, the
   * scene's reference. Collective.
   *
   * @param initial_mesh the scene's initial mesh with selections made; the route
   *        "refine" refines it; on hexahedra supports and loads act where they act on it.
   * @param cell_errors for the error of a reference on tetrahedra; may be empty for hexahedra.
   * @param excluded what its own error leaves out.
   */
  Reference
  make_reference(const scene::Scene                  &scene,
                 const mechanics::MaterialMap        &materials,
                 std::shared_ptr<const mesh::TetMesh> initial_mesh,
                 MPI_Comm                             communicator,
                 const core::Log                     &log,
                 const CellErrors                    &cell_errors,
                 const ExcludedRegion                &excluded = {});
} // namespace tetradapt::compare

#endif
