// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/size_field.h"

#include "tetradapt/adapt/size_prediction.h"
#include "tetradapt/mesh/tetgen_request.h"

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>

namespace tetradapt::adapt
{
  using SizeControl = scene::AdaptivityParameters::SizeControl;

  double
  equivalent_edge(const double volume)
  {
    return std::cbrt(6. * std::sqrt(2.) * volume);
  }



  double
  regular_volume(const double edge)
  {
    return edge * edge * edge / (6. * std::sqrt(2.));
  }



  double
  volume_bound_factor(const double q)
  {
    // Measured with TetGen 1.5.0 at q = 1.2, 1.414 and 2: 4, 2.3 and 2.2.
    if (q <= 1.2)
      return 4.;
    if (q <= 1.414)
      return 4. + (2.3 - 4.) * (q - 1.2) / (1.414 - 1.2);
    if (q <= 2.)
      return 2.3 + (2.2 - 2.3) * (q - 1.414) / (2. - 1.414);
    return 2.2;
  }



  namespace
  {
    constexpr double default_growth_slack = 1.5;
  }

  SizeFieldOptions
  make_size_field_options(const scene::AdaptivityParameters &parameters,
                          const scene::TetgenParameters     &tetgen,
                          const unsigned int                 degree,
                          const unsigned long                n_cells)
  {
    SizeFieldOptions options;
    options.size_control
      = parameters.coarsening ? SizeControl::node_sizes : parameters.size_control;
    options.coarsening = parameters.coarsening;
    // Displacements converge one power of h faster than strains.
    options.rate
      = degree
        + (parameters.refinement_indicator == scene::AdaptivityParameters::RefinementIndicator::ren
             ? 1.
             : 0.);
    options.wanted_tets  = parameters.growth * n_cells;
    options.growth_slack = default_growth_slack;
    if (parameters.max_tets > 0 && default_growth_slack * options.wanted_tets > parameters.max_tets)
      {
        options.wanted_tets  = std::min<double>(options.wanted_tets, parameters.max_tets);
        options.growth_slack = 1.;
      }
    options.min_ratio         = parameters.min_ratio;
    options.max_ratio         = parameters.max_ratio;
    options.min_size          = parameters.min_size;
    options.max_size          = parameters.max_size;
    options.gradation         = parameters.gradation;
    options.reduction         = parameters.reduction;
    options.radius_edge_ratio = tetgen.radius_edge_ratio;
    return options;
  }



  double
  next_obtained_over_predicted(const SizeField &field, const unsigned long obtained)
  {
    if (!(field.predicted_tets > 0.))
      return 0.;
    return std::clamp(field.obtained_over_predicted * obtained / field.predicted_tets, 0.5, 3.);
  }



  double
  next_reduction_power(const double predicted, const double obtained, const double last)
  {
    if (!(predicted > 0.) || !(predicted < 0.8) || !(obtained > 0.))
      return last;
    return std::clamp(std::log(obtained) / std::log(predicted), 0.3, 1.2);
  }



  double
  default_obtained_over_predicted(const SizeFieldOptions &options)
  {
    // Measured with TetGen 1.5.0: on meshes made from scratch 1.3 to 1.6; over some hundred cycles
    // of refinement, growth 2 to 4, on fields with singular edges and layers, 1.3 to 1.9
    // with node sizes and 0.9 to 1.5 with volume constraints.
    if (options.coarsening)
      return 1.45;
    return options.size_control == SizeControl::node_sizes ? 1.5 : 1.2;
  }



  namespace
  {
    /** For points without a cell; finite, as TetGen wants it. */
    constexpr double no_size = 1e100;

    /** Where in [@p low, @p high] the falling function @p f is zero, or the end
     * where it comes nearest to zero if it is not. */
    template <class Function>
    double
    find_zero(const Function &f, const double low, const double high, const double start)
    {
      constexpr double accuracy = 1e-3; // of log h: 0.3 % of the tetrahedra
      double           a = std::clamp(start, low, high), f_a = f(a), step = 0.1;
      while (f_a != 0.)
        {
          const double b = std::clamp(f_a > 0. ? a + step : a - step, low, high);
          if (b == a)
            break;
          const double f_b = f(b);
          if (f_b != 0. && std::signbit(f_b) != std::signbit(f_a))
            {
              std::uintmax_t n_iterations = 50;
              const auto     bracket      = boost::math::tools::toms748_solve(
                f,
                std::min(a, b),
                std::max(a, b),
                std::max(f_a, f_b),
                std::min(f_a, f_b),
                [](const double x, const double y) { return std::abs(x - y) < accuracy; },
                n_iterations);
              return 0.5 * (bracket.first + bracket.second);
            }
          a   = b;
          f_a = f_b;
          step *= 2.;
        }
      return a;
    }



    /** The circumradius of a cell: TetGen splits a cell when it is larger than
     * the size it was given at one of the vertices. */
    double
    circumradius(const mesh::TetMesh &mesh, const unsigned int c)
    {
      const auto              &v  = mesh.cells[c];
      const mesh::Tensor<1, 3> a  = mesh.points[v[1]] - mesh.points[v[0]];
      const mesh::Tensor<1, 3> b  = mesh.points[v[2]] - mesh.points[v[0]];
      const mesh::Tensor<1, 3> d  = mesh.points[v[3]] - mesh.points[v[0]];
      const mesh::Tensor<1, 3> bd = dealii::cross_product_3d(b, d);
      const mesh::Tensor<1, 3> center
        = (a.norm_square() * bd + b.norm_square() * dealii::cross_product_3d(d, a)
           + d.norm_square() * dealii::cross_product_3d(a, b))
          / (2. * (a * bd));
      return center.norm();
    }
  } // namespace



  namespace
  {
    /** Whether as many more tetrahedra as options.growth_slack allows may reach the goal. */
    bool
    is_near(const double error, const double goal, const SizeFieldOptions &options)
    {
      const double power = options.rate * std::max(options.reduction_power, 1.) / 3.;
      return options.growth_slack > 1.
             && error * std::pow(options.growth_slack, -2. * power) < goal;
    }
  } // namespace



  SizeField
  optimal_size_field(const mesh::TetMesh       &mesh,
                     const std::vector<double> &indicators,
                     const SizeFieldOptions    &options,
                     const mesh::EdgeTable     *edges)
  {
    check_indicators(indicators, mesh);
    if (std::all_of(indicators.begin(), indicators.end(), [](const double e) { return e == 0.; }))
      {
        // Nothing to refine, and no scale to find.
        SizeField field;
        field.predicted_tets = mesh.n_cells();
        return field;
      }
    mesh::EdgeTable own_edges;
    if (edges == nullptr && options.gradation > 0.)
      own_edges = mesh::build_edges(mesh);
    SizePrediction prediction(mesh, indicators, options, edges != nullptr ? *edges : own_edges);

    const auto scale_for = [&](const double n_tets, const double start) {
      return find_zero(
        [&](const double x) {
          prediction.set_scale(x);
          return std::log(prediction.n_tets() / n_tets);
        },
        prediction.lowest(),
        prediction.highest(),
        start);
    };
    double log_scale = scale_for(options.wanted_tets, prediction.guess(options.wanted_tets));
    prediction.set_scale(log_scale);

    const double goal            = options.tolerance_safety * options.tolerance;
    bool         tolerance_bound = prediction.error() < goal;
    if (!tolerance_bound && is_near(prediction.error(), goal, options))
      {
        const double larger = scale_for(options.growth_slack * options.wanted_tets, log_scale - .1);
        prediction.set_scale(larger);
        tolerance_bound = prediction.error() < goal;
        if (tolerance_bound)
          log_scale = larger;
        else
          prediction.set_scale(log_scale);
      }
    if (tolerance_bound)
      {
        const double smallest = std::min(options.wanted_tets, options.min_growth * mesh.n_cells());
        log_scale             = find_zero(
          [&](const double x) {
            prediction.set_scale(x);
            return std::min(std::log(goal / prediction.error()),
                            std::log(prediction.n_tets() / smallest));
          },
          prediction.lowest(),
          prediction.highest(),
          log_scale);
        prediction.set_scale(log_scale);
      }
    SizeField field       = prediction.field();
    field.tolerance_bound = tolerance_bound;
    return field;
  }



  SizeField
  marked_size_field(const mesh::TetMesh    &mesh,
                    const Marking          &marking,
                    const SizeFieldOptions &options)
  {
    std::vector<bool> marked(mesh.n_cells(), false);
    for (const unsigned int c : marking.cells)
      marked[c] = true;

    const double        bound = volume_bound_factor(options.radius_edge_ratio);
    SizeField           field;
    std::vector<double> cell_volumes(mesh.n_cells(), 0.);
    // Around every point: volume, volume times log of the size, whether a cell is
    // refined, and the size at which TetGen would leave all cells alone.
    std::vector<double> volumes(mesh.n_points(), 0.), logs(mesh.n_points(), 0.);
    std::vector<double> kept_sizes(mesh.n_points(), 0.);
    std::vector<bool>   refined(mesh.n_points(), false);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const double volume = mesh::cell_volume(mesh, c);
        const double size   = equivalent_edge(volume);
        const bool   refine = marked[c] && options.reduction * size >= options.min_size;
        const double wanted = refine ? options.reduction * size : size;
        field.n_refined += refine ? 1 : 0;
        field.n_clamped += marked[c] && !refine ? 1 : 0;
        field.predicted_tets += refine ? std::pow(options.reduction, -3.) : 1.;
        cell_volumes[c] = refine ? bound * regular_volume(wanted) : 0.;

        const double kept = 1.001 * circumradius(mesh, c) / mesh::tetgen_size_factor;
        for (const unsigned int v : mesh.cells[c])
          {
            volumes[v] += volume;
            logs[v] += volume * std::log(wanted);
            refined[v]    = refined[v] || refine;
            kept_sizes[v] = std::max(kept_sizes[v], kept);
          }
      }
    field.node_sizes.assign(mesh.n_points(), no_size);
    for (unsigned int p = 0; p < mesh.n_points(); ++p)
      if (volumes[p] > 0.)
        field.node_sizes[p]
          = refined[p] || options.coarsening ? std::exp(logs[p] / volumes[p]) : kept_sizes[p];
    // A mesh made from scratch has more cells than the sizes of the old one have on average.
    if (options.coarsening)
      for (double &size : field.node_sizes)
        size *= std::cbrt(default_obtained_over_predicted(options));

    if (field.n_refined > 0 && options.size_control == SizeControl::node_sizes)
      field.sizing.node_sizes = field.node_sizes;
    else if (field.n_refined > 0)
      field.sizing.cell_volumes = std::move(cell_volumes);
    return field;
  }
} // namespace tetradapt::adapt
