// SPDX-License-Identifier: AGPL-3.0-or-later
#include "cells.h"

#include "batch.h"
#include "faces.h"

#include "tetradapt/compare/tet_quadrature.h"
#include "tetradapt/mesh/edges.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::estimate
{
  namespace
  {
    /** Entries of a symmetric tensor in the order xx, yy, zz, yz, zx, xy. */
    constexpr unsigned int components[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  } // namespace

  CellStates::CellStates(const mesh::NodalField &u_h, const mechanics::MaterialMap &materials)
    : u_h(u_h), mesh(u_h.mesh()), materials(materials), inverse_products(10, 10)
  {
    const compare::TetQuadrature &rule = compare::tet_quadrature(5);
    for (unsigned int q = 0; q < rule.points.size(); ++q)
      {
        const auto f = quadratic_functions(rule.points[q]);
        for (unsigned int i = 0; i < 10; ++i)
          for (unsigned int j = 0; j < 10; ++j)
            inverse_products(i, j) += rule.weights[q] * f[i] * f[j];
      }
    inverse_products.gauss_jordan();

    int last = 0;
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      if (cell == 0 || mesh.regions[cell] != last)
        {
          last = mesh.regions[cell];
          if (regions.count(last) == 0)
            regions.emplace(last, make_region(last));
        }
    for (auto &[id, region] : regions)
      {
        region.thermal = materials.has_thermal_strain() && materials.thermal_density().acts_in(id);
        for (const auto &force : materials.body_forces())
          if (force.second->is_constant(id))
            region.constant_force += force.second->value(id, Point<3>());
          else
            region.variable_forces.push_back(force.second.get());
      }
  }

  CellStates::Region
  CellStates::make_region(const int id) const
  {
    Region region{&materials.linear_law(id), {}, 0., {}, false, {}};
    // A stress is the sum of its components times these.
    std::array<SymmetricTensor<2, 3>, 6> unit;
    for (unsigned int p = 0; p < 6; ++p)
      unit[p][components[p][0]][components[p][1]] = 1.;
    for (unsigned int p = 0; p < 6; ++p)
      for (unsigned int q = 0; q < 6; ++q)
        region.compliance[p][q] = .25
                                  * (region.law->complementary_density(unit[p] + unit[q])
                                     - region.law->complementary_density(unit[p] - unit[q]));
    region.largest_compliance
      = std::max(.5 * region.law->complementary_density(unit[5]),
                 region.law->complementary_density(unit[0] + unit[1] + unit[2]) / 3.);
    return region;
  }

  void
  CellStates::compute(const unsigned int cell, CellState &state) const
  {
    const Region &region = this->region(cell);
    state.volume         = mesh::cell_volume(mesh, cell);
    state.gradients      = mesh::barycentric_gradients(mesh, cell);
    compute_stress(cell, region, state);
    compute_force(cell, region, state);
  }

  void
  CellStates::compute_loads(const unsigned int cell, CellState &state) const
  {
    const Region &region      = this->region(cell);
    state.volume              = mesh::cell_volume(mesh, cell);
    state.gradients           = mesh::barycentric_gradients(mesh, cell);
    state.thermal_oscillation = 0.;
    state.stress.fill(SymmetricTensor<2, 3>());
    state.has_bubbles = false;
    if (region.thermal && !materials.is_mixed())
      add_thermal_stress(cell, region, state);
    compute_force(cell, region, state);
  }

  void
  CellStates::load(const unsigned int         cell,
                   const CellState           &state,
                   const CellFaces           &faces,
                   const std::vector<double> &moments,
                   CellBatch                 &batch,
                   const unsigned int         lane) const
  {
    const auto &g = state.gradients; // the last three are the rows of F^-1
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int d = 0; d < 3; ++d)
        batch.inverse[3 * i + d][lane] = g[i + 1][d];
    for (unsigned int f = 0; f < 4; ++f)
      {
        const auto  &side = faces.sides[cell][f];
        Tensor<1, 3> own[6];
        traction_moments(state, f, own);
        make_orthogonal(own);
        for (unsigned int s = 0; s < 6; ++s)
          {
            const double *given = &moments[18 * std::size_t(side.face) + 3 * side.function(s)];
            for (unsigned int d = 0; d < 3; ++d)
              own[s][d] = (side.second ? -given[d] : given[d]) - own[s][d];
            for (unsigned int i = 0; i < 3; ++i)
              batch.loads[18 * f + 3 * s + i][lane] = g[i + 1] * own[s];
          }
      }
    const double J = 6. * state.volume;
    Tensor<1, 3> constant;
    for (unsigned int i = 0; i < 4; ++i)
      constant += state.stress[i] * g[i];
    for (unsigned int v = 0; v < 4; ++v)
      {
        Tensor<1, 3> rest = state.density[v] + constant;
        if (state.has_bubbles)
          for (unsigned int e = 0; e < 6; ++e)
            for (unsigned int k = 0; k < 2; ++k)
              if (mesh::edge_vertices[e][k] == v)
                rest += 4. * (state.stress[4 + e] * g[mesh::edge_vertices[e][1 - k]]);
        for (unsigned int i = 0; i < 3; ++i)
          batch.loads[EquilibratedElement::n_moments + 3 * v + i][lane] = J * (g[i + 1] * rest);
      }
    if (lane == 0)
      batch.has_quadratic = false;
    batch.has_quadratic = batch.has_quadratic || state.has_curvature;
    for (unsigned int e = 0; e < 6; ++e)
      for (unsigned int i = 0; i < 3; ++i)
        batch.quadratic[3 * e + i][lane]
          = state.has_curvature ? J * (g[i + 1] * state.curvature[e]) : 0.;
    load_shape(cell, J, batch, lane);
  }

  void
  CellStates::load_shape(const unsigned int cell,
                         const double       J,
                         CellBatch         &batch,
                         const unsigned int lane) const
  {
    const auto  &corners = mesh.cells[cell];
    Tensor<2, 3> F;
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int i = 0; i < 3; ++i)
        F[i][k] = mesh.points[corners[k + 1]][i] - mesh.points[corners[0]][i];
    // Components of F S F^T from those of S, and the energy's matrix for these.
    double       T[6][6], DT[6][6];
    const auto  &D  = region(cell).compliance;
    unsigned int pq = 0;
    for (unsigned int p = 0; p < 6; ++p)
      for (unsigned int q = 0; q < 6; ++q)
        {
          const unsigned int i = components[p][0], j = components[p][1];
          const unsigned int k = components[q][0], l = components[q][1];
          T[p][q] = F[i][k] * F[j][l] + (k == l ? 0. : F[i][l] * F[j][k]);
        }
    for (unsigned int p = 0; p < 6; ++p)
      for (unsigned int q = 0; q < 6; ++q)
        {
          DT[p][q] = 0.;
          for (unsigned int r = 0; r < 6; ++r)
            DT[p][q] += D[p][r] * T[r][q];
        }
    for (unsigned int p = 0; p < 6; ++p)
      for (unsigned int q = p; q < 6; ++q, ++pq)
        {
          double sum = 0.;
          for (unsigned int r = 0; r < 6; ++r)
            sum += T[r][p] * DT[r][q];
          batch.shape[pq][lane] = sum / J;
        }
  }
} // namespace tetradapt::estimate
