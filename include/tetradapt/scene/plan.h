// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_plan_h
#define tetradapt_scene_plan_h

#include "tetradapt/scene/scene.h"

#include <string>
#include <utility>
#include <vector>

namespace tetradapt::scene
{
  /**
   * Which stages a scene needs and which it does without, each with the reason.
   * Decided from the scene alone, before any work; the loop asks needs() and
   * does not build what is skipped.
   */
  class Plan
  {
  public:
    enum StageId
    {
      surface_screening,  ///< reading a surface and checking that TetGen can mesh it
      surface_remeshing,  ///< CGAL's isotropic remeshing to an edge length
      volume_mesh_file,   ///< reading the scene's volume meshes
      brick_meshing,      ///< cutting a box into bricks and tetrahedra
      tetgen_meshing,     ///< meshing a box or the inside of a surface
      initial_refinement, ///< refining a mesh from a file before the first cycle
      thermal_strain,     ///< evaluating temperatures
      multigrid_solver,   ///< conjugate gradients with algebraic multigrid
      direct_solver,
      newton_method,        ///< of laws that are not linear: tangents, steps, load steps
      reference_mesh,       ///< making the reference's own mesh
      reference_refinement, ///< ... by TetGen from the first mesh
      hexahedral_reference, ///< solving on an adaptive hexahedral mesh
      reference_solution,   ///< solving on it, or taking the solution from the cache
      reference_file,       ///< reading the .vtu of an earlier run
      reference_cache,      ///< looking for, and keeping, the reference on disk
      reference_error,      ///< recovery estimate of the reference's own error
      extrapolation,        ///< difference to the reference in the energy norm, L2 and H1
      nodal_ren,            ///< relative nodal error of the 2015 report
      exact_comparison,     ///< difference to the exact displacement
      known_energy,         ///< energy error from the known energy
      estimation,           ///< error estimators that need neither reference nor exact solution
      goal_values,          ///< evaluating the goals
      dual_solution,        ///< solving for what the error does to a goal
      marking,              ///< choosing the tetrahedra to refine
      sizing,               ///< the size field of the next mesh
      tetgen_refinement,    ///< refining from cycle to cycle
      body_remeshing,       ///< meshing the body from scratch, so that elements can grow
      boundary_projection,  ///< moving new points to the curved boundary
      uniform_refinement,   ///< cutting every tetrahedron into 8
      stress_recovery,      ///< stresses for output
      vtu_output,
      tables,
      plots,            ///< SVG by gnuplot
      size_field_output ///< the sizes that the run ends with
    };

    struct Stage
    {
      StageId     id;
      std::string name;
      bool        needed;
      std::string reason; ///< of being needed, or of being skipped
    };

    explicit Plan(const Scene &scene);

    bool
    needs(const StageId id) const
    {
      return stages[id].needed;
    }

    /** Whether the error is measured with a reference, solved or read. */
    bool
    uses_reference() const
    {
      return needs(reference_solution) || needs(hexahedral_reference) || needs(reference_file);
    }

    /** All stages in the order of StageId; a temporary plan gives its list away. */
    const std::vector<Stage> &
    all() const &
    {
      return stages;
    }
    std::vector<Stage>
    all() &&
    {
      return std::move(stages);
    }

    /** Two lists, "needs" and "skips", one line a stage with its reason. */
    std::string
    text() const;

  private:
    void
    add(StageId            id,
        const std::string &name,
        bool               needed,
        const std::string &reason_if_needed,
        const std::string &reason_if_not);
    void
    add_mesh_stages(const Scene &scene);
    void
    add_solver_stages(const Scene &scene);
    void
    add_reference_stages(const Scene &scene);
    void
    add_error_stages(const Scene &scene);
    void
    add_estimation_stages(const Scene &scene);
    void
    add_adaptivity_stages(const Scene &scene);
    void
    add_output_stages(const Scene &scene);

    std::vector<Stage> stages;
  };
} // namespace tetradapt::scene

#endif
