// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/plan.h"

#include "consistency.h"
#include "values.h"

#include "tetradapt/scene/words.h"

#include <algorithm>

namespace tetradapt::scene
{
  namespace
  {
    using Indicator = AdaptivityParameters::RefinementIndicator;
    using Marking   = AdaptivityParameters::Marking;
    using Strategy  = AdaptivityParameters::Strategy;
    using Route     = ReferenceParameters::MeshRoute;
    using Reference = ReferenceParameters::Type;
    using Solver    = SolverParameters::Type;

    bool
    is_adaptive(const Scene &scene)
    {
      return scene.adaptivity.strategy == Strategy::adaptive;
    }

    bool
    is_driven_by(const Scene &scene, const Indicator which)
    {
      return is_adaptive(scene) && scene.adaptivity.refinement_indicator == which;
    }

    bool
    is_listed(const Scene &scene, const Indicator which)
    {
      const auto &listed = scene.estimation.estimators;
      return std::find(listed.begin(), listed.end(), which) != listed.end();
    }

    /** What of the output shows errors; empty: nothing. */
    std::string
    output_of_errors(const Scene &scene)
    {
      if (scene.output.tables)
        return "columns of the tables";
      return scene.output.plots ? "curves of the plots" : "";
    }

    /** Who uses the difference to the reference in the energy norm; empty: nobody. */
    std::string
    user_of_extrapolation(const Scene &scene)
    {
      if (is_driven_by(scene, Indicator::energy))
        return "drives the refinement";
      if (scene.adaptivity.tolerance > 0. && !scene.exact_solution.has_displacement()
          && !scene.exact_solution.has_energy())
        return "Adaptivity/Tolerance is measured with it";
      if (is_listed(scene, Indicator::energy))
        return "listed in Estimation/Estimators";
      return output_of_errors(scene);
    }

    std::string
    user_of_ren(const Scene &scene)
    {
      if (is_driven_by(scene, Indicator::ren))
        return "drives the refinement";
      if (scene.adaptivity.ren_tolerance > 0.)
        return "Adaptivity/REN tolerance is measured with it";
      if (is_listed(scene, Indicator::ren))
        return "listed in Estimation/Estimators";
      if (!output_of_errors(scene).empty())
        return output_of_errors(scene);
      return scene.output.vtu ? "a field of the .vtu files" : "";
    }

    std::string
    user_of_reference(const Scene &scene)
    {
      if (!user_of_extrapolation(scene).empty())
        return user_of_extrapolation(scene);
      return scene.exact_solution.has_displacement() ? "" : user_of_ren(scene);
    }

    std::string
    user_of_exact_solution(const Scene &scene, const bool drives)
    {
      if (drives && is_driven_by(scene, Indicator::exact))
        return "drives the refinement";
      if (scene.adaptivity.tolerance > 0.)
        return "Adaptivity/Tolerance is measured with it";
      if (drives && is_listed(scene, Indicator::exact))
        return "listed in Estimation/Estimators";
      return output_of_errors(scene);
    }

    bool
    has_initial_sizes(const Scene &scene)
    {
      return !scene.mesh.size.empty() || !scene.mesh.size_field.empty()
             || std::any_of(scene.mesh.volume_bounds.begin(),
                            scene.mesh.volume_bounds.end(),
                            [](const double bound) { return bound > 0.; });
    }

    const char *nothing_uses_it = "nothing uses it: it does not drive the refinement, no tolerance "
                                  "is measured with it, and tables are off";
  } // namespace

  Plan::Plan(const Scene &scene)
  {
    add_mesh_stages(scene);
    add_solver_stages(scene);
    add_reference_stages(scene);
    add_error_stages(scene);
    add_estimation_stages(scene);
    add_adaptivity_stages(scene);
    add_output_stages(scene);
  }

  void
  Plan::add(const StageId      id,
            const std::string &name,
            const bool         needed,
            const std::string &reason_if_needed,
            const std::string &reason_if_not)
  {
    stages.push_back({id, name, needed, needed ? reason_if_needed : reason_if_not});
  }

  void
  Plan::add_mesh_stages(const Scene &scene)
  {
    const MeshSource  source = scene.mesh.source;
    const std::string type   = "Mesh/Type = " + word(source);
    const bool        remesh = source == MeshSource::surface && scene.mesh.surface_edge_length > 0.;
    add(surface_screening, "surface screening", source == MeshSource::surface, type, type);
    add(surface_remeshing,
        "surface remeshing",
        remesh,
        "to edges of length " + text_of(scene.mesh.surface_edge_length),
        source == MeshSource::surface ? "Mesh/Surface edge length = 0" : type);
    add(volume_mesh_file, "volume mesh file", source == MeshSource::file, type, type);
    add(brick_meshing, "bricks", source == MeshSource::bricks, type, type);
    add(tetgen_meshing,
        "TetGen meshing",
        source == MeshSource::box || source == MeshSource::blocks || source == MeshSource::surface,
        type,
        "the mesh is given: " + type);
    const bool refine = source == MeshSource::file && has_initial_sizes(scene);
    add(initial_refinement,
        "initial refinement by TetGen",
        refine,
        "the mesh file is refined to Mesh/Volume bound or Size",
        source == MeshSource::file ? "neither Volume bound nor Size is set in Mesh" : type);
  }

  void
  Plan::add_solver_stages(const Scene &scene)
  {
    bool has_temperature = false, expand = false;
    for (const auto &load : scene.loads)
      if (load.type == LoadType::temperature)
        {
          has_temperature = true;
          expand          = expand || expands(scene, load);
        }
    add(thermal_strain,
        "thermal strain",
        expand,
        "a temperature acts on a material that expands",
        has_temperature ? "no material with a temperature expands" : "no load is a temperature");

    const Solver      type  = scene.solver.type;
    const std::string limit = std::to_string(scene.solver.direct_limit) + " unknowns";
    const std::string given = "Solver/Type = " + word(type);
    add(multigrid_solver,
        "multigrid solver",
        type != Solver::direct,
        type == Solver::cg ? given : "systems of more than " + limit,
        given);
    const bool direct
      = type == Solver::direct || (type == Solver::automatic && scene.solver.direct_limit > 0);
    add(direct_solver,
        "direct solver",
        direct,
        type == Solver::direct ? given : "systems of at most " + limit,
        type == Solver::cg ? given : "Solver/Direct limit = 0");
    const std::string formulation = "Formulation = " + word(scene.formulation);
    add(newton_method,
        "Newton's method",
        scene.formulation == Formulation::finite_strain,
        formulation,
        formulation + ": one linear solve");
  }

  void
  Plan::add_reference_stages(const Scene &scene)
  {
    const auto       &reference = scene.reference;
    const std::string user      = user_of_reference(scene);
    const bool        used      = !user.empty() && reference.type != Reference::none;
    const bool        solved    = used && reference.type == Reference::fine_mesh;
    const bool        hexahedra = used && reference.type == Reference::hexahedra;
    const bool        refined   = solved && reference.route == Route::refine;
    const std::string type      = "Reference/Type = " + word(reference.type);
    const std::string absent
      = user.empty() && reference.type != Reference::none ? nothing_uses_it : type;
    add(reference_mesh,
        "reference mesh",
        solved,
        "Reference/Mesh = " + word(reference.route) + ", if it is not in the cache",
        absent);
    add(reference_refinement,
        "reference refinement by TetGen",
        refined,
        "the first mesh is refined to Reference/Volume bound or Size",
        solved ? "Reference/Mesh = " + word(reference.route) : absent);
    add(hexahedral_reference, "hexahedral reference", hexahedra, user, absent);
    add(reference_solution, "reference solution", solved, user, hexahedra ? type : absent);
    add(reference_file,
        "reference from a file",
        used && reference.type == Reference::run,
        user,
        absent);
    add(reference_cache,
        "reference cache",
        (solved || hexahedra) && reference.cache,
        "Reference/Cache = yes",
        solved || hexahedra ? "Reference/Cache = no" : absent);
    add(reference_error,
        "reference's own error",
        used,
        "stated with every error that is measured with it",
        absent);
  }

  void
  Plan::add_error_stages(const Scene &scene)
  {
    const bool        reference   = uses_reference();
    const bool        exact       = scene.exact_solution.has_displacement();
    const std::string energy_user = user_of_extrapolation(scene);
    const std::string ren_user    = user_of_ren(scene);
    const std::string exact_user  = user_of_exact_solution(scene, true);
    const std::string known_user  = user_of_exact_solution(scene, false);
    add(extrapolation,
        "difference to the reference",
        reference && !energy_user.empty(),
        energy_user,
        reference ? nothing_uses_it : "no reference is used");
    add(nodal_ren,
        "relative nodal error REN",
        (reference || exact) && !ren_user.empty(),
        ren_user,
        reference || exact ? nothing_uses_it : "neither a reference nor an exact displacement");
    add(exact_comparison,
        "difference to the exact solution",
        exact && !exact_user.empty(),
        exact_user,
        exact ? nothing_uses_it : "no Exact solution/Displacement is given");
    add(known_energy,
        "error from the known energy",
        scene.exact_solution.has_energy() && !known_user.empty(),
        known_user,
        scene.exact_solution.has_energy() ? nothing_uses_it
                                          : "no Exact solution/Strain energy is given");
  }

  void
  Plan::add_estimation_stages(const Scene &scene)
  {
    std::string names;
    bool        goal    = false;
    const auto  include = [&](const ErrorEstimator which) {
      goal = goal || which == ErrorEstimator::goal;
      if (which != ErrorEstimator::energy && which != ErrorEstimator::ren
          && which != ErrorEstimator::exact)
        names += (names.empty() ? "" : ", ") + word(which);
    };
    const bool drives = is_adaptive(scene) && scene.adaptivity.max_cycles > 1;
    if (drives)
      include(scene.adaptivity.refinement_indicator);
    for (const ErrorEstimator which : scene.estimation.estimators)
      if (!drives || which != scene.adaptivity.refinement_indicator)
        include(which);
    add(estimation,
        "error estimators",
        !names.empty(),
        names,
        "no estimator drives the refinement, and Estimation/Estimators lists none that is needed");
    add(goal_values,
        "goals",
        !scene.goals.empty(),
        std::to_string(scene.goals.size()) + " in Goals",
        "the section Goals is empty");
    add(dual_solution,
        "dual solution",
        goal,
        "the estimator 'goal' needs it",
        "no estimator is about a goal");
  }

  void
  Plan::add_adaptivity_stages(const Scene &scene)
  {
    const auto       &adapt    = scene.adaptivity;
    const std::string strategy = "Adaptivity/Strategy = " + word(adapt.strategy);
    const std::string rule     = "Adaptivity/Marking = " + word(adapt.marking);
    // One cycle ends before anything is refined.
    const bool        refines  = adapt.max_cycles > 1;
    const bool        adaptive = is_adaptive(scene) && refines;
    const bool        uniform  = adapt.strategy == Strategy::uniform && refines;
    const std::string reason
      = !refines && (is_adaptive(scene) || adapt.strategy == Strategy::uniform)
          ? "Adaptivity/Maximum cycles = 1"
          : strategy;
    add(marking,
        "marking",
        adaptive && adapt.marking != Marking::optimal_size,
        rule,
        adaptive ? rule : reason);
    add(sizing, "size field", adaptive, rule, reason);
    add(tetgen_refinement,
        "TetGen refinement",
        adaptive && !adapt.coarsening,
        "Adaptivity/Size control = " + word(adapt.size_control),
        adaptive ? "Adaptivity/Coarsening = yes" : reason);
    add(body_remeshing,
        "meshing the body from scratch",
        adaptive && adapt.coarsening,
        "Adaptivity/Coarsening = yes",
        adaptive ? "Adaptivity/Coarsening = no" : reason);
    const std::string projection = "Mesh/Projection = " + word(scene.mesh.projection);
    add(boundary_projection,
        "projection of the boundary",
        scene.mesh.projection != MeshParameters::Projection::none,
        projection,
        projection);
    add(uniform_refinement, "uniform refinement", uniform, strategy, reason);
  }

  void
  Plan::add_output_stages(const Scene &scene)
  {
    const auto       &output = scene.output;
    const std::string no_vtu = "Output/VTU = no";
    add(stress_recovery,
        "stresses for output",
        output.vtu && output.stress,
        "Output/Stress = yes",
        output.vtu ? "Output/Stress = no" : no_vtu);
    add(vtu_output, ".vtu output", output.vtu, "Output/VTU = yes", no_vtu);
    add(tables, "tables", output.tables, "Output/Tables = yes", "Output/Tables = no");
    add(plots, "plots", output.plots, "Output/Plots = yes", "Output/Plots = no");
    add(size_field_output,
        "size field of the run",
        output.size_field,
        "Output/Size field = yes",
        "Output/Size field = no");
  }

  std::string
  Plan::text() const
  {
    std::size_t width = 0;
    for (const auto &stage : stages)
      width = std::max(width, stage.name.size());
    std::string text;
    for (const bool needed : {true, false})
      {
        text += needed ? "needs\n" : "skips\n";
        for (const auto &stage : stages)
          if (stage.needed == needed)
            text += "  " + stage.name + std::string(width - stage.name.size() + 2, ' ')
                    + stage.reason + '\n';
      }
    return text;
  }
} // namespace tetradapt::scene
