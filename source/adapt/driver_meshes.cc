// SPDX-License-Identifier: AGPL-3.0-or-later
// The part of the driver that makes one mesh from another.
#include "tetradapt/adapt/driver.h"
#include "tetradapt/compare/root_of_squares.h"
#include "tetradapt/compare/transfer.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::adapt
{
  namespace
  {
    using scene::Plan;
    using Adaptivity = scene::AdaptivityParameters;

    /** The same rule, marking more: for a second attempt. */
    Adaptivity
    stronger(Adaptivity parameters)
    {
      parameters.coarsening = false;
      parameters.growth *= 2.;
      parameters.theta    = 0.5 * (1. + parameters.theta);
      parameters.fraction = std::min(1., 2. * parameters.fraction);
      parameters.lambda *= 0.5;
      return parameters;
    }

    /** The factor by which the error falls: as the size field predicts, but not less than
     * the number of tetrahedra leads one to expect. */
    double
    predicted_factor(const std::vector<double> &indicators,
                     const SizeField           &field,
                     double                     growth,
                     unsigned int               degree)
    {
      const double by_number = std::min(1., std::pow(growth, -(degree / 3.)));
      return field.predicted_error > 0.
               ? std::min(by_number, field.predicted_error / compare::root_of_squares(indicators))
               : by_number;
    }

  } // namespace

  void
  Driver::use(NewMesh made)
  {
    current = std::move(made);
    mesh    = current.mesh;
  }

  StopDecision
  Driver::mark()
  {
    return n_rejected > 0 ? mark_rejected(*accepted) : mark_accepted(*accepted);
  }

  StopDecision
  Driver::refine()
  {
    StopDecision decision;
    if (n_rejected > 1)
      refine_uniformly(*accepted);
    else
      decision = next_mesh(*accepted);
    // What a rejection needs, and no more.
    if (!is_tested)
      accepted.reset();
    else
      {
        accepted->solution.displacement.reset();
        if (before == nullptr)
          accepted->comparison->reduce_to_displacement();
      }
    return decision;
  }

  StopDecision
  Driver::next_mesh(Cycle &cycle)
  {
    switch (scene.adaptivity.strategy)
      {
      case Adaptivity::Strategy::none:
        return decide_new_mesh(mesh->n_cells(), mesh->n_cells());
      case Adaptivity::Strategy::mesh_list:
        make_initial_mesh(cycle.record.cycle + 1);
        return {};
      case Adaptivity::Strategy::uniform:
        refine_uniformly(cycle);
        return {};
      case Adaptivity::Strategy::adaptive:
        return adapt_mesh(cycle);
      }
    return {};
  }

  void
  Driver::predict_error(const CycleRecord &record, const double factor)
  {
    expect_error(record.energy_error.value_or(record.estimate.value_or(0.)) * factor);
  }

  void
  Driver::refine_uniformly(Cycle &cycle)
  {
    {
      const auto scope = timer.scope("mesh");
      use(mesh_maker.uniform(*mesh, cycle.comparison->edges()));
    }
    predicted_reduction = 0.;
    predict_error(cycle.record, std::pow(0.5, scene.degree));
    prepare_start(cycle);
  }

  SizeField
  Driver::make_size_field(const Cycle &cycle, const bool more) const
  {
    const Adaptivity parameters = more ? stronger(scene.adaptivity) : scene.adaptivity;
    SizeFieldOptions options
      = make_size_field_options(parameters, scene.tetgen, scene.degree, mesh->n_cells());
    if (const auto marker = make_marker(parameters))
      return marked_size_field(*mesh, marker->mark(cycle.indicators, *mesh), options);
    options.obtained_over_predicted = obtained_over_predicted;
    options.reduction_power         = reduction_power;
    if (!more)
      options.tolerance = cycle.wanted_indicator_norm;
    return optimal_size_field(*mesh, cycle.indicators, options, cycle.comparison->edges());
  }

  void
  Driver::refine_mesh(Cycle &cycle, const bool from_scratch)
  {
    const unsigned int           old_tets = mesh->n_cells();
    const compare::PointLocator &locator  = cycle.comparison->locator();
    predicted_reduction                   = sizes.predicted_reduction;
    predicted_from                        = compare::root_of_squares(cycle.indicators);
    if (from_scratch)
      {
        const mesh::EdgeTable *edges = cycle.comparison->edges();
        use(mesh_maker.made_from_scratch(
          *mesh, sizes, locator, edges != nullptr ? *edges : mesh::build_edges(*mesh)));
      }
    else
      use(mesh_maker.refined(*mesh, sizes, locator));
    std::ostringstream text;
    text << (from_scratch ? "Made from scratch" : "Refined") << " from " << old_tets << " to "
         << mesh->n_cells() << " tetrahedra (" << std::lround(sizes.predicted_tets)
         << " predicted): " << describe_mesh(*mesh, current.record);
    log.detail(text.str());
  }

  StopDecision
  Driver::mark_accepted(Cycle &cycle)
  {
    if (scene.adaptivity.strategy != Adaptivity::Strategy::adaptive)
      return {};
    if (predicted_reduction > 0.)
      reduction_power
        = next_reduction_power(predicted_reduction,
                               compare::root_of_squares(cycle.indicators) / predicted_from,
                               reduction_power);
    {
      const auto scope = timer.scope("marking");
      in_cycle(cycle.record.cycle).progress("marking and sizing");
      sizes = make_size_field(cycle, false);
    }
    const double largest = *std::max_element(cycle.indicators.begin(), cycle.indicators.end());
    // Below this an error is rounding, and refining would chase noise.
    const bool is_exact = relative_error_or_estimate(cycle.record).value_or(1.) < 1e-10;
    if (largest == 0. || is_exact || sizes.n_refined == 0)
      return decide_nothing_to_refine(is_exact ? 0. : largest);
    return {};
  }

  StopDecision
  Driver::adapt_mesh(Cycle &cycle)
  {
    const auto         old_mesh = mesh;
    const unsigned int old_tets = mesh->n_cells();
    // What is made in the place of a rejected mesh tells nothing of how TetGen follows sizes.
    const bool is_first     = n_rejected == 0;
    const bool from_scratch = is_first && plan.needs(Plan::body_remeshing);
    const bool can_insist
      = is_first && scene.adaptivity.marking == Adaptivity::Marking::optimal_size;
    for (unsigned int attempt = 0; attempt < 4; ++attempt)
      {
        {
          const auto scope = timer.scope("mesh");
          refine_mesh(cycle, from_scratch);
        }
        if (mesh->n_cells() != old_tets || !can_insist || from_scratch)
          break;
        // Sizes that are just not below what TetGen would split change nothing: the
        // factor, learned from a few cells, was too large.
        mesh                    = old_mesh;
        obtained_over_predicted = 0.5 * sizes.obtained_over_predicted;
        const auto scope        = timer.scope("marking");
        sizes                   = make_size_field(cycle, false);
      }
    if (is_first)
      obtained_over_predicted = next_obtained_over_predicted(sizes, mesh->n_cells());
    predict_error(cycle.record,
                  predicted_factor(cycle.indicators,
                                   sizes,
                                   static_cast<double>(mesh->n_cells()) / old_tets,
                                   scene.degree));
    prepare_start(cycle);
    return from_scratch || !is_first ? StopDecision() : decide_new_mesh(old_tets, mesh->n_cells());
  }

  StopDecision
  Driver::mark_rejected(Cycle &cycle)
  {
    // The displacement of the last accepted cycle is still there.
    mesh                    = cycle.comparison->shared_mesh();
    const std::string where = "Back to the " + std::to_string(mesh->n_cells())
                              + " tetrahedra of cycle " + std::to_string(cycle.record.cycle) + ", ";
    if (n_rejected == 1)
      {
        log.info(where + "refined more strongly.");
        const auto scope = timer.scope("marking");
        sizes            = make_size_field(cycle, true);
        return {};
      }
    const StopDecision decision = decide_uniform_fallback(scene.adaptivity, cycle.record);
    if (!decision.stop())
      log.info(where + "each cut into eight.");
    return decision;
  }

  void
  Driver::prepare_start(const Cycle &cycle)
  {
    // A small linear system is factorised, without a first iterate.
    if (plan.needs(Plan::multigrid_solver) || plan.needs(Plan::newton_method))
      before = cycle.comparison;
  }

  std::shared_ptr<const fem::Field>
  Driver::make_start(const solve::StaticSystem &system)
  {
    if (before == nullptr)
      return nullptr;
    auto start = compare::interpolate(before->displacement(),
                                      before->locator(),
                                      system.space(),
                                      system.pressure_space());
    // An accepted cycle may still have it, in case that the new mesh is rejected.
    before->reduce_to_displacement();
    before.reset();
    return start;
  }
} // namespace tetradapt::adapt
