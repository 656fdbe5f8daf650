// SPDX-License-Identifier: AGPL-3.0-or-later
// Size fields where the answer is known: uniform errors, errors that fall
// geometrically, tolerances, clamps, marked cells; and a loop without TetGen
// whose prediction can be checked against the next mesh.

#include "tetradapt/adapt/size_field.h"

#include "tetradapt/adapt/stopping.h"
#include "tetradapt/mesh/bricks.h"

#include <algorithm>
#include <cmath>
#include <iostream>

using namespace tetradapt;
using SizeControl = scene::AdaptivityParameters::SizeControl;

/** All cells of these meshes have the same volume. */
mesh::TetMesh
cube(const unsigned int n)
{
  return mesh::bricks({0., 0., 0.}, {1., 1., 1.}, {{n, n, n}});
}

adapt::SizeFieldOptions
plain_options(const double wanted_tets)
{
  adapt::SizeFieldOptions options;
  options.wanted_tets             = wanted_tets;
  options.obtained_over_predicted = 1.;
  options.gradation               = 0.;
  options.min_ratio               = 0.01;
  options.max_ratio               = 100.;
  return options;
}

void
print_range(const std::string &label, const std::vector<double> &values, const double unit)
{
  const auto range = std::minmax_element(values.begin(), values.end());
  std::cout << label << ": " << *range.first / unit << " to " << *range.second / unit << '\n';
}

/** Whether a and b agree to the relative accuracy of the search for the scale. */
bool
close(const double a, const double b, const double tolerance = 4e-3)
{
  return std::abs(a / b - 1.) < tolerance;
}

void
conversions()
{
  std::cout << "edge of regular tetrahedron, there and back: "
            << adapt::equivalent_edge(adapt::regular_volume(0.37)) << '\n'
            << "volume for edge 1: " << adapt::regular_volume(1.) << '\n';
  for (const double q : {1.1, 1.2, 1.307, 1.414, 1.707, 2., 3.})
    std::cout << "bound factor at q = " << q << ": " << adapt::volume_bound_factor(q) << '\n';
}

void
uniform_error()
{
  const auto                mesh = cube(3);
  const double              n    = mesh.n_cells();
  const double              h    = adapt::equivalent_edge(1. / n);
  const std::vector<double> e(mesh.n_cells(), 2.);
  for (const auto nodal : {adapt::NodalSize::minimum, adapt::NodalSize::geometric_mean})
    {
      auto options       = plain_options(8. * n);
      options.nodal_size = nodal;
      const auto field   = adapt::optimal_size_field(mesh, e, options);
      std::cout << "halved: " << close(field.sizing.node_sizes.front(), 0.5 * h)
                << close(field.sizing.node_sizes.back(), 0.5 * h)
                << close(field.predicted_tets, 8. * n)
                << close(field.predicted_error, 0.5 * 2. * std::sqrt(n)) << ", refined "
                << field.n_refined << ", clamped " << field.n_clamped << '\n';
    }
  auto options         = plain_options(8. * n);
  options.size_control = SizeControl::volume_constraints;
  auto field           = adapt::optimal_size_field(mesh, e, options);
  std::cout << "volume bounds: " << field.sizing.node_sizes.empty()
            << close(field.sizing.cell_volumes.front(), 2.3 / 8. / n) << '\n';

  options.wanted_tets = 0.5 * n;
  field               = adapt::optimal_size_field(mesh, e, options);
  std::cout << "fewer cells wanted: refined " << field.n_refined << ", sizes "
            << field.sizing.cell_volumes.size() << ", tets " << field.predicted_tets / n << '\n';

  options           = plain_options(1e9);
  options.min_ratio = 1. / 3.;
  field             = adapt::optimal_size_field(mesh, e, options);
  std::cout << "clamped at a third: tets " << field.predicted_tets / n << ", clamped "
            << field.n_clamped << '\n';

  options          = plain_options(100. * n);
  options.min_size = 0.7 * h;
  field            = adapt::optimal_size_field(mesh, e, options);
  print_range("smallest size 0.7", field.sizing.node_sizes, h);

  options          = plain_options(n);
  options.max_size = 0.9 * h;
  field            = adapt::optimal_size_field(mesh, e, options);
  print_range("largest size 0.9", field.sizing.node_sizes, h);

  options                         = plain_options(8. * n);
  options.obtained_over_predicted = 1.5;
  field                           = adapt::optimal_size_field(mesh, e, options);
  std::cout << "with factor 1.5: "
            << close(field.sizing.node_sizes.front(), h * std::cbrt(1.5 / 8.));
  field.predicted_tets = 1000.;
  std::cout << ", next " << adapt::next_obtained_over_predicted(field, 1200) << ", limited to "
            << adapt::next_obtained_over_predicted(field, 100000) << '\n';
}

/** Errors that fall by 10^-k from brick to brick, equal within a brick: sizes at
 * the nodes between two bricks are the mean of the logarithms, so they rise by
 * 10^(2k/(2p+3)) from plane to plane, exactly. */
void
geometric_error()
{
  const unsigned int  n    = 10;
  const double        k    = 0.25;
  const auto          mesh = mesh::bricks({0., 0., 0.}, {1. * n, 1., 1.}, {{n, 1, 1}});
  std::vector<double> e(mesh.n_cells());
  for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    e[c] = std::pow(10., -k * (c / 6));
  for (const double order : {1., 2.})
    {
      auto options     = plain_options(50. * mesh.n_cells());
      options.order    = order;
      const auto field = adapt::optimal_size_field(mesh, e, options);
      std::cout << "order " << order << ", log10 of growth from plane to plane, times (2p+3)/2k:";
      for (unsigned int x = 1; x + 1 < n; ++x)
        std::cout << ' '
                  << std::log10(field.node_sizes[x + 1] / field.node_sizes[x]) * (2. * order + 3.)
                       / (2. * k);
      std::cout << "; tets met " << close(field.predicted_tets, options.wanted_tets) << '\n';
    }
  // The same errors in other units lead to the same sizes.
  const auto field = adapt::optimal_size_field(mesh, e, plain_options(50. * mesh.n_cells()));
  for (double &value : e)
    value *= 1e-180;
  const auto tiny = adapt::optimal_size_field(mesh, e, plain_options(50. * mesh.n_cells()));
  std::cout << "other unit: " << close(tiny.node_sizes[3], field.node_sizes[3])
            << close(tiny.predicted_error, 1e-180 * field.predicted_error) << '\n';
}

/** Clamps, gradation and zeros at once: the prediction still meets the number,
 * and is what the sizes say. */
void
everything_at_once()
{
  const auto          mesh  = mesh::bricks({0., 0., 0.}, {3., 2., 1.}, {{9, 6, 3}});
  const auto          edges = mesh::build_edges(mesh);
  std::vector<double> e(mesh.n_cells());
  unsigned long       seed = 5;
  for (double &value : e)
    {
      seed  = (seed * 1103515245ul + 12345ul) % 2147483648ul;
      value = seed % 3 == 0 ? 0. : std::pow(10., -3. * (seed / 2147483648.));
    }
  for (const double growth : {1.3, 3., 8.})
    {
      adapt::SizeFieldOptions options; // with its clamps
      options.wanted_tets     = growth * mesh.n_cells();
      options.gradation       = 0.2;
      const auto   field      = adapt::optimal_size_field(mesh, e, options, &edges);
      unsigned int n_violated = 0;
      for (const auto &edge : edges.edges)
        if (std::abs(field.node_sizes[edge[0]] - field.node_sizes[edge[1]])
            > 0.2000001 * mesh.points[edge[0]].distance(mesh.points[edge[1]]))
          ++n_violated;
      std::cout << "growth " << growth << ": met "
                << close(field.predicted_tets, options.wanted_tets) << ", graded "
                << (field.n_graded > 0) << ", violated edges " << n_violated << ", factor "
                << field.obtained_over_predicted << '\n';
    }
  const auto none
    = adapt::optimal_size_field(mesh, std::vector<double>(mesh.n_cells(), 0.), plain_options(1e4));
  std::cout << "no error: refined " << none.n_refined << ", sizes " << none.sizing.node_sizes.size()
            << ", tets " << none.predicted_tets / mesh.n_cells() << '\n';
}

void
tolerance()
{
  const auto                mesh  = cube(3);
  const double              n     = mesh.n_cells();
  const double              error = std::sqrt(n);
  const std::vector<double> e(mesh.n_cells(), 1.);
  auto                      options = plain_options(8. * n);
  // What is aimed at is 0.95 of the tolerance: two thirds of the error need 1.5^3
  // times the cells, a quarter more than is wanted, 0.99 the smallest growth.
  for (const double part : {2. / 3., 0.25, 0.99})
    {
      options.tolerance = part * error / 0.95;
      const auto field  = adapt::optimal_size_field(mesh, e, options);
      std::cout << "to " << part << ": decided by it " << field.tolerance_bound << ", growth "
                << close(field.predicted_tets / n,
                         part == 0.25   ? 8.
                         : part == 0.99 ? 1.25
                                        : 3.375)
                << ", error "
                << close(field.predicted_error / error,
                         part == 0.25   ? 0.5
                         : part == 0.99 ? std::pow(1.25, -1. / 3.)
                                        : part)
                << '\n';
    }
  // If the last cycle's error fell with half the power that was predicted, the same
  // needs the square of the growth: 0.8^-6 = 3.8 for 0.8; and 0.45 needs 0.45^-3 = 11 times
  // as many where 8 are wanted, which a slack of 1.5 allows.
  options.tolerance       = 0.8 * error / 0.95;
  options.reduction_power = 0.5;
  auto field              = adapt::optimal_size_field(mesh, e, options);
  std::cout << "half the power: growth " << close(field.predicted_tets / n, std::pow(0.8, -6.))
            << ", error " << close(field.predicted_error / error, 0.8) << ", predicted "
            << close(field.predicted_reduction, 0.64) << '\n';
  options.reduction_power = 1.;
  options.tolerance       = 0.45 * error / 0.95;
  for (const double slack : {1., 1.3, 1.5})
    {
      options.growth_slack = slack;
      field                = adapt::optimal_size_field(mesh, e, options);
      std::cout << "slack " << slack << ": decided by it " << field.tolerance_bound << ", growth "
                << close(field.predicted_tets / n, slack < 1.4 ? 8. : std::pow(0.45, -3.)) << '\n';
    }
  std::cout << "power after 0.25 instead of 0.5: " << adapt::next_reduction_power(0.5, 0.25, 0.7)
            << ", 0.5 instead of 0.25: " << adapt::next_reduction_power(0.25, 0.5, 0.7)
            << ", a larger error: " << adapt::next_reduction_power(0.25, 2., 0.7)
            << ", a small step: " << adapt::next_reduction_power(0.9, 0.99, 0.7) << '\n';
}

void
marked()
{
  const auto     mesh = cube(3);
  const double   h    = adapt::equivalent_edge(1. / mesh.n_cells());
  adapt::Marking marking;
  for (unsigned int c = 0; c < 6; ++c) // the brick at the origin
    marking.cells.push_back(c);
  auto options      = plain_options(0.);
  options.reduction = 0.6;
  auto field        = adapt::marked_size_field(mesh, marking, options);
  // Point 0 has marked cells only, point 3 none; a brick's body diagonal d is the
  // diameter of the sphere around all its cells.
  std::cout << "marked: refined " << field.n_refined << ", tets "
            << (field.predicted_tets - mesh.n_cells()) / 6. + 1. << " a cell, at the corner "
            << field.sizing.node_sizes[0] / h << ", untouched "
            << field.sizing.node_sizes[3] * 0.83 / (std::sqrt(3.) / 6.) << '\n';
  options.size_control = SizeControl::volume_constraints;
  field                = adapt::marked_size_field(mesh, marking, options);
  std::cout << "bounds " << field.sizing.cell_volumes[5] * mesh.n_cells() << ' '
            << field.sizing.cell_volumes[6] << '\n';
  options.min_size = 0.61 * h;
  field            = adapt::marked_size_field(mesh, marking, options);
  std::cout << "too small: refined " << field.n_refined << ", clamped " << field.n_clamped
            << ", bounds " << field.sizing.cell_volumes.size() << '\n';
}

/** Energy norm of x_1^2 minus its interpolant of degree 1, cell by cell. The
 * gradient's error is linear, so that the four-point rule is exact. */
std::vector<double>
interpolation_error(const mesh::TetMesh &mesh)
{
  constexpr double    a = 0.58541019662496845446, b = 0.13819660112501051518;
  std::vector<double> e;
  for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      // On these meshes the interpolant's slope is (x_0 + x_1), the others zero.
      double low = 1e9, high = -1e9, sum = 0.;
      for (const unsigned int v : mesh.cells[c])
        {
          low  = std::min(low, mesh.points[v][0]);
          high = std::max(high, mesh.points[v][0]);
        }
      for (unsigned int q = 0; q < 4; ++q)
        {
          double x = 0.;
          for (unsigned int i = 0; i < 4; ++i)
            x += (i == q ? a : b) * mesh.points[mesh.cells[c][i]][0];
          sum += 0.25 * std::pow(2. * x - (low + high), 2);
        }
      e.push_back(std::sqrt(sum * mesh::cell_volume(mesh, c)));
    }
  return e;
}

/** Cycles of twice as many bricks a side, which is what the sizes ask for. */
void
loop()
{
  scene::AdaptivityParameters parameters;
  parameters.strategy             = scene::AdaptivityParameters::Strategy::adaptive;
  parameters.refinement_indicator = scene::AdaptivityParameters::RefinementIndicator::exact;
  parameters.growth               = 8.;
  parameters.gradation            = 0.3;
  parameters.min_ratio            = 0.25;
  parameters.tolerance            = 0.05;
  parameters.max_cycles           = 10;
  adapt::StoppingContext context;
  context.true_energy_error = true;

  std::vector<adapt::CycleRecord> history;
  const double                    norm      = std::sqrt(4. / 3.); // of the gradient of x^2
  double                          predicted = 0.;
  for (unsigned int n = 2;; n *= 2)
    {
      const auto mesh = cube(n);
      const auto e    = interpolation_error(mesh);
      double     sum  = 0.;
      for (const double value : e)
        sum += value * value;
      adapt::CycleRecord record;
      record.cycle                 = history.size();
      record.tets                  = mesh.n_cells();
      record.relative_energy_error = std::sqrt(sum) / norm;
      history.push_back(record);
      // |2x - (x_0+x_1)| has the mean square h^2/3: x is spread evenly.
      std::cout << "cycle " << record.cycle << ": tets " << record.tets << ", error "
                << *record.relative_energy_error << ", times n "
                << *record.relative_energy_error * norm * n;
      if (predicted > 0.)
        std::cout << ", as predicted " << close(std::sqrt(sum), predicted, 0.02);
      std::cout << '\n';
      const auto decision = adapt::decide_stop(parameters, context, history);
      if (decision.stop())
        {
          std::cout << decision.text << '\n';
          break;
        }
      auto options
        = adapt::make_size_field_options(parameters, scene::TetgenParameters(), 1, mesh.n_cells());
      options.obtained_over_predicted = 1.;
      const auto field                = adapt::optimal_size_field(mesh, e, options);
      predicted                       = field.predicted_error;
      const double h                  = adapt::equivalent_edge(1. / mesh.n_cells());
      double       mean               = 0.;
      for (const double size : field.sizing.node_sizes)
        mean += size / mesh.n_points();
      std::cout << "  growth " << close(field.predicted_tets / mesh.n_cells(), 8.) << ", mean size "
                << close(mean, 0.5 * h, 0.02) << '\n';
    }
}

int
main()
{
  conversions();
  uniform_error();
  geometric_error();
  everything_at_once();
  tolerance();
  marked();
  loop();
}
