// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/hexahedral_reference.h"

#include "tetradapt/adapt/adaptive_loop.h"
#include "tetradapt/compare/reference_key.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/estimate/calibrated_error.h"
#include "tetradapt/estimate/hexahedral_indicators.h"
#include "tetradapt/solve/hexahedral_system.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace tetradapt::adapt
{
  namespace
  {
    constexpr unsigned int first_cells = 40;   ///< of the first mesh, at least
    constexpr double       most_growth = 2.;   ///< of the cells from mesh to mesh
    constexpr double       closure     = 1.4;  ///< cells cut for each one marked
    constexpr double       algebraic   = 0.03; ///< error of the solver by that of the mesh
    constexpr double       usual_rate  = 0.65; ///< s of errors N^-s, at edges

    class HexahedralLoop : public AdaptiveLoop
    {
    public:
      /** Keeps references to all arguments. */
      HexahedralLoop(const scene::Scene           &scene,
                     const mechanics::MaterialMap &materials,
                     const mesh::TetMesh          &mesh,
                     MPI_Comm                      communicator,
                     const core::Log              &log)
        : scene(scene), materials(materials), mesh(mesh), communicator(communicator), log(log),
          tolerance(compare::hexahedral_tolerance(scene)),
          grid(solve::make_hexahedral_grid(scene, mesh, log)), forest(grid, communicator)
      {
        while (forest.n_cells() < first_cells)
          forest.refine(std::vector<bool>(forest.cells().size(), true));
      }

      compare::Reference
      run()
      {
        const StopDecision decision = run_cycles();
        if (!decision.success)
          log.warning(decision.text);
        compare::Reference reference;
        reference.displacement.hexahedra = solution.displacement;
        reference.energy                 = solution.energy;
        reference.estimated_error        = error;
        if (solution.gain_sign != 0)
          reference.known_energy
            = solution.energy
              + solution.gain_sign * calibrated.value_or(0.) * calibrated.value_or(0.);
        std::ostringstream text;
        text << 'Q' << solution.displacement->degree() << ", " << solution.displacement->n_cells()
             << " hexahedra, " << n_dofs << " unknowns, refined where its error is";
        reference.description = text.str();
        return reference;
      }

    private:
      void
      solve(const unsigned int cycle) override
      {
        const core::Log in_reference = log.with_progress_prefix("reference: ");
        system                       = std::make_unique<solve::HexahedralSystem>(scene,
                                                           materials,
                                                           forest,
                                                           scene.reference.degree);
        n_dofs                       = system->space().n_dofs();
        if (cycle == 0 && n_dofs > scene.reference.max_dofs)
          throw core::InputError(
            "Reference/Maximum unknowns: the coarsest hexahedra of this body have "
            + std::to_string(n_dofs) + " unknowns. Allow more, or use Type = fine mesh.");
        in_reference.progress(std::to_string(n_dofs) + " unknowns on hexahedra");
        solution
          = system->solve(mesh, solution.displacement.get(), solver_error(algebraic), in_reference);
      }

      void
      estimate() override
      {
        indicators = estimate::hexahedral_indicators(system->space(), materials, solution.nodal);
        const double indicator = std::sqrt(dealii::Utilities::MPI::sum(
          std::inner_product(indicators.begin(), indicators.end(), indicators.begin(), 0.),
          communicator));
        levels.push_back({double(n_dofs), solution.gain, indicator});
        calibrated = estimate::calibrated_error(levels);
        estimated.reset();
        if (calibrated)
          estimated = *calibrated * (scene.reference.degree == 2 ? 1.5 : 1.3);
        // Where functions of this degree are the solution, refinement gains nothing.
        else if (indicator < .01 * target())
          estimated = indicator;
        // Too few levels to calibrate by: the indicator, with room.
        error = estimated.value_or(std::min(solution.norm, 3. * indicator));
        report();
      }

      StopDecision
      decide() override
      {
        if (error <= target())
          return {StopReason::tolerance, true, "", {}};
        growth = most_growth;
        // Less where the tolerance is near.
        if (estimated && target() > 0.)
          growth = std::min(growth,
                            std::max(1.3, std::pow(1.1 * *estimated / target(), 1. / usual_rate)));
        if (growth * n_dofs <= scene.reference.max_dofs)
          return {};
        std::ostringstream text;
        text.precision(3);
        text << "Reference/Maximum unknowns stopped the refinement of the reference before its "
                "tolerance: the estimate of its relative energy error is "
             << error / solution.norm << " instead of " << tolerance << '.';
        return {StopReason::max_dofs, false, text.str(), {}};
      }

      StopDecision
      mark() override
      {
        // The cells are not in one list, as a Marker wants them, and those whose indicators differ
        // by rounding are cut together, so that symmetry is kept.
        std::vector<double> all;
        for (const auto &part : dealii::Utilities::MPI::all_gather(communicator, indicators))
          all.insert(all.end(), part.begin(), part.end());
        const auto n
          = std::min(all.size() - 1,
                     static_cast<std::size_t>((growth - 1.) / (7. * closure) * all.size()));
        std::nth_element(all.begin(), all.begin() + n, all.end(), std::greater<>());
        marked.resize(indicators.size());
        for (std::size_t c = 0; c < marked.size(); ++c)
          marked[c] = indicators[c] >= .999 * all[n];
        return {};
      }

      StopDecision
      refine() override
      {
        expect_error(estimated.value_or(0.) * std::pow(growth, -usual_rate));
        system.reset();
        forest.refine(marked);
        return {};
      }

      /** The energy norm that the error is to have. */
      double
      target() const
      {
        return tolerance * solution.norm;
      }

      void
      report() const
      {
        std::ostringstream text;
        text << "Reference on hexahedra: " << forest.n_cells() << " cells, " << n_dofs
             << " unknowns, " << solution.iterations << " iterations, energy ";
        text.precision(10);
        text << solution.energy;
        text.precision(3);
        if (estimated)
          text << ", estimated relative error " << *estimated / solution.norm;
        log.detail(text.str());
      }

      const scene::Scene           &scene;
      const mechanics::MaterialMap &materials;
      const mesh::TetMesh          &mesh;
      MPI_Comm                      communicator;
      const core::Log              &log;
      double                        tolerance;
      solve::HexahedralGrid         grid;
      solve::HexahedralForest       forest;

      std::unique_ptr<solve::HexahedralSystem> system; ///< on the present mesh
      unsigned long                            n_dofs = 0;
      solve::HexahedralSolution                solution;
      std::vector<estimate::NestedSolution>    levels;
      std::vector<double>                      indicators;  ///< of own cells
      std::optional<double>                    calibrated;  ///< error of the last solution
      std::optional<double>                    estimated;   ///< the same with a margin
      double                                   error  = 0.; ///< that, or a guess
      double                                   growth = 0.; ///< wanted of the number of cells
      std::vector<bool>                        marked;      ///< own cells
    };
  } // namespace

  compare::Reference
  make_hexahedral_reference(const scene::Scene           &scene,
                            const mechanics::MaterialMap &materials,
                            const mesh::TetMesh          &mesh,
                            MPI_Comm                      communicator,
                            const core::Log              &log)
  {
    return HexahedralLoop(scene, materials, mesh, communicator, log).run();
  }
} // namespace tetradapt::adapt
