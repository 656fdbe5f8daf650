// SPDX-License-Identifier: AGPL-3.0-or-later
// The marking rules on small sets with known answers, Doerfler's minimality by
// trying all subsets, and what happens to indicators that are none.

#include "tetradapt/adapt/marking.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/bricks.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <set>

using namespace tetradapt;
using adapt::Marking;

mesh::TetMesh
bar(const unsigned int n)
{
  return mesh::bricks({0., 0., 0.}, {1. * n, 1., 1.}, {{n, 1, 1}});
}

void
print(const std::string &label, const Marking &marking)
{
  std::cout << label << ": cells";
  for (const unsigned int c : marking.cells)
    std::cout << ' ' << c;
  std::cout << "; lambda " << marking.lambda << "; share " << marking.squared_share << '\n';
}

/** Numbers in (0, 1) that are the same everywhere. */
std::vector<double>
scattered(const unsigned int n, unsigned long seed)
{
  std::vector<double> values;
  for (unsigned int i = 0; i < n; ++i)
    {
      seed = (seed * 1103515245ul + 12345ul) % 2147483648ul;
      values.push_back((seed + 1.) / 2147483649.);
    }
  return values;
}

void
small_set()
{
  const auto                mesh = bar(2);
  const std::vector<double> eta{1., 8., 10., 9., 3., 0., 8., 0., 2., 5., 0., 4.};
  print("maximum 0.8", adapt::MaximumMarker(0.8, 0.1).mark(eta, mesh));
  print("maximum 0.95, lowered", adapt::MaximumMarker(0.95, 0.25).mark(eta, mesh));
  print("maximum, all wanted", adapt::MaximumMarker(0.8, 1.).mark(eta, mesh));
  print("fraction 0.25", adapt::FixedFractionMarker(0.25).mark(eta, mesh));
  print("fraction 0.26", adapt::FixedFractionMarker(0.26).mark(eta, mesh));
  print("fraction 1", adapt::FixedFractionMarker(1.).mark(eta, mesh));
  print("doerfler 0.497", adapt::DoerflerMarker(0.497).mark(eta, mesh));
  print("doerfler 0.5", adapt::DoerflerMarker(0.5).mark(eta, mesh));
  print("doerfler 1", adapt::DoerflerMarker(1.).mark(eta, mesh));

  const std::vector<double> zero(12, 0.);
  print("no error", adapt::DoerflerMarker(0.5).mark(zero, mesh));
  print("no error, maximum", adapt::MaximumMarker(0.8, 0.5).mark(zero, mesh));

  // Squares of these leave the range of double.
  for (const double scale : {1e-200, 1e200})
    {
      std::vector<double> scaled(eta);
      for (double &e : scaled)
        e *= scale;
      print("doerfler 0.5, scaled", adapt::DoerflerMarker(0.5).mark(scaled, mesh));
    }
}

void
counts()
{
  const auto mesh = bar(100);
  const auto eta  = scattered(600, 7);
  // 0.07 * 600 is 42.000000000000007 in floating point.
  for (const double fraction : {0.07, 0.2, 0.0001})
    std::cout << "fraction " << fraction
              << " of 600: " << adapt::FixedFractionMarker(fraction).mark(eta, mesh).cells.size()
              << '\n';
}

/** Against every subset of 12 cells: none with fewer cells holds the share. */
void
doerfler_is_minimal()
{
  const auto   mesh   = bar(2);
  unsigned int n_sets = 0, n_right = 0;
  for (unsigned long seed = 1; seed <= 10; ++seed)
    for (const double theta : {0.1, 0.3, 0.5, 0.7, 0.9})
      {
        const auto eta = scattered(12, 1000 * seed);
        double     all = 0.;
        for (const double e : eta)
          all += e * e;
        unsigned int least = 12;
        for (unsigned int set = 0; set < 4096; ++set)
          {
            double       sum  = 0.;
            unsigned int size = 0;
            for (unsigned int c = 0; c < 12; ++c)
              if (set & (1u << c))
                {
                  sum += eta[c] * eta[c];
                  ++size;
                }
            if (sum >= theta * all)
              least = std::min(least, size);
          }
        const Marking marking = adapt::DoerflerMarker(theta).mark(eta, mesh);
        double        marked  = 0.;
        for (const unsigned int c : marking.cells)
          marked += eta[c] * eta[c];
        ++n_sets;
        if (marking.cells.size() == least && marked >= theta * all
            && std::abs(marking.squared_share - marked / all) < 1e-14)
          ++n_right;
      }
  std::cout << "doerfler minimal: " << n_right << " of " << n_sets << '\n';
}

void
bad_indicators()
{
  const auto mesh = bar(2);
  const auto mark = [&](const std::vector<double> &eta) {
    try
      {
        adapt::FixedFractionMarker(0.2).mark(eta, mesh);
        std::cout << "accepted\n";
      }
    catch (const core::NumericalError &error)
      {
        std::cout << "NumericalError: " << error.what() << '\n';
      }
  };
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.})
    {
      std::vector<double> eta(12, 1.);
      eta[6] = bad;
      mark(eta);
    }
  mark(std::vector<double>(11, 1.));
}

void
factory()
{
  using Rule                       = scene::AdaptivityParameters::Marking;
  const auto                  mesh = bar(100);
  const auto                  eta  = scattered(600, 7);
  scene::AdaptivityParameters parameters;
  parameters.lambda   = 0.9;
  parameters.min_new  = 0.5;
  parameters.fraction = 0.1;
  parameters.theta    = 1.;
  for (const Rule rule : {Rule::maximum, Rule::fixed_fraction, Rule::doerfler})
    {
      parameters.marking = rule;
      std::cout << "by enum: " << adapt::make_marker(parameters)->mark(eta, mesh).cells.size()
                << '\n';
    }
  parameters.marking = Rule::optimal_size;
  std::cout << "optimal size marks: " << (adapt::make_marker(parameters) != nullptr) << '\n';
}

int
main()
{
  small_set();
  counts();
  doerfler_is_minimal();
  bad_indicators();
  factory();
}
