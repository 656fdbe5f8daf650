// SPDX-License-Identifier: AGPL-3.0-or-later
// The gradation against its definition: every edge satisfied, and the largest
// such field, computed here from all shortest paths.

#include "tetradapt/adapt/gradation.h"

#include "tetradapt/mesh/bricks.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

using namespace tetradapt;

/** min over y of h_0(y) + g d(x,y), d the shortest way along edges. */
std::vector<double>
by_all_paths(const mesh::TetMesh       &mesh,
             const mesh::EdgeTable     &edges,
             const double               g,
             const std::vector<double> &start)
{
  const unsigned int               n = mesh.n_points();
  std::vector<std::vector<double>> way(n, std::vector<double>(n, 1e300));
  for (unsigned int p = 0; p < n; ++p)
    way[p][p] = 0.;
  for (const auto &e : edges.edges)
    way[e[0]][e[1]] = way[e[1]][e[0]] = mesh.points[e[0]].distance(mesh.points[e[1]]);
  for (unsigned int k = 0; k < n; ++k)
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        way[i][j] = std::min(way[i][j], way[i][k] + way[k][j]);
  std::vector<double> sizes(start);
  for (unsigned int x = 0; x < n; ++x)
    for (unsigned int y = 0; y < n; ++y)
      sizes[x] = std::min(sizes[x], start[y] + g * way[x][y]);
  return sizes;
}

void
check(const mesh::TetMesh &mesh, const double g, const std::vector<double> &start)
{
  const auto   edges     = mesh::build_edges(mesh);
  auto         sizes     = start;
  const auto   n_lowered = adapt::Gradation(mesh, edges, g).limit(sizes);
  const auto   expected  = by_all_paths(mesh, edges, g, start);
  double       deviation = 0.;
  unsigned int n_differ  = 0;
  for (unsigned int p = 0; p < mesh.n_points(); ++p)
    {
      deviation = std::max(deviation, std::abs(sizes[p] / expected[p] - 1.));
      n_differ += sizes[p] != start[p] ? 1 : 0;
    }
  unsigned int n_violated = 0;
  for (const auto &e : edges.edges)
    {
      const double growth = g * mesh.points[e[0]].distance(mesh.points[e[1]]);
      if (std::abs(sizes[e[0]] - sizes[e[1]]) > growth * (1. + 1e-12))
        ++n_violated;
    }
  std::cout << "g " << g << ": lowered " << n_lowered << " of " << mesh.n_points()
            << ", violated edges " << n_violated << ", count right " << (n_differ == n_lowered)
            << ", largest field " << (deviation < 1e-13) << '\n';
}

int
main()
{
  const auto          mesh = mesh::bricks({0., 0., 0.}, {3., 2., 1.}, {{6, 4, 3}});
  unsigned long       seed = 42;
  std::vector<double> scattered;
  for (unsigned int p = 0; p < mesh.n_points(); ++p)
    {
      seed = (seed * 1103515245ul + 12345ul) % 2147483648ul;
      scattered.push_back(std::pow(10., -2. * (seed / 2147483648.)));
    }
  for (const double g : {0.05, 0.3, 1.})
    check(mesh, g, scattered);

  // One small size in a field without any: a cone around it.
  std::vector<double> peak(mesh.n_points(), std::numeric_limits<double>::infinity());
  peak[0] = 0.01;
  check(mesh, 0.3, peak);
  adapt::Gradation(mesh, mesh::build_edges(mesh), 0.5).limit(peak);
  std::cout << "along x: " << peak[0] << ' ' << peak[1] << ' ' << peak[2] << ' ' << peak[6] << '\n';

  // No limit, and a field that needs none.
  auto same = scattered;
  std::cout << "g 0: lowered " << adapt::Gradation(mesh, mesh::build_edges(mesh), 0.).limit(same)
            << ", unchanged " << (same == scattered) << '\n';
  std::vector<double> even(mesh.n_points(), 0.7);
  std::cout << "even: lowered " << adapt::Gradation(mesh, mesh::build_edges(mesh), 0.1).limit(even)
            << '\n';
}
