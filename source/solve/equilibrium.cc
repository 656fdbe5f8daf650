// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/equilibrium.h"

#include "tetradapt/mechanics/reactions.h"
#include "tetradapt/scene/words.h"
#include "tetradapt/solve/static_solution.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tetradapt::solve
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;

    /** More than this of all forces leaves reactions of less than four digits. */
    constexpr double largest_imbalance = 1e-4;

    /** What rounding leaves, also of a factorisation, in bodies of very different stiffness or
     * far from the origin. */
    constexpr double rounding = 1e-8;

    /** Whether the solver may have ended before its tolerance, by the error of the solution. */
    bool
    is_unfinished(const LoadedSystem &system, const StaticSolution &solution)
    {
      if (system.internal_forces != nullptr)
        return false; // Newton's method ends by its tolerance
      return system.scene.solver.stopping == scene::SolverParameters::Stopping::discretisation
             || solution.iterations < solution.iterations_to_tolerance;
    }

    /** Sum of forces on the nodes, and of their lengths. */
    struct NodalSum
    {
      mechanics::Resultant resultant;
      double               magnitude = 0.;
    };

    NodalSum
    sum_of(const LoadedSystem &system, const fem::Field &displacement)
    {
      NodalSum sum;
      for (unsigned int node = 0; node < system.space.n_owned_nodes(); ++node)
        {
          Tensor<1, 3> force;
          for (unsigned int c = 0; c < 3; ++c)
            force[c] = system.forces.local_element(3 * node + c);
          if (force == Tensor<1, 3>())
            continue;
          Point<3> x = system.space.node_position(node);
          if (system.internal_forces != nullptr)
            x += displacement.value(node);
          sum.resultant.add(x, force);
          sum.magnitude += force.norm();
        }
      const MPI_Comm communicator = system.space.communicator();
      return {mechanics::sum(sum.resultant, communicator),
              dealii::Utilities::MPI::sum(sum.magnitude, communicator)};
    }

    void
    list_forces(const LoadedSystem                          &system,
                const mechanics::Reactions                  &reactions,
                const mechanics::SpringForces               &springs,
                const std::vector<mechanics::RegionFigures> &regions,
                Equilibrium                                 &result)
    {
      const scene::Scene           &scene = system.scene;
      const mesh::TetMesh          &mesh  = system.space.tet_mesh();
      const mechanics::PatchExtents patches(mesh);
      for (unsigned int s = 0; s < scene.supports.size(); ++s)
        {
          const std::string &name   = scene.supports[s].name;
          mechanics::Extent  extent = patches.of("Supports/" + name);
          extent.n_nodes            = reactions.n_nodes[s];
          const bool is_spring      = scene.supports[s].type == scene::SupportType::spring;
          result.supports.push_back({name,
                                     is_spring ? scene::word(scene.supports[s].type) : "support",
                                     is_spring ? springs.supports[s] : reactions.supports[s],
                                     extent});
        }
      for (unsigned int l = 0; l < scene.loads.size(); ++l)
        {
          const scene::LoadParameters &load   = scene.loads[l];
          mechanics::Extent            extent = mechanics::acts_on_body(load.type)
                                                  ? mechanics::body_extent(load, mesh, regions)
                                                  : patches.of("Loads/" + load.name);
          if (load.type == scene::LoadType::point_force)
            extent.n_nodes = 1;
          result.loads.push_back({load.name, scene::word(load.type), system.loads[l], extent});
        }
    }

    /** Lists reference points and what acts on them. */
    void
    list_reference_points(const LoadedSystem &system,
                          const fem::Field   &displacement,
                          Equilibrium        &result)
    {
      const mechanics::PatchExtents patches(system.space.tet_mesh());
      for (const mechanics::RigidCoupling &coupling : system.prescribed.rigid)
        {
          const auto    &parameters = system.scene.supports[coupling.support];
          const auto    &reaction   = result.supports[coupling.support].resultant;
          ReferencePoint point;
          point.name                          = parameters.name;
          point.point                         = coupling.reference;
          point.motion                        = coupling.motion_of(displacement);
          point.reaction.force                = reaction.force;
          point.reaction.moment               = reaction.moment_about(coupling.reference);
          std::tie(point.force, point.moment) = mechanics::reference_forces(parameters);
          if (point.force.norm_square() + point.moment.norm_square() > 0.)
            {
              ActingForce acting{parameters.name,
                                 "reference point",
                                 {},
                                 patches.of("Supports/" + parameters.name)};
              acting.resultant.add(coupling.reference, point.force);
              acting.resultant.moment += point.moment;
              result.loads.push_back(acting);
            }
          result.reference_points.push_back(point);
        }
    }

    /** Counts the springs among what reactions say of all supports. Where nodes that the springs
     * have are also held, the layer's energy is taken too large. */
    void
    add_springs(const LoadedSystem            &system,
                const mechanics::SpringForces &springs,
                mechanics::Reactions          &reactions)
    {
      reactions.magnitude += springs.magnitude;
      for (const auto &face : system.springs.faces())
        for (const auto &point : face.points)
          for (unsigned int c = 0; c < 3; ++c)
            reactions.layer_energy[c] += point.weight * point.stiffness[c][c];
    }

    /** Fills everything but the lists and the imbalance. */
    void
    judge(const LoadedSystem         &system,
          const StaticSolution       &solution,
          const mechanics::Reactions &reactions,
          const double                load_magnitude,
          Equilibrium                &result)
    {
      const auto [lower, upper] = mesh::bounding_box(system.space.tet_mesh());
      const Point<3> centre     = lower + 0.5 * (upper - lower);
      const double   tolerance  = std::max(system.scene.solver.tolerance, rounding);
      result.lever              = 0.5 * (upper - lower).norm();
      result.force_scale        = load_magnitude + reactions.magnitude;
      if (result.force_scale <= 10. * tolerance * solution.load_magnitude)
        result.force_scale = solution.load_magnitude;
      if (result.force_scale == 0.)
        return;
      result.relative_imbalance
        = std::max(result.imbalance.force.norm(),
                   result.imbalance.moment_about(centre).norm() / result.lever)
          / result.force_scale;
      const auto  &layer = reactions.layer_energy;
      const double left  = solution.algebraic_error * std::sqrt(layer[0] + layer[1] + layer[2]);
      result.allowed_imbalance
        = std::max(tolerance * std::max(1., solution.load_magnitude / result.force_scale),
                   left / result.force_scale);
      if (!is_unfinished(system, solution))
        result.allowed_imbalance = std::min(result.allowed_imbalance, largest_imbalance);
    }
  } // namespace

  Equilibrium
  compute_equilibrium(const LoadedSystem                          &system,
                      const StaticSolution                        &solution,
                      const std::vector<mechanics::RegionFigures> &regions)
  {
    const mechanics::SpringForces springs
      = mechanics::spring_forces(system.springs, *solution.displacement);
    fem::Vector loads_and_springs;
    if (!system.springs.empty())
      {
        loads_and_springs = system.forces;
        loads_and_springs += springs.nodal;
      }
    mechanics::Reactions reactions
      = mechanics::compute_reactions(system.materials,
                                     system.prescribed,
                                     system.springs.empty() ? system.forces : loads_and_springs,
                                     system.internal_forces,
                                     *solution.displacement,
                                     system.scene.supports.size(),
                                     is_unfinished(system, solution));
    add_springs(system, springs, reactions);
    Equilibrium    result;
    const NodalSum loads = sum_of(system, *solution.displacement);
    list_forces(system, reactions, springs, regions, result);
    list_reference_points(system, *solution.displacement, result);
    result.imbalance = loads.resultant;
    for (const ActingForce &support : result.supports)
      result.imbalance += support.resultant;
    judge(system, solution, reactions, loads.magnitude, result);
    return result;
  }
} // namespace tetradapt::solve
