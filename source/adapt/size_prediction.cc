// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/size_prediction.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetradapt::adapt
{
  using SizeControl = scene::AdaptivityParameters::SizeControl;

  namespace
  {
    /** For points without a cell; finite, as TetGen wants it. */
    constexpr double no_size = 1e100;
  } // namespace



  SizePrediction::SizePrediction(const mesh::TetMesh       &mesh,
                                 const std::vector<double> &indicators,
                                 const SizeFieldOptions    &options,
                                 const mesh::EdgeTable     &edges)
    : mesh(mesh), indicators(indicators), options(options),
      gradation(mesh, edges, options.gradation),
      factor(options.obtained_over_predicted > 0. ? options.obtained_over_predicted
                                                  : default_obtained_over_predicted(options)),
      volumes(mesh.n_cells()), sizes(mesh.n_cells()), log_ratios(mesh.n_cells()),
      point_volumes(mesh.n_points(), 0.), node_sizes(mesh.n_points())
  {
    // Relative to the largest, so that no square overflows or vanishes.
    const double largest = *std::max_element(indicators.begin(), indicators.end());
    double       sum     = 0.;
    for (const double e : indicators)
      sum += (e / largest) * (e / largest);
    present_error = largest * std::sqrt(sum);
    // A cell without any error would get an infinite size. Far below the mean all
    // that matters is that it will not be refined.
    const double floor    = 1e-6 * largest * std::sqrt(sum / mesh.n_cells());
    const double exponent = -2. / (2. * options.order + 3.);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        volumes[c]    = mesh::cell_volume(mesh, c);
        sizes[c]      = equivalent_edge(volumes[c]);
        log_ratios[c] = exponent * std::log(std::max(indicators[c], floor));
        for (const unsigned int v : mesh.cells[c])
          point_volumes[v] += volumes[c];
      }
    const auto range  = std::minmax_element(log_ratios.begin(), log_ratios.end());
    lowest_log_scale  = std::log(options.min_ratio) - *range.second;
    highest_log_scale = std::log(options.max_ratio) - *range.first;
  }



  double
  SizePrediction::guess(const double n) const
  {
    // The smallest ratio is taken out to keep the sum from overflowing.
    const double smallest = *std::min_element(log_ratios.begin(), log_ratios.end());
    double       sum      = 0.;
    for (const double a : log_ratios)
      sum += std::exp(-3. * (a - smallest));
    return std::log(factor * sum / n) / 3. - smallest;
  }



  double
  SizePrediction::wanted_size(const unsigned int c) const
  {
    const double ratio = std::exp(log_scale + log_ratios[c]);
    double       size  = sizes[c] * std::clamp(ratio, options.min_ratio, options.max_ratio);
    if (options.max_size > 0.)
      size = std::min(size, options.max_size);
    return std::max(size, options.min_size);
  }



  void
  SizePrediction::set_nodes_to_minimum()
  {
    std::fill(node_sizes.begin(), node_sizes.end(), no_size);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const double size = wanted_size(c);
        for (const unsigned int v : mesh.cells[c])
          node_sizes[v] = std::min(node_sizes[v], size);
      }
  }



  void
  SizePrediction::set_nodes_to_mean()
  {
    std::fill(node_sizes.begin(), node_sizes.end(), 0.);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const double weighted = volumes[c] * std::log(wanted_size(c));
        for (const unsigned int v : mesh.cells[c])
          node_sizes[v] += weighted;
      }
    for (unsigned int p = 0; p < mesh.n_points(); ++p)
      node_sizes[p] = point_volumes[p] > 0. ? std::exp(node_sizes[p] / point_volumes[p]) : no_size;
  }



  double
  SizePrediction::density(const unsigned int c) const
  {
    // The four-point rule of degree 2, in barycentric coordinates.
    constexpr double a = 0.58541019662496845446, b = 0.13819660112501051518;
    const auto      &v = mesh.cells[c];
    const double     sum
      = b * (node_sizes[v[0]] + node_sizes[v[1]] + node_sizes[v[2]] + node_sizes[v[3]]);
    double mean = 0.;
    for (const unsigned int p : v)
      {
        const double ratio = sizes[c] / (sum + (a - b) * node_sizes[p]);
        mean += 0.25 * ratio * ratio * ratio;
      }
    return mean;
  }



  double
  SizePrediction::n_pieces(const unsigned int c) const
  {
    const double pieces = factor * density(c);
    return options.coarsening ? pieces : std::max(1., pieces);
  }



  void
  SizePrediction::set_scale(const double new_log_scale)
  {
    log_scale = new_log_scale;
    if (options.nodal_size == NodalSize::minimum)
      set_nodes_to_minimum();
    else
      set_nodes_to_mean();
    n_graded = gradation.limit(node_sizes);

    predicted_tets = 0.;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      predicted_tets += n_pieces(c);
  }



  double
  SizePrediction::reduction() const
  {
    double sum = 0.;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const double part = indicators[c] / present_error;
        sum += part * part * std::pow(n_pieces(c), -2. * options.rate / 3.);
      }
    return std::sqrt(sum);
  }



  double
  SizePrediction::error() const
  {
    return present_error * std::pow(reduction(), options.reduction_power);
  }



  SizeField
  SizePrediction::field() const
  {
    const double clamped = std::log(options.min_ratio) + 1e-9;
    const bool   by_size = options.size_control == SizeControl::node_sizes;
    const double bound   = volume_bound_factor(options.radius_edge_ratio);

    SizeField field;
    field.predicted_tets          = predicted_tets;
    field.predicted_reduction     = reduction();
    field.predicted_error         = error();
    field.n_graded                = n_graded;
    field.obtained_over_predicted = factor;
    std::vector<double> cell_volumes(mesh.n_cells(), 0.);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        if (log_scale + log_ratios[c] <= clamped || wanted_size(c) <= options.min_size)
          ++field.n_clamped;
        const double size = sizes[c] / std::cbrt(density(c));
        if (size < sizes[c])
          {
            ++field.n_refined;
            cell_volumes[c] = bound * regular_volume(size);
          }
      }
    if (field.n_refined > 0 && by_size)
      field.sizing.node_sizes = node_sizes;
    else if (field.n_refined > 0)
      field.sizing.cell_volumes = std::move(cell_volumes);
    field.node_sizes = node_sizes;
    return field;
  }
} // namespace tetradapt::adapt
