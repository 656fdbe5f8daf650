// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/marking.h"

#include "tetradapt/core/exceptions.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace tetradapt::adapt
{
  namespace
  {
    /** ceil(fraction * n), where a product that is an integer but for rounding
     * counts as that integer: 0.07 of 100 cells are 7. */
    std::size_t
    part_of(const double fraction, const std::size_t n)
    {
      const double exact = fraction * n * (1. - 1e-12);
      return exact <= 0. ? 0 : std::min<std::size_t>(n, std::ceil(exact));
    }

    /** Cell numbers in the order of falling indicators, the lower number first
     * among equals. Only the first @p n_needed are put in order. */
    std::vector<unsigned int>
    largest_first(const std::vector<double> &indicators, const std::size_t n_needed)
    {
      std::vector<unsigned int> order(indicators.size());
      std::iota(order.begin(), order.end(), 0);
      const auto before = [&indicators](const unsigned int a, const unsigned int b) {
        return indicators[a] > indicators[b] || (indicators[a] == indicators[b] && a < b);
      };
      if (n_needed < order.size())
        std::nth_element(order.begin(), order.begin() + n_needed, order.end(), before);
      std::sort(order.begin(), order.begin() + n_needed, before);
      return order;
    }

    /** The first @p n of @p order that have an error at all. */
    Marking
    take(const std::vector<unsigned int> &order,
         const std::size_t                n,
         const std::vector<double>       &indicators)
    {
      Marking marking;
      for (std::size_t i = 0; i < n && indicators[order[i]] > 0.; ++i)
        marking.cells.push_back(order[i]);
      std::sort(marking.cells.begin(), marking.cells.end());
      return marking;
    }
  } // namespace



  void
  check_indicators(const std::vector<double> &indicators, const mesh::TetMesh &mesh)
  {
    if (indicators.size() != mesh.n_cells())
      throw core::NumericalError("There are " + std::to_string(indicators.size())
                                 + " error indicators for " + std::to_string(mesh.n_cells())
                                 + " tetrahedra; there must be one each.");
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (!(indicators[c] >= 0.) || !std::isfinite(indicators[c]))
        {
          mesh::Point<3> centroid;
          for (const unsigned int v : mesh.cells[c])
            centroid += mesh.points[v] / 4.;
          std::ostringstream text;
          text << "The error indicator of tetrahedron " << c << " (centroid " << centroid << ") is "
               << indicators[c] << "; it must be a finite number >= 0. Check the materials and the "
               << "quality of the mesh there.";
          throw core::NumericalError(text.str());
        }
  }



  Marking
  Marker::mark(const std::vector<double> &indicators, const mesh::TetMesh &mesh) const
  {
    check_indicators(indicators, mesh);
    const double largest
      = indicators.empty() ? 0. : *std::max_element(indicators.begin(), indicators.end());
    if (largest == 0.)
      return {};

    Marking marking = choose(indicators);

    // Relative to the largest, so that no square overflows or vanishes.
    double all = 0., marked = 0., smallest = largest;
    for (const double eta : indicators)
      all += (eta / largest) * (eta / largest);
    for (const unsigned int c : marking.cells)
      {
        marked += (indicators[c] / largest) * (indicators[c] / largest);
        smallest = std::min(smallest, indicators[c]);
      }
    marking.squared_share = std::min(1., marked / all);
    if (marking.lambda == 0. && !marking.cells.empty())
      marking.lambda = smallest / largest;
    return marking;
  }



  MaximumMarker::MaximumMarker(const double lambda, const double min_new)
    : lambda(lambda), min_new(min_new)
  {
  }



  Marking
  MaximumMarker::choose(const std::vector<double> &indicators) const
  {
    const double largest = *std::max_element(indicators.begin(), indicators.end());
    Marking      marking;
    marking.lambda   = lambda;
    double threshold = lambda * largest;

    const std::size_t wanted = part_of(min_new, indicators.size());
    const std::size_t found
      = std::count_if(indicators.begin(), indicators.end(), [threshold](const double eta) {
          return eta >= threshold;
        });
    if (found < wanted)
      {
        // The indicator at the wanted rank is the highest threshold that marks
        // enough; no need to lower lambda in steps.
        std::vector<double> sorted(indicators);
        std::nth_element(sorted.begin(),
                         sorted.begin() + (wanted - 1),
                         sorted.end(),
                         std::greater<double>());
        threshold      = sorted[wanted - 1];
        marking.lambda = threshold / largest;
      }
    for (unsigned int c = 0; c < indicators.size(); ++c)
      if (indicators[c] >= threshold && indicators[c] > 0.)
        marking.cells.push_back(c);
    return marking;
  }



  FixedFractionMarker::FixedFractionMarker(const double fraction) : fraction(fraction)
  {
  }



  Marking
  FixedFractionMarker::choose(const std::vector<double> &indicators) const
  {
    const std::size_t n = part_of(fraction, indicators.size());
    return take(largest_first(indicators, n), n, indicators);
  }



  DoerflerMarker::DoerflerMarker(const double theta) : theta(theta)
  {
  }



  Marking
  DoerflerMarker::choose(const std::vector<double> &indicators) const
  {
    const std::vector<unsigned int> order   = largest_first(indicators, indicators.size());
    const double                    largest = indicators[order.front()];
    const auto                      square
      = [&](const unsigned int c) { return (indicators[c] / largest) * (indicators[c] / largest); };
    // Summed in the same order as below, so that theta = 1 is reached exactly
    // with the last positive indicator.
    double total = 0.;
    for (const unsigned int c : order)
      total += square(c);

    std::size_t n   = 0;
    double      sum = 0.;
    while (n < order.size() && sum < theta * total)
      sum += square(order[n++]);
    return take(order, n, indicators);
  }



  std::unique_ptr<Marker>
  make_marker(const scene::AdaptivityParameters &parameters)
  {
    using Rule = scene::AdaptivityParameters::Marking;
    switch (parameters.marking)
      {
      case Rule::maximum:
        return std::make_unique<MaximumMarker>(parameters.lambda, parameters.min_new);
      case Rule::fixed_fraction:
        return std::make_unique<FixedFractionMarker>(parameters.fraction);
      case Rule::doerfler:
        return std::make_unique<DoerflerMarker>(parameters.theta);
      case Rule::optimal_size:
        break;
      }
    return nullptr;
  }
} // namespace tetradapt::adapt
